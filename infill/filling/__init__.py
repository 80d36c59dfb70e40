"""Paths that fill a region, and their corners."""
