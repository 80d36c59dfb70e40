"""Closed rings in a plane: contours of a field, straightening, triangulation, prisms."""
