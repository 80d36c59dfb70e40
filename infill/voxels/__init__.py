"""Solid on a grid: patterns, meshes, points and scans turned into cells."""
