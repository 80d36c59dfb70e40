"""`refill`: the infill of a sliced print redrawn."""
