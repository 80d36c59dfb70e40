"""Small files to try the commands with, made by code: a part, a scan and a sliced print."""
