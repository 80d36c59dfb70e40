"""`refill`: the infill of a sliced print drawn again."""
