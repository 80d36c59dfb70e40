"""What a browser is sent of a surface: the same triangles, and vertices within half a step."""

from __future__ import annotations

import json
import shutil
import subprocess
import zlib
from itertools import count
from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray
from skimage.measure import marching_cubes

from infill.errors import ParameterError
from infill.surface import Surface
from infill.viewer import packing
from infill.viewer.compact import encode_compact
from infill.viewer.packing import STEPS, pack_surfaces, quantise
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


# --- compact triangles -----------------------------------------------------------------------------------


def unfold(data: bytes, size: int, columns: int) -> NDArray:
    """Return numbers of which the bytes lie in planes, the lowest first."""
    planes = np.frombuffer(data, np.uint8).reshape(size, columns, -1).astype(np.int64)
    return sum(planes[byte] << (8 * byte) for byte in range(size)).T


def follow(symbols: list[int], named: list[int], places: NDArray, triangles: int) -> tuple[NDArray, NDArray]:
    """Draw triangles by the words at the top of compact.py, with loops as lists of edges, and nothing clever."""
    steps, faces, stack = [], [], []
    symbols, named = iter(symbols), iter(named)
    alive, after, before, latest, serial = set(), {}, {}, {}, count()

    def vertex(predicted: NDArray) -> int:
        coded = places[len(steps)]
        steps.append((predicted + np.where(coded & 1, -(coded + 1) // 2, coded // 2)) % 2**16)
        return len(steps) - 1

    def edge(a: int, b: int, apex: int) -> tuple:
        new = (a, b, apex, next(serial))
        alive.add(new)
        latest[a] = new
        stack.append(new)
        return new

    def link(first: tuple, second: tuple) -> None:
        after[first], before[second] = second, first

    while len(faces) < triangles:
        corners = []
        for _ in range(3):
            ago = next(named)
            corners.append(len(steps) - ago if ago else vertex(steps[-1] if steps else np.zeros(3, dtype=np.int64)))
        x, y, z = corners
        faces.append(corners)
        one, two, three = edge(x, y, z), edge(y, z, x), edge(z, x, y)
        link(one, two), link(two, three), link(three, one)
        while stack:
            gate = stack.pop()
            if gate not in alive or (symbol := next(symbols)) == 5:
                continue
            a, b, apex, _ = gate
            previous, following = before[gate], after[gate]
            alive.discard(gate)
            if symbol in (1, 2, 3):
                c = previous[0] if symbol == 2 else following[1]
                alive.difference_update([previous] * (symbol > 1) + [following] * (symbol != 2))
                start = before[previous] if symbol > 1 else previous
                stop = after[following] if symbol != 2 else following
                if symbol == 3:
                    link(start, stop)
                else:
                    new = edge(a, c, b) if symbol == 1 else edge(c, b, a)
                    link(start, new), link(new, stop)
            else:
                c = len(steps) - next(named) if symbol == 4 else vertex(steps[a] + steps[b] - steps[apex])
                other = latest.get(c)
                left, right = edge(a, c, b), edge(c, b, a)
                if symbol == 4 and other in alive:
                    link(before[other], right), link(left, other)
                else:
                    link(left, right)
                link(previous, left), link(right, following)
            faces.append([b, a, c])
    return np.array(steps).reshape(-1, 3), np.array(faces).reshape(-1, 3)


def as_set(vertices: NDArray, faces: NDArray) -> list:
    """Return triangles by the places of their corners, whichever comes first, sorted."""
    turned = [[tuple(vertices[i]) for i in face] for face in faces.tolist()]
    return sorted(min(face[k:] + face[:k] for k in range(3)) for face in turned)


def knotted() -> tuple[NDArray, NDArray]:
    """Return triangles of every unwelcome kind: an edge with three, a vertex twice, one twice, a fan that is open."""
    places = np.random.default_rng(3).integers(0, STEPS + 1, (12, 3)).astype(np.uint16)
    faces = [[0, 1, 2], [1, 0, 3], [0, 1, 4], [5, 5, 6], [6, 5, 7], [8, 9, 10], [8, 9, 10], [2, 1, 11], [11, 1, 8]]
    return places, np.array(faces)


def compact_cases() -> dict[str, tuple[NDArray, NDArray]]:
    rng = np.random.default_rng(4)
    cases = {"knotted": knotted()}
    for name, mesh in {"ball": ball(9.0, 2), "box": box(1, 2, 3), "two": box(1, 1, 1) + ball(3.0, 1)}.items():
        cases[name] = quantise(np.asarray(mesh.vertices))[2], np.asarray(mesh.faces)
        keep = rng.random(len(mesh.faces)) < 0.7
        cases[f"{name} with holes"] = cases[name][0], cases[name][1][keep]
    torus = trimesh.creation.torus(5, 2, major_sections=12, minor_sections=8)
    cases["torus"] = quantise(torus.vertices)[2], rng.permutation(torus.faces)
    cases["soup"] = rng.integers(0, STEPS, (9, 3)).astype(np.uint16), rng.integers(0, 9, (40, 3))
    return cases


@pytest.mark.parametrize("name", compact_cases())
def test_compact_triangles_are_the_same_whatever_the_mesh(name: str) -> None:
    steps, faces = compact_cases()[name]
    coded = encode_compact(faces, steps)
    places, corners = follow(
        coded.symbols.tolist(),
        unfold(coded.named.tobytes(), 4, 1).ravel().tolist(),
        unfold(coded.places.tobytes(), 2, 3),
        len(faces),
    )
    assert (places == steps[coded.origin]).all()
    assert as_set(places, corners) == as_set(steps.astype(int), faces)
    assert sorted(coded.origin) == sorted(set(faces.ravel()))


def test_the_page_reads_compact_triangles(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(packing, "COMPACT_FROM", 0)
    cases = compact_cases()
    surfaces = {name: Surface(vertices=steps.astype(float), faces=faces) for name, (steps, faces) in cases.items()}
    values = {name: (np.arange(len(each.vertices)) % 256).astype(np.uint8) for name, each in surfaces.items()}
    plain = read_in_node(pack_surfaces(surfaces, values=values), tmp_path)
    compact = read_in_node(pack_surfaces(surfaces, values=values, compact=True), tmp_path)
    for one, other in zip(plain, compact, strict=True):
        corners = [
            np.column_stack([np.array(each["positions"]).reshape(-1, 3), each["values"]]) for each in (one, other)
        ]
        faces = [np.array(each["indices"]).reshape(-1, 3) for each in (one, other)]
        assert as_set(corners[0], faces[0]) == as_set(corners[1], faces[1]), one["name"]


def test_compact_triangles_of_a_smooth_solid_take_three_bytes_each() -> None:
    """Before base64: 650 thousand of them, and the page around them, stay below 2.5 MB."""
    z, y, x = np.mgrid[-1:1:64j, -1:1:64j, -1:1:64j] * 7
    field = np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)
    vertices, faces, _, _ = marching_cubes(np.pad(np.abs(field) - 0.4, 1, constant_values=1.0), 0)
    surface = Surface(vertices=vertices, faces=faces)
    size = len(zlib.compress(pack_surfaces({"gyroid": surface}, compact=True), 9)) / len(faces)
    assert size < 3
    assert size < 0.5 * len(zlib.compress(pack_surfaces({"gyroid": surface}), 9)) / len(faces)
