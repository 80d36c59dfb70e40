"""What a browser is sent of a surface: the same triangles, and vertices within half a step."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from infill.errors import ParameterError
from infill.surface import Surface
from infill.viewer.packing import STEPS, pack_surfaces
from tests.made_shapes import ball, box

ROOT = Path(__file__).resolve().parents[1]
FLOAT32 = 2.0**-23  # relative: the page keeps positions as float32


def surface_of(mesh) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces))


def unpack(data: bytes) -> dict[str, tuple[NDArray, NDArray, NDArray | None]]:
    """Read packed surfaces, by the words at the top of packing.py and nothing else."""
    assert data[:4] == b"IFM1"
    start = 8 + int.from_bytes(data[4:8], "little")
    body = data[start:]
    assert start % 4 == 0
    found = {}
    for entry in json.loads(data[8:start])["surfaces"]:
        assert not (entry["positions"] | entry["indices"] | (entry["values"] or 0)) & 3
        steps = np.frombuffer(body, "<u2", 3 * entry["vertices"], entry["positions"]).reshape(-1, 3)
        faces = np.frombuffer(body, "<u4", 3 * entry["triangles"], entry["indices"]).cumsum(dtype=np.uint32)
        values = entry["values"]
        if values is not None:
            values = np.frombuffer(body, "u1", entry["vertices"], values)
        found[entry["name"]] = (
            np.array(entry["low"]) + np.array(entry["size"]) * steps / STEPS,
            faces.reshape(-1, 3),
            values,
        )
    return found


def half_step(vertices: NDArray) -> NDArray:
    """Return how far a vertex may move along each axis: half a step, and what float32 cannot hold."""
    return np.ptp(vertices, axis=0) / STEPS / 2 + 2 * FLOAT32 * np.abs(vertices).max(axis=0) + 1e-300


@given(arrays(np.float64, (7, 3), elements=st.floats(-1e4, 1e4)), st.permutations(range(7)))
def test_vertices_move_by_half_a_step_at_most_and_faces_stay(vertices: NDArray, order: list[int]) -> None:
    faces = np.array([order[:3], order[3:6], order[4:]])
    [(positions, indices, _)] = unpack(pack_surfaces({"any": Surface(vertices=vertices, faces=faces)})).values()
    assert (np.abs(positions - vertices) <= half_step(vertices)).all()
    assert (indices == faces).all()


def test_several_surfaces_keep_names_colours_and_values() -> None:
    surfaces = {"shell": surface_of(ball(10.0)), "infill ü": surface_of(box(3, 4, 5))}
    values = np.arange(8, dtype=np.uint8)
    data = pack_surfaces(surfaces, colours={"shell": (1.0, 0.5, 0.0)}, values={"infill ü": values})
    header = json.loads(data[8 : 8 + int.from_bytes(data[4:8], "little")])
    assert [(entry["name"], entry["colour"], entry["closed"]) for entry in header["surfaces"]] == [
        ("shell", [1.0, 0.5, 0.0], True),
        ("infill ü", None, True),
    ]
    found = unpack(data)
    assert found["shell"][2] is None
    assert (found["infill ü"][2] == values).all()


def test_an_open_or_empty_surface_says_so() -> None:
    square = Surface(vertices=np.eye(3), faces=np.array([[0, 1, 2]]))
    empty = Surface(vertices=np.zeros((0, 3)), faces=np.zeros((0, 3), dtype=np.int64))
    data = pack_surfaces({"open": square, "empty": empty})
    assert [len(faces) for _, faces, _ in unpack(data).values()] == [1, 0]
    assert data.count(b'"closed":false') == 2


def test_values_that_are_too_few_are_refused() -> None:
    with pytest.raises(ParameterError, match="8 vertices"):
        pack_surfaces({"box": surface_of(box(1, 1, 1))}, values={"box": np.zeros(3, dtype=np.uint8)})


READER = """
import { readFileSync } from "node:fs";
import { decodeMesh } from "./page/src/viewer/mesh.js";
const file = readFileSync(process.argv[1]);
const { surfaces } = decodeMesh(file.buffer.slice(file.byteOffset, file.byteOffset + file.length));
const plain = surfaces.map((s) => ({ ...s, positions: [...s.positions], indices: [...s.indices],
  values: s.values && [...s.values] }));
console.log(JSON.stringify(plain));
"""


def read_in_node(data: bytes, folder: Path) -> list[dict]:
    node = shutil.which("node")
    if node is None:
        pytest.skip("no node here; the browser's tests read the same bytes")
    path = folder / "packed"
    path.write_bytes(data)
    command = [node, "--input-type=module", "--eval", READER, str(path)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, check=True, encoding="utf-8", timeout=60)
    return json.loads(done.stdout)


def test_the_page_reads_what_is_packed(tmp_path: Path) -> None:
    surfaces = {"ball": surface_of(ball(25.0)), "far": surface_of(box(3, 4, 5, at=(900, -700, 2)))}
    data = pack_surfaces(surfaces, values={"far": np.arange(8, dtype=np.uint8)})
    for (name, surface), read in zip(surfaces.items(), read_in_node(data, tmp_path), strict=True):
        assert read["name"] == name
        assert read["closed"]
        positions = np.array(read["positions"]).reshape(-1, 3)
        assert (np.abs(positions - surface.vertices) <= half_step(surface.vertices)).all()
        assert (np.array(read["indices"]).reshape(-1, 3) == surface.faces).all()
    assert read["values"] == list(range(8))
