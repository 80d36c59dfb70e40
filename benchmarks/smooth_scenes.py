"""The scans of the test data, as files that the command reads, and as the surfaces that they show."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import trimesh
from numpy.typing import NDArray


@dataclass(frozen=True)
class Scan:
    """A volume and what is solid in it; `array` is the key of the data in the .npz, [z, y, x]."""

    file: str
    array: str
    threshold: float | None  # None for a mask

    @property
    def level(self) -> float:
        """Where the surface lies: just under the threshold, since a cell at it is solid; and off all ties.

        Where four cells of a face tie, marching cubes takes different sides and leaves the surface open.
        """
        return 0.499 if self.threshold is None else self.threshold - 0.25  # values are whole


SCANS = {
    "CT head, bone at 226": Scan("ct_head_cranium_int16.npz", "hu", 226),
    "headsq, bone at 1150": Scan("ct_headsq_64x64x93_uint16.npz", "value", 1150),
    "headsq, skin at 500": Scan("ct_headsq_64x64x93_uint16.npz", "value", 500),
    "skull, a mask": Scan("seg_skull_label_seg3d.npz", "label", None),
}


@dataclass(frozen=True)
class Image:
    """Values at the centres of cells, [z, y, x]; the first centre is at 0, mm."""

    values: NDArray[np.generic]
    spacing: NDArray[np.float64]  # (3,), mm, in z, y and x


def read(folder: Path, scan: Scan) -> Image:
    with np.load(folder / "volumes" / scan.file) as stored:
        return Image(stored[scan.array], np.asarray(stored["spacing_zyx_mm"], dtype=np.float64))


def write(image: Image, path: Path) -> Path:
    """Write an image as ITK does, whose place for the origin is the centre of the first cell."""
    import SimpleITK

    told = SimpleITK.GetImageFromArray(np.ascontiguousarray(image.values))
    told.SetSpacing(image.spacing[::-1].tolist())
    SimpleITK.WriteImage(told, str(path))
    return path


def isosurface(image: Image, level: float) -> trimesh.Trimesh:
    """Return scikit-image's marching cubes of the grey values, mm in x, y and z.

    What reaches the rim of the image ends half a cell outside the last centres, where the cells end.
    """
    from skimage.measure import marching_cubes

    grey = np.pad(image.values.astype(np.float64), 1, mode="edge")
    for axis in range(3):
        for end in (0, -1):
            rim = np.moveaxis(grey, axis, 0)[end]
            rim[...] = np.where(rim > level, 2 * level - rim, rim)
    vertices, faces, _, _ = marching_cubes(grey, level, allow_degenerate=False)
    mesh = trimesh.Trimesh(vertices=((vertices - 1) * image.spacing)[:, ::-1], faces=faces, process=True)
    if mesh.volume < 0:
        mesh.invert()
    return mesh
