"""A sliced print as a stream of lines."""
