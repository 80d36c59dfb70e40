"""Mesh files damaged at random, with a fixed seed: read, or refused in one line; never anything else."""

from __future__ import annotations

import copy
import json
import math
import random
import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import test_glb_dialects as glb
import test_obj_dialects as obj
import test_ply_dialects as ply
import trimesh
from hypothesis import example, given
from hypothesis import strategies as st

from infill import FormatError, Surface, check, read_mesh
from infill.errors import InfillError
from infill.meshes.solids import manifold_status

WORDS = [
    "0", "-1", "3", "8", "1e400", "nan", "inf", "99999999999999999999", "1,5", "", "x", "\x1b[2J", "#", "\\", "/", "1/2/3",
    "f", "v", "4294967295", "-2147483648", "0x10", "1_0", "\r", "end_header", "element face 5",
]  # fmt: skip
VALUES = [
    0,
    -1,
    1,
    7,
    1e308,
    None,
    True,
    "x",
    [],
    {},
    "\x1b[2J",
    10**12,
    0.5,
    [0, 0, 0],
    [math.nan] * 16,
    5121,
    5126,
    "VEC3",
]


def damage_text(rng: random.Random, data: bytes) -> bytes:
    lines = data.decode("latin-1").split("\n")
    for _ in range(rng.choice([1, 1, 2, 3])):
        place = rng.randrange(len(lines))
        words = lines[place].split(" ")
        match rng.randrange(6):
            case 0:
                lines.insert(place, rng.choice(lines))
            case 1:
                other = rng.randrange(len(lines))
                lines[place], lines[other] = lines[other], lines[place]
            case 2:
                del words[rng.randrange(len(words))]
                lines[place] = " ".join(words)
            case _:
                words[rng.randrange(len(words))] = rng.choice(WORDS)
                lines[place] = " ".join(words)
    return "\n".join(lines).encode("latin-1")


def damage_bytes(rng: random.Random, data: bytes) -> bytes:
    changed = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 5])):
        place = rng.randrange(len(changed))
        match rng.randrange(4):
            case 0:
                del changed[place : place + rng.choice([1, 4, 12, 50])]
            case 1:
                changed[place:place] = rng.choice(WORDS).encode()
            case _:
                changed[place] = rng.choice([0, 255, 127, 128, 32, 10, rng.randrange(256)])
        changed = changed or bytearray(b"x")
    return bytes(changed)


def damage_json(rng: random.Random, data: bytes) -> bytes:
    size = struct.unpack_from("<I", data, 12)[0]
    document, rest = json.loads(data[20 : 20 + size]), data[20 + size :]
    for _ in range(rng.choice([1, 1, 2])):
        holder, key, value = None, None, document
        while isinstance(value, (dict, list)) and value and (holder is None or rng.random() < 0.85):
            holder = value
            key = rng.choice(list(holder)) if isinstance(holder, dict) else rng.randrange(len(holder))
            value = holder[key]
        if rng.random() < 0.2:
            del holder[key]
        elif type(value) is int and rng.random() < 0.6:
            holder[key] = value + rng.choice([-1, 1, 12, -12, 36])
        else:
            holder[key] = copy.deepcopy(rng.choice(VALUES))
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return (
        struct.pack("<4sII", b"glTF", 2, 20 + len(text) + len(rest))
        + struct.pack("<I4s", len(text), b"JSON")
        + text
        + rest
    )


def whole_glb() -> bytes:
    nodes = [
        {"children": [1], "rotation": [0, 0, 1, 0]},
        {"mesh": 0, "matrix": [2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]},
    ]
    writer = glb.Writer()
    writer.finish([writer.box(), writer.box(mode=4)], nodes)
    writer.document["scenes"] = [{"nodes": [0]}]
    return writer.glb()


Damage = Callable[[random.Random, bytes], bytes]
SEEDS: dict[str, tuple[str, bytes, list[Damage]]] = {
    "obj": (".obj", obj.TEXT.encode(), [damage_text, damage_text, damage_bytes]),
    "obj with all": (".obj", obj.DIALECTS["texture and normals"].encode(), [damage_text, damage_bytes]),
    "ply": (".ply", ply.PLAIN.encode(), [damage_text, damage_text, damage_bytes]),
    "binary ply": (".ply", ply.ply("binary_big_endian", [ply.points(ply.HALVED), ply.faces(ply.HALVED)]), [damage_bytes]),
    "off": (".off", ply.OFFS["colours of some faces"].encode(), [damage_text, damage_bytes]),
    "stl": (".stl", ply.stl(ply.CORNERS).encode(), [damage_text, damage_bytes]),
    "binary stl": (".stl", ply.binary_stl(ply.CORNERS), [damage_bytes]),
    "glb": (".glb", whole_glb(), [damage_json, damage_json, damage_json, damage_bytes]),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", SEEDS)
def test_a_damaged_file_is_read_or_refused_in_one_line(name: str, tmp_path: Path) -> None:
    suffix, data, kinds = SEEDS[name]
    rng = random.Random(f"{name} 1")
    path, refused = tmp_path / f"part{suffix}", []
    for number in range(100):
        path.write_bytes(rng.choice(kinds)(rng, data))
        try:
            mesh = read_mesh(path)
            if number % 20 == 0:
                json.dumps(check(path).to_dict())
        except InfillError as error:
            refused.append(str(error))
        else:
            assert np.isfinite(mesh.vertices).all()
            assert mesh.faces.max() < len(mesh.vertices)
    assert 0 < len(refused) < 100
    assert [each for each in refused if not each.isprintable()] == []


def test_check_of_triangles_without_an_area(tmp_path: Path) -> None:
    """A scale that flattens, say, in a file that does not state it."""
    line = Surface(
        vertices=np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [5, 0, 0]]), faces=np.array([[0, 1, 2], [1, 3, 2]])
    )
    with pytest.raises(FormatError, match="no triangle with an area"):
        check(line)


def test_a_corner_beyond_all_measure_is_refused(tmp_path: Path) -> None:
    """Squares of it would be infinite, and an area not a number."""
    path = tmp_path / "far.off"
    path.write_text("OFF\n4 4 0\n0 0 0\n1e308 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n")
    with pytest.raises(FormatError, match="holds a corner at over 1,000,000,000,000,000 km; the limit is 1,000,000 km"):
        read_mesh(path)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-32"])
def test_text_of_wide_letters_is_no_binary_stl(encoding: str, tmp_path: Path) -> None:
    """Its letters would be read as a count of triangles."""
    box = trimesh.creation.box((3, 4, 5))
    path = tmp_path / "box.stl"
    path.write_bytes(("solid body" + " " * 60 + trimesh.exchange.stl.export_stl_ascii(box)[5:]).encode(encoding))
    assert np.ptp(read_mesh(path).vertices, axis=0) == pytest.approx((3, 4, 5))


# --- open meshes and manifold3d --------------------------------------------------------------------------

SIDES = [(-1, -1, -1), (1, -1, -1), (-1, 1, -1), (1, 1, -1), (1, 1, 1), (-1, -1, 1), (1, -1, 1), (-1, 1, 1)]
CORNERS = np.array(SIDES) * (10.0, 5.0, 2.5)
# In this order manifold3d 3.5.4 ends its process with a segmentation fault.
UNLUCKY = [
    (5, 7, 0),
    (1, 5, 0),
    (0, 7, 2),
    (2, 1, 0),
    (5, 4, 7),
    (6, 5, 1),
    (6, 4, 5),
    (7, 4, 2),
    (3, 1, 2),
    (2, 4, 3),
    (4, 6, 3),
]


@given(st.permutations(UNLUCKY), st.integers(0, len(UNLUCKY)))
@example(UNLUCKY, len(UNLUCKY))
def test_an_open_mesh_in_any_order_is_no_solid(faces: list[tuple[int, int, int]], count: int) -> None:
    surface = Surface(vertices=CORNERS, faces=np.array(faces[:count], dtype=np.int64).reshape(-1, 3))
    for single in (True, False):
        assert manifold_status(surface, single=single) == "NotManifold"
