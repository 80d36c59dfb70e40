"""A sliced print as a stream of lines: read, replayed, spliced, verified, written."""
