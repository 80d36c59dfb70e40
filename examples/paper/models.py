"""The scanned models and silhouettes, which have licences of their own and are not part of the project.

They are looked for in $INFILL_DATA, else in ../shared/data beside the project: models/, medical/ and silhouettes/.
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
from PIL import Image

from examples.paper.shapes import Field, binary, embedded
from infill import Surface, read_mesh
from infill.voxels.from_mesh import voxelise

FILES = {
    "bunny": "models/bunny_75k.off",
    "armadillo": "models/armadillo_52k.off",
    "pig": "models/pig_filled.stl",
    "mandible": "medical/mandible_repaired_mm.stl",
    "foot": "medical/foot_right_bodyparts3d.stl",
    "skull": "medical/skull_d.stl",
}
UPRIGHT = {"bunny", "armadillo"}  # stored with y upwards


class MissingModels(FileNotFoundError):  # noqa: N818 - said of a folder
    """The models are not there."""


def folder() -> Path:
    """Return the folder of the models."""
    default = Path(__file__).resolve().parents[3] / "shared" / "data"
    found = Path(os.environ.get("INFILL_DATA", default))
    if not found.is_dir():
        raise MissingModels(f"no models at {found}; set INFILL_DATA to the folder that holds models/ and silhouettes/")
    return found


def surface(name: str) -> Surface:
    """Return a model with z upwards, in its own lengths."""
    path = folder() / FILES[name]
    if not path.is_file():
        raise MissingModels(f"there is no {path}")
    mesh = read_mesh(path)
    if name not in UPRIGHT:
        return mesh
    x, y, z = mesh.vertices.T
    return Surface(vertices=np.stack([x, -z, y], axis=1), faces=mesh.faces)


def voxels(name: str, cells: int = 180) -> Field:
    """Return a model on a cubic grid of cells / 0.9 a side: as 180 cells of the 200 that span (-1, 1)."""
    solid = voxelise(surface(name), resolution=cells, margin=0)
    return embedded(solid.values, (round(cells / 0.9),) * 3)


def silhouette(name: str, n: int) -> Field:
    """Return a silhouette on n x n cells, [x, y] with y upwards: solid where more than half of the cell is covered."""
    path = folder() / "silhouettes" / f"{name}.png"
    if not path.is_file():
        raise MissingModels(f"there is no {path}")
    with Image.open(path) as picture:
        values = np.asarray(picture.convert("L").resize((n, n), Image.Resampling.BOX), dtype=np.float64)
    return binary(values[::-1].T > 127.5)
