"""Sheets of a gyroid within a mesh, by microgen: run by a Python that has it, with paths, cell and density."""

from __future__ import annotations

import sys

if __name__ == "__main__":
    import pyvista
    from microgen import Infill, surface_functions

    _, inside, output, cell, density, resolution = sys.argv
    found = Infill(
        obj=pyvista.read(inside),
        surface_function=surface_functions.gyroid,
        cell_size=float(cell),
        density=float(density),
        resolution=int(resolution),
    )
    found.sheet.extract_surface().triangulate().clean().save(output)
