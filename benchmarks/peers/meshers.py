"""Voxels of -1 and +1 to a surface, by VTK, SimpleITK, PyMCubes, SciPy and trimesh. All lengths are in cells.

Each takes the field, [x, y, z], and returns a surface about the middle of the grid. A library that is not installed
raises ModuleNotFoundError.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter, uniform_filter

from infill.isosurfaces.marching import extract_dense
from infill.surface import Surface

Field = NDArray[np.floating]


def surface_of(field: Field, level: float = 0.0) -> Surface:
    """Return the surface of {field > level}, in cells about the middle of the grid."""
    origin = tuple(-n / 2 for n in field.shape)
    return extract_dense(field, spacing=(1.0, 1.0, 1.0), origin=origin, level=level)


def majority_sinc(f: Field, passes: int, band: float) -> Surface:
    """Return the windowed sinc after a majority vote of 3 x 3 x 3, as one does with noisy labels."""
    return windowed_sinc(uniform_filter(f, 3, mode="nearest"), passes, band)


def vtk_triangles(f: Field, mesher: Any, after: Any = None) -> Surface:
    """Run VTK's mesher on the labels, then a filter, and return the triangles, turned outwards."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkImageData

    labels = np.pad((f > 0).astype(np.uint8), 1)
    image = vtkImageData(dimensions=labels.shape, origin=[-(n - 1) / 2 for n in labels.shape])
    image.GetPointData().SetScalars(numpy_to_vtk(labels.ravel(order="F"), deep=True))
    mesher.SetInputData(image)
    mesher.SetValue(0, 1)
    if after:
        after.SetInputConnection(mesher.GetOutputPort())
    (after or mesher).Update()
    data = (after or mesher).GetOutput()
    vertices = vtk_to_numpy(data.GetPoints().GetData()).astype(np.float64)
    faces = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    surface = Surface(vertices=vertices, faces=faces)
    return surface if surface.volume > 0 else Surface(vertices=vertices, faces=faces[:, ::-1])


def windowed_sinc(f: Field, passes: int, band: float) -> Surface:
    from vtkmodules.vtkFiltersCore import vtkWindowedSincPolyDataFilter
    from vtkmodules.vtkFiltersGeneral import vtkDiscreteFlyingEdges3D

    low_pass = vtkWindowedSincPolyDataFilter(number_of_iterations=passes, pass_band=band, normalize_coordinates=True)
    low_pass.BoundarySmoothingOff()
    return vtk_triangles(f, vtkDiscreteFlyingEdges3D(), low_pass)


def slicer(f: Field, factor: float = 0.5) -> Surface:
    """Return what 3D Slicer shows of a segment: its closed surface at the default smoothing, without decimation."""
    from vtkmodules.vtkFiltersCore import vtkWindowedSincPolyDataFilter
    from vtkmodules.vtkFiltersGeneral import vtkDiscreteFlyingEdges3D

    low_pass = vtkWindowedSincPolyDataFilter(
        number_of_iterations=round(20 + 40 * factor), pass_band=10 ** (-4 * factor), normalize_coordinates=True
    )
    low_pass.BoundarySmoothingOff()
    low_pass.FeatureEdgeSmoothingOff()
    low_pass.NonManifoldSmoothingOn()
    return vtk_triangles(f, vtkDiscreteFlyingEdges3D(), low_pass)


def surface_nets(f: Field) -> Surface:
    from vtkmodules.vtkFiltersCore import vtkSurfaceNets3D

    nets = vtkSurfaceNets3D(number_of_iterations=16, constraint_scale=2, relaxation_factor=0.5)
    nets.SetOutputMeshTypeToTriangles()
    return vtk_triangles(f, nets)


def level_set(f: Field, which: str) -> Surface:
    """Return the zero surface of a smooth distance-like function, squeezed into [-1, 1] for our mesher."""
    if which == "mcubes":
        import mcubes

        return surface_of(np.tanh(mcubes.smooth(f > 0)))
    import SimpleITK

    image = SimpleITK.GetImageFromArray((f > 0).astype(np.uint8))
    return surface_of(np.tanh(SimpleITK.GetArrayFromImage(SimpleITK.AntiAliasBinary(image))))


def relaxed(f: Field, which: str, **settings: float) -> Surface:
    """Return the raw mesh after one of trimesh's filters."""
    import trimesh

    mesh = surface_of(f).to_trimesh()
    getattr(trimesh.smoothing, f"filter_{which}")(mesh, **settings)
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


def gaussian(f: Field, sigma: float) -> Surface:
    return surface_of(gaussian_filter(f, sigma, mode="nearest"))
