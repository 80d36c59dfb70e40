"""Open lines in a plane: clipping, joining, ordering, corners, curves, contact."""
