"""Triangles put in order and measured: components, orientation, holes, distance, simplification, booleans."""
