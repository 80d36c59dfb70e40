"""Tiles of a volume in chunks, read back by a few lines of their own: the triangles are those of other files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import zarr
from numpy.typing import NDArray
from test_chunked_command import PLAIN, gyroid
from test_command_line import refused, run

from infill.chunks.hashing import add_up, face_sums
from infill.smoothing import chunk_plans

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(chunk_plans, "LARGEST_CELLS", 32)
    values = gyroid(50, 30)
    zarr.create_array("t.zarr", shape=values.shape, chunks=(32,) * 3, dtype="u1")[:] = values
    return tmp_path


def read_tiles(folder: Path, segment: int) -> list[tuple[NDArray[Any], NDArray[Any]]]:
    """Read the fragments of a segment, as the specification of the format says."""
    assert json.loads((folder / "info").read_text()) == {"@type": "neuroglancer_legacy_mesh"}
    fragments = []
    for name in json.loads((folder / f"{segment}:0").read_text())["fragments"]:
        data = (folder / name).read_bytes()
        count = int.from_bytes(data[:4], "little")
        vertices = np.frombuffer(data, "<f4", 3 * count, 4).reshape(-1, 3)
        faces = np.frombuffer(data, "<u4", offset=4 + 12 * count).reshape(-1, 3)
        assert faces.max() < count
        fragments.append((vertices, faces))
    return fragments


def read_ply(path: str) -> tuple[NDArray[Any], NDArray[Any]]:
    data = Path(path).read_bytes()
    head, _, body = data.partition(b"end_header\n")
    vertices, faces = (int(line.split()[2]) for line in head.decode().splitlines() if line.startswith("element"))
    rows = np.frombuffer(body, [("count", "u1"), ("corners", "<i4", 3)], faces, 12 * vertices)
    return np.frombuffer(body, "<f4", 3 * vertices).reshape(-1, 3), rows["corners"]


@pytest.mark.long
@pytest.mark.parametrize("tolerance", ["0", "0.1"])
def test_tiles_have_the_triangles_of_a_ply(tolerance: str, folder: Path) -> None:
    words = ("--spacing", "1", "-o", "a.precomputed", "-o", "a.ply", "-q")
    assert run("smooth", "t.zarr", *PLAIN[:4], "--tolerance", tolerance, *words).exit_code == 0
    tiles = read_tiles(folder / "a.precomputed", 1)
    assert len(tiles) >= 8
    vertices, faces = read_ply("a.ply")
    nanometres = np.concatenate([points for points, _ in tiles])
    begins = np.cumsum([0, *(len(points) for points, _ in tiles)])
    corners = np.concatenate([face.astype(np.int64) + begin for (_, face), begin in zip(tiles, begins, strict=False)])
    # Every vertex of a tile is one of the PLY, and the triangles are the same.
    from scipy.spatial import cKDTree

    distance, nearest = cKDTree(vertices.astype(np.float64)).query(nanometres.astype(np.float64) * 1e-6)
    assert distance.max() < 2e-5  # 32 bits of 50 mm
    found, expected = nearest[corners], faces
    sums = [add_up([face_sums(vertices, triangles, 1.0)], 1.0)[:2] for triangles in (found, expected)]
    assert sums[0] == sums[1]
    assert sums[0][1]  # closed
    assert len(found) == len(expected)
    # To the bit between tiles: the whole is closed by its coordinates alone.
    assert add_up([face_sums(points, triangles.astype(np.int64), 1e12) for points, triangles in tiles], 1e12)[1]


def test_a_label_is_the_segment(folder: Path) -> None:
    np.save("labels.npy", (gyroid(40, 30) > 120).astype(np.uint8) * 7)
    words = ("--smooth", "plain", "--workers", "1", "--label", "7", "-o", "a.precomputed", "-q")
    assert run("smooth", "labels.npy", *words).exit_code == 0
    assert len(read_tiles(folder / "a.precomputed", 7)) > 1


def test_folders_that_exist(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    words = ("smooth", "t.zarr", *PLAIN, "-q", "-o", "a.precomputed")
    Path("a.precomputed").mkdir()
    Path("a.precomputed/letter.txt").touch()
    refused(run(*words), "a.precomputed exists; give another name, or --force")
    refused(run(*words, "--force"), "a.precomputed is a folder that holds other files; give another name")
    refused(run("smooth", "t.zarr", *PLAIN, "-o", "none/a.precomputed"), "there is no folder none; make it first")
    Path("a.precomputed/letter.txt").unlink()
    assert run(*words, "--force").exit_code == 0
    before = {path.name: path.read_bytes() for path in Path("a.precomputed").iterdir()}
    from infill.formats.mesh_pieces import PrecomputedPieces

    def fail(self: object) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(PrecomputedPieces, "finish", fail)
        refused(run(*words, "--force"), "cannot write a.precomputed: the disk is full")
    assert {path.name: path.read_bytes() for path in Path("a.precomputed").iterdir()} == before
    assert {path.name for path in folder.iterdir()} == {"t.zarr", "a.precomputed"}
    assert run(*words, "--force").exit_code == 0
    assert {path.name: path.read_bytes() for path in Path("a.precomputed").iterdir()} == before
