"""What readers of others say of a file. A reader that refuses it, or fails, has no opinion."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

LONGEST = 20  # s for a reader that may crash


@dataclass(frozen=True, kw_only=True)
class MeshOpinion:
    reader: str
    closed: bool
    extents: NDArray[np.float64]  # mm
    area: float | None  # mm²; None where polygons are cut by fans, which may leave them


@dataclass(frozen=True, kw_only=True)
class VolumeOpinion:
    reader: str
    shape: list[int]  # sorted
    values: NDArray[np.float64]
    sizes: NDArray[np.float64] | None  # mm, of a cell


Opinion = TypeVar("Opinion", MeshOpinion, VolumeOpinion)


def mesh_opinions(path: Path) -> list[MeshOpinion]:
    """Ask trimesh, and meshio where it knows the format."""
    return [*_asked("trimesh", _by_trimesh, path), *_asked("meshio", _by_meshio, path)]


def volume_opinions(path: Path) -> list[VolumeOpinion]:
    """Ask nibabel, SimpleITK, tifffile or NumPy."""
    name = path.name.lower()
    readers = {
        (".nii", ".nii.gz", ".mgz"): _by_nibabel,
        (".mha", ".nrrd"): _by_simpleitk,
        (".tif",): _by_tifffile,
        (".npy",): _by_numpy,
    }
    found = next((reader for suffixes, reader in readers.items() if name.endswith(suffixes)), None)
    return _asked(found.__name__.removeprefix("_by_"), found, path) if found else []


def _asked(name: str, read: Callable[[Path], Iterator[Opinion]], path: Path) -> list[Opinion]:
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            return list(read(path))
    except (Exception, SystemExit):  # noqa: BLE001 - others fail in every way there is
        return []


def mesh_opinion(
    reader: str, points: NDArray[np.float64], faces: NDArray[np.int64], *, fans: bool = False
) -> MeshOpinion:
    """Judge triangles: closed where every edge, between places and not numbers of corners, has an even count."""
    # Text may say more digits than STL holds: corners that are one there are one here.
    _, places = np.unique(points.astype(np.float32) + 0.0, axis=0, return_inverse=True)
    corners = places.reshape(-1)[faces]
    whole = corners[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]
    edges = np.sort(np.concatenate([whole[:, [0, 1]], whole[:, [1, 2]], whole[:, [2, 0]]]), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    triangles = points[faces]
    area = (
        np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1).sum() / 2
    )
    return MeshOpinion(
        reader=reader,
        closed=bool(len(whole) and (counts % 2 == 0).all()),
        extents=np.ptp(points[faces].reshape(-1, 3), axis=0),
        area=None if fans else float(area),
    )


def _by_trimesh(path: Path) -> Iterator[MeshOpinion]:
    import trimesh

    loaded = trimesh.load(path, process=False)
    mesh = loaded.to_mesh() if isinstance(loaded, trimesh.Scene) else loaded
    if isinstance(mesh, trimesh.Trimesh) and len(mesh.faces):
        scale = 1000.0 if path.suffix == ".glb" else 1.0
        points, faces = np.asarray(mesh.vertices, float) * scale, np.asarray(mesh.faces)
        if np.isfinite(points).all() and faces.min() >= 0 and faces.max() < len(points):
            yield mesh_opinion("trimesh", points, faces, fans=path.suffix.lower() in (".obj", ".ply", ".off"))


def _by_meshio(path: Path) -> Iterator[MeshOpinion]:
    import meshio

    if path.suffix.lower() not in (".stl", ".obj", ".ply", ".off"):
        return
    mesh = meshio.read(path)
    faces = [cells.data for cells in mesh.cells if cells.type == "triangle"]
    if faces and len(faces) == len(mesh.cells):  # only triangles: others are cut in more ways than one
        yield mesh_opinion("meshio", np.asarray(mesh.points, float), np.concatenate(faces).astype(np.int64))


def _by_nibabel(path: Path) -> Iterator[VolumeOpinion]:
    import nibabel

    image = nibabel.load(path)
    sizes = np.linalg.norm(np.asarray(image.affine)[:3, :3], axis=0)
    values = np.asarray(image.get_fdata())
    values = values.reshape([*values.shape[:3], *(n for n in values.shape[3:] if n > 1)])
    unit = getattr(image.header, "get_xyzt_units", lambda: ("mm", ""))()[0]
    scale = {"meter": 1000.0, "micron": 1e-3}.get(unit, 1.0)
    yield VolumeOpinion(reader="nibabel", shape=sorted(values.shape), values=values, sizes=sizes * scale)


def _by_tifffile(path: Path) -> Iterator[VolumeOpinion]:
    import tifffile

    values = np.squeeze(tifffile.imread(path))
    yield VolumeOpinion(reader="tifffile", shape=sorted(values.shape), values=values.astype(float), sizes=None)


def _by_numpy(path: Path) -> Iterator[VolumeOpinion]:
    values = np.load(path, allow_pickle=False)
    yield VolumeOpinion(reader="numpy", shape=sorted(values.shape), values=values.astype(float), sizes=None)


SCRIPT = """
import sys, numpy, SimpleITK
SimpleITK.ProcessObject.SetGlobalWarningDisplay(False)
image = SimpleITK.ReadImage(sys.argv[1])
turned = numpy.reshape(image.GetDirection(), (len(image.GetSpacing()),) * 2)  # its columns may be longer than 1
sizes = image.GetSpacing() * numpy.linalg.norm(turned, axis=0)
numpy.savez(sys.argv[2], values=SimpleITK.GetArrayViewFromImage(image), sizes=sizes)
"""


def _lacks_packed_size(path: Path) -> bool:
    head = path.read_bytes()[:4096]
    return b"CompressedData = True" in head and b"CompressedDataSize" not in head


def _by_simpleitk(path: Path) -> Iterator[VolumeOpinion]:
    """Ask in a process of its own: it may crash."""
    if _lacks_packed_size(path):
        return  # it takes half of what is packed for the whole
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "read.npz"
        subprocess.run(
            [sys.executable, "-c", SCRIPT, str(path), str(target)], check=True, timeout=LONGEST, capture_output=True
        )
        read = np.load(target)
        values = read["values"].astype(float)
        yield VolumeOpinion(
            reader="SimpleITK", shape=sorted(values.shape), values=values, sizes=np.array(read["sizes"])
        )
