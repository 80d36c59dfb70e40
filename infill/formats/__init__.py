"""Reading and writing files: one format per module, reader next to writer; files appear whole or not at all."""
