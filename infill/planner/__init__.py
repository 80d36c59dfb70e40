"""Motion of a printer: junctions, look-ahead, printing time."""
