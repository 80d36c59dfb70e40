"""Drawings in: SVG, DXF, WKT, bitmaps."""
