"""Files in and out, one format a module, reader beside writer; files appear whole or not at all."""
