"""Inspect results: connections, widths and thickness, the changes by smoothing, and whether they are printable."""
