"""glTF as the programs of the world write it: one box in many forms, or a refusal that names what is not known."""

from __future__ import annotations

import base64
import copy
import json
import math
import struct
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import DracoPy
import numpy as np
import pytest
import trimesh
from polygon_meshes import BOX

from infill import FormatError, InfillError, check, read_mesh
from infill.errors import MemoryLimitError

POINTS = BOX.vertices / 1000  # m
TRIANGLES = np.array([[a, b, c] for a, *rest in BOX.polygons for b, c in zip(rest, rest[1:], strict=False)])
FORMS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Writer:
    """Collects numbers and items, and writes them as .glb or .gltf."""

    def __init__(self, **document: Any) -> None:
        self.blob = b""
        self.document: dict[str, Any] = {"asset": {"version": "2.0"}, "accessors": [], "bufferViews": [], **document}

    def view(self, data: bytes, **more: Any) -> int:
        self.blob += bytes(-len(self.blob) % 4)
        self.document["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.blob), "byteLength": len(data), **more}
        )
        self.blob += data
        return len(self.document["bufferViews"]) - 1

    def accessor(self, values: Any, kind: int, shape: str = "VEC3", *, pad: int = 0, **more: Any) -> int:
        rows = np.asarray(values).reshape(-1, WIDTHS[shape]).astype(FORMS[kind])
        data = b"".join(row.tobytes() + bytes(pad) for row in rows)
        stride = {"byteStride": rows.itemsize * rows.shape[1] + pad} if pad else {}
        item = {"bufferView": self.view(data, **stride), "componentType": kind, "count": len(rows), "type": shape}
        self.document["accessors"].append({**item, **more})
        return len(self.document["accessors"]) - 1

    def box(self, **more: Any) -> dict[str, Any]:
        points = self.accessor(POINTS, 5126)
        return {"attributes": {"POSITION": points}, "indices": self.accessor(TRIANGLES, 5125, "SCALAR"), **more}

    def finish(self, primitives: list[dict[str, Any]], nodes: list[dict[str, Any]] | None = None, **more: Any) -> None:
        self.document |= {
            "scene": 0,
            "scenes": [{"nodes": list(range(len(nodes or [0])))}],
            "nodes": nodes or [{"mesh": 0}],
            "meshes": [{"primitives": primitives}],
            "buffers": [{"byteLength": len(self.blob)}],
            **more,
        }

    def glb(self) -> bytes:
        text = json.dumps(self.document).encode()
        text += b" " * (-len(text) % 4)
        blob = self.blob + bytes(-len(self.blob) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        if blob:
            chunks += struct.pack("<I4s", len(blob), b"BIN\0") + blob
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


def write(folder: Path, writer: Writer, name: str = "part.glb") -> Path:
    (folder / name).write_bytes(writer.glb())
    return folder / name


def assert_boxes(
    path: Path, *, at: tuple[float, ...] = (0, 0, 0), count: int = 1, apart: float = 0, near: float = 1e-6
) -> None:
    """Within single precision of metres, or of the integers used."""
    mesh = read_mesh(path)
    assert mesh.closed
    assert len(mesh.faces) == 12 * count
    assert mesh.volume == pytest.approx(24000 * count, rel=3 * near)
    assert mesh.area == pytest.approx(5200 * count, rel=3 * near)
    low = np.array(at)
    assert mesh.bounds == pytest.approx(
        np.array([low, low + np.array([20 + apart * (count - 1), 30, 40])]), abs=200 * near
    )
    assert check(path).printable


def one(primitive: Callable[[Writer], dict[str, Any]], **more: Any) -> Writer:
    writer = Writer(**more)
    writer.finish([primitive(writer)])
    return writer


def needs(*names: str) -> dict[str, list[str]]:
    return {"extensionsUsed": list(names), "extensionsRequired": list(names)}


# --- numbers ---------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "top"), [(5120, 127), (5121, 255), (5122, 32767), (5123, 65535)])
@pytest.mark.parametrize("normalised", [True, False])
@pytest.mark.parametrize("required", [True, False])
@pytest.mark.parametrize("pad", [0, 1, 2, 5])
def test_quantised_corners(kind: int, top: int, normalised: bool, required: bool, pad: int, tmp_path: Path) -> None:
    writer = Writer(**needs("KHR_mesh_quantization") if required else {})
    points = writer.accessor(np.round(POINTS / 0.04 * top), kind, normalized=normalised, pad=pad)
    indices = writer.accessor(TRIANGLES, 5121, "SCALAR")
    scale = [0.04 / (1 if normalised else top)] * 3
    writer.finish([{"attributes": {"POSITION": points}, "indices": indices}], [{"mesh": 0, "scale": scale}])
    assert_boxes(write(tmp_path, writer), near=1 / top)


def test_signed_fractions_are_never_below_minus_one(tmp_path: Path) -> None:
    """-128 and -127 are both -1: glTF 2.0, 3.11."""
    writer = Writer(**needs("KHR_mesh_quantization"))
    points = writer.accessor(np.where(POINTS > 0, 127, -128), 5120, normalized=True)
    indices = writer.accessor(TRIANGLES, 5125, "SCALAR")
    writer.finish(
        [{"attributes": {"POSITION": points}, "indices": indices}], [{"mesh": 0, "scale": [0.01, 0.015, 0.02]}]
    )
    assert_boxes(write(tmp_path, writer), at=(-10, -15, -20), near=1e-6)


@pytest.mark.parametrize("kind", [5121, 5123, 5125])
def test_sparse_corners(kind: int, tmp_path: Path) -> None:
    """All of them, or some instead of those in the buffer; corners of triangles too."""
    for based in (False, True):
        writer = Writer()
        start = POINTS.copy()
        start[[2, 5]] = 9
        given = [2, 5] if based else list(range(8))
        sparse = {
            "count": len(given),
            "indices": {
                "bufferView": writer.view(np.array(given).astype(FORMS[kind]).tobytes()),
                "componentType": kind,
            },
            "values": {"bufferView": writer.view(POINTS[given].astype("<f4").tobytes())},
        }
        points = writer.accessor(start, 5126, sparse=sparse)
        if not based:
            del writer.document["accessors"][points]["bufferView"]
        indices = writer.accessor(TRIANGLES, 5125, "SCALAR")
        writer.finish([{"attributes": {"POSITION": points}, "indices": indices}])
        assert_boxes(write(tmp_path, writer))


def test_interleaved_numbers_and_offsets(tmp_path: Path) -> None:
    writer = Writer()
    rows = np.zeros(8, dtype=[("normal", "<f4", 3), ("place", "<f4", 3), ("colour", "u1", 4)])
    rows["place"] = POINTS
    view = writer.view(bytes(8) + rows.tobytes(), byteStride=rows.itemsize)
    writer.document["accessors"].append(
        {"bufferView": view, "byteOffset": 8 + 12, "componentType": 5126, "count": 8, "type": "VEC3"}
    )
    indices = writer.accessor(TRIANGLES, 5123, "SCALAR")
    writer.finish([{"attributes": {"POSITION": 0}, "indices": indices}])
    assert_boxes(write(tmp_path, writer))


# --- triangles -------------------------------------------------------------------------------------------


def soup(writer: Writer) -> dict[str, Any]:
    return {"attributes": {"POSITION": writer.accessor(POINTS[TRIANGLES], 5126)}}


def fans(writer: Writer) -> list[dict[str, Any]]:
    points = writer.accessor(POINTS, 5126)
    return [
        {"attributes": {"POSITION": points}, "indices": writer.accessor(each, 5123, "SCALAR"), "mode": 6}
        for each in BOX.polygons
    ]


def test_triangles_without_indices(tmp_path: Path) -> None:
    assert_boxes(write(tmp_path, one(soup)))


def test_fans(tmp_path: Path) -> None:
    writer = Writer()
    writer.finish(fans(writer))
    assert_boxes(write(tmp_path, writer))


def test_strips(tmp_path: Path) -> None:
    """Four sides in one strip, and a strip for each cap; also with corners repeated, and without indices."""
    strips = [[4, 0, 5, 1, 6, 2, 7, 3, 4, 0], [0, 3, 1, 2], [4, 5, 7, 6]]
    found = trimesh.Trimesh(POINTS, trimesh.util.triangle_strips_to_faces(strips), process=False)
    assert found.is_watertight
    turn = found.volume < 0
    strips = [[each[0], *each] if turn else each for each in strips]
    for indexed in (True, False):
        writer = Writer()
        points = writer.accessor(POINTS, 5126)
        primitives = [
            {"attributes": {"POSITION": points}, "indices": writer.accessor(each, 5125, "SCALAR"), "mode": 5}
            if indexed
            else {"attributes": {"POSITION": writer.accessor(POINTS[each], 5126)}, "mode": 5}
            for each in strips
        ]
        writer.finish(primitives)
        assert_boxes(write(tmp_path, writer))


def test_points_and_lines_beside_triangles(tmp_path: Path) -> None:
    writer = Writer()
    box = writer.box()
    writer.finish([box, {**box, "mode": 0}, {**box, "mode": 1}, {**box, "mode": 3}])
    assert_boxes(write(tmp_path, writer))
    writer.finish([{**box, "mode": 1}])
    with pytest.raises(FormatError, match="holds no triangles"):
        read_mesh(write(tmp_path, writer))


# --- places ----------------------------------------------------------------------------------------------

HALF = math.sqrt(0.5)
PLACES = {
    "translation": ([{"mesh": 0, "translation": [0.1, 0, 0]}], (100, 0, 0)),
    "matrix": ([{"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0.1, 0, -0.2, 1]}], (100, 0, -200)),
    "mirrored": ([{"mesh": 0, "scale": [-1, 1, 1]}], (-20, 0, 0)),
    "mirrored twice": ([{"mesh": 0, "scale": [-1, -1, 1]}], (-20, -30, 0)),
    "mirrored by a matrix": ([{"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1]}], (0, 0, -40)),
    "half a turn": ([{"mesh": 0, "rotation": [0, 0, 1, 0]}], (-20, -30, 0)),
    "a turn that is not of length 1": ([{"mesh": 0, "rotation": [0, 0, 3, 0]}], (-20, -30, 0)),
    "nested": (
        [
            {"children": [1], "scale": [2, 2, 2]},
            {"children": [2], "translation": [0.1, 0, 0]},
            {"mesh": 0, "scale": [0.5] * 3},
        ],
        (200, 0, 0),
    ),
    "a quarter turn and back": (
        [{"children": [1], "rotation": [HALF, 0, 0, HALF]}, {"mesh": 0, "rotation": [-HALF, 0, 0, HALF]}],
        (0, 0, 0),
    ),
    "hidden by a scale of nothing": ([{"mesh": 0}, {"mesh": 0, "scale": [0, 0, 0]}], (0, 0, 0)),
}


@pytest.mark.parametrize("name", PLACES)
def test_places(name: str, tmp_path: Path) -> None:
    nodes, at = PLACES[name]
    writer = Writer()
    writer.finish([writer.box()], copy.deepcopy(nodes))
    if "children" in nodes[0]:
        writer.document["scenes"] = [{"nodes": [0]}]
    assert_boxes(write(tmp_path, writer), at=at)


def test_turned_and_scaled_as_trimesh_reads_it(tmp_path: Path) -> None:
    rng = np.random.default_rng(1)
    for _ in range(5):
        nodes = [
            {
                "translation": rng.normal(size=3).tolist(),
                "rotation": (q := rng.normal(size=4), (q / np.linalg.norm(q)).tolist())[1],
                "scale": (rng.choice([-1, 1], 3) * rng.uniform(0.3, 3, 3)).tolist(),
            }
            for _ in range(3)
        ]
        nodes[0]["children"], nodes[1]["children"], nodes[2]["mesh"] = [1], [2], 0
        writer = Writer()
        writer.finish([writer.box()], nodes)
        writer.document["scenes"] = [{"nodes": [0]}]
        path = write(tmp_path, writer)
        mesh, other = read_mesh(path), trimesh.load_scene(path).to_geometry()
        assert mesh.closed
        assert mesh.volume > 0
        assert mesh.bounds == pytest.approx(1000 * other.bounds, rel=1e-5, abs=1e-3)  # single precision of metres
        assert mesh.volume == pytest.approx(1e9 * abs(other.volume), rel=1e-5)


def test_without_a_scene_all_is_shown(tmp_path: Path) -> None:
    writer = Writer()
    writer.finish([writer.box()], [{"children": [1]}, {"mesh": 0}, {"mesh": 0, "translation": [0.1, 0, 0]}])
    del writer.document["scene"], writer.document["scenes"]
    assert_boxes(write(tmp_path, writer), count=2, apart=100)


def test_the_scene_that_is_named_is_read(tmp_path: Path) -> None:
    writer = Writer()
    writer.finish([writer.box()], [{"mesh": 0}, {"mesh": 0, "translation": [0.1, 0, 0]}])
    writer.document |= {"scene": 1, "scenes": [{"nodes": [0]}, {"nodes": [1]}]}
    assert_boxes(write(tmp_path, writer), at=(100, 0, 0))


@pytest.mark.parametrize("required", [True, False])
@pytest.mark.parametrize("kind", [5126, 5122, 5120])
def test_instances(required: bool, kind: int, tmp_path: Path) -> None:
    """Three boxes: moved, turned half a turn about z and back into place, and scaled by what the node undoes."""
    name = "EXT_mesh_gpu_instancing"
    writer = Writer(**needs(name) if required else {"extensionsUsed": [name]})
    box = writer.box()
    top = {5126: 1, 5122: 32767, 5120: 127}[kind]
    attributes = {
        "TRANSLATION": writer.accessor([[0, 0, 0], [0.22, 0.06, 0], [0.4, 0, 0]], 5126),
        "ROTATION": writer.accessor(
            np.array([[0, 0, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]]) * top, kind, "VEC4", normalized=kind != 5126
        ),
        "SCALE": writer.accessor([[2, 2, 2]] * 3, 5126),
    }
    writer.finish([box], [{"mesh": 0, "scale": [0.5] * 3, "extensions": {name: {"attributes": attributes}}}])
    mesh = read_mesh(write(tmp_path, writer))
    assert mesh.closed
    assert mesh.volume == pytest.approx(72000, rel=1e-5)
    assert mesh.bounds == pytest.approx(np.array([[0, 0, 0], [220, 30, 40]]), abs=1e-3)
    assert check(tmp_path / "part.glb").components == 3


def test_skins_and_morph_targets_as_they_are_at_rest(tmp_path: Path) -> None:
    """Joints move the vertices, the place of the node does not: glTF 2.0, 3.7.3.1. Targets move them by their weight."""
    writer = Writer()
    box = writer.box()
    box["attributes"] |= {
        "JOINTS_0": writer.accessor(np.tile([0, 1, 0, 0], (8, 1)), 5121, "VEC4"),
        "WEIGHTS_0": writer.accessor(np.tile([127.5, 127.5, 0, 0], (8, 1)), 5126, "VEC4"),
    }
    box["targets"] = [{"POSITION": writer.accessor(np.tile([1.0, 0, 0], (8, 1)), 5126)} for _ in range(2)]
    inverse = np.stack([np.eye(4), np.eye(4)])
    inverse[1, 3, 1] = 0.1  # the last row, as columns come first
    skin = {"joints": [1, 2], "inverseBindMatrices": writer.accessor(inverse, 5126, "MAT4")}
    nodes = [
        {"mesh": 0, "skin": 0, "translation": [9, 9, 9], "weights": [0.1, 0]},
        {"children": [2], "translation": [0, 0, 0.1]},
        {"translation": [0, 0, 0.1]},
    ]
    writer.finish([box], nodes, skins=[skin])
    writer.document["scenes"] = [{"nodes": [0, 1]}]
    assert_boxes(write(tmp_path, writer), at=(100, 50, 150), near=1e-6)


# --- buffers ---------------------------------------------------------------------------------------------


def as_json(writer: Writer, uris: list[str], blobs: list[bytes]) -> bytes:
    document = copy.deepcopy(writer.document)
    document["buffers"] = [{"byteLength": len(blob), "uri": uri} for uri, blob in zip(uris, blobs, strict=True)]
    return json.dumps(document).encode()


@pytest.fixture
def parted() -> tuple[Writer, list[bytes]]:
    """A box whose corners lie in one buffer and whose triangles in another."""
    writer = one(lambda writer: writer.box())
    cut = writer.document["bufferViews"][1]["byteOffset"]
    writer.document["bufferViews"][1] |= {"buffer": 1, "byteOffset": 0}
    return writer, [writer.blob[:cut], writer.blob[cut:]]


def test_json_with_its_numbers_in_it_or_beside_it(parted: tuple[Writer, list[bytes]], tmp_path: Path) -> None:
    writer, blobs = parted
    inside = ["data:application/octet-stream;base64," + base64.b64encode(blob).decode() for blob in blobs]
    (tmp_path / "a.gltf").write_bytes(as_json(writer, inside, blobs))
    assert_boxes(tmp_path / "a.gltf")
    for name in ("b.gltf", "b.glb"):
        (tmp_path / "my part.bin").write_bytes(blobs[1] + b"more")
        text = as_json(writer, [inside[0], "my%20part.bin"], blobs)
        if name == "b.glb":
            text += b" " * (-len(text) % 4)
            text = struct.pack("<4sII", b"glTF", 2, 20 + len(text)) + struct.pack("<I4s", len(text), b"JSON") + text
        (tmp_path / name).write_bytes(text)
        assert_boxes(tmp_path / name)
    (tmp_path / "my part.bin").unlink()
    with pytest.raises(FormatError, match='in "my part.bin" and that is not there; keep both files together'):
        read_mesh(tmp_path / "b.gltf")


@pytest.mark.parametrize(
    "uri",
    ["../up.bin", "/etc/passwd", "file:///etc/passwd", "https://example.com/a.bin", "a/..\\..\\b", "%2e%2e/up.bin"],
)
def test_numbers_outside_the_folder(uri: str, parted: tuple[Writer, list[bytes]], tmp_path: Path) -> None:
    writer, blobs = parted
    (tmp_path / "in").mkdir()
    (tmp_path / "up.bin").write_bytes(blobs[0])
    (tmp_path / "in" / "a.gltf").write_bytes(as_json(writer, [uri, uri], blobs))
    with pytest.raises(FormatError, match="outside its folder; export it as .glb"):
        read_mesh(tmp_path / "in" / "a.gltf")


# --- packed ----------------------------------------------------------------------------------------------

DRACO = "KHR_draco_mesh_compression"


def draco(writer: Writer, *, whole: bool) -> dict[str, Any]:
    packed = writer.view(DracoPy.encode(POINTS.astype(np.float32), TRIANGLES, quantization_bits=20))
    box = writer.box()
    if not whole:
        for accessor in writer.document["accessors"]:
            del accessor["bufferView"]
    return box | {"extensions": {DRACO: {"bufferView": packed, "attributes": {"POSITION": 0}}}}


@pytest.mark.parametrize("whole", [True, False])
def test_draco(whole: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without DracoPy: by the numbers that are there unpacked too, or by what would help."""
    more = {"extensionsUsed": [DRACO]} if whole else needs(DRACO)
    path = write(tmp_path, one(lambda writer: draco(writer, whole=whole), **more))
    assert_boxes(path, near=2**-19)
    ball = trimesh.creation.icosphere(3, radius=0.02)
    writer = Writer(**needs(DRACO))
    packed = writer.view(DracoPy.encode(ball.vertices.astype(np.float32), ball.faces, quantization_bits=16))
    box = writer.box() | {"extensions": {DRACO: {"bufferView": packed, "attributes": {"POSITION": 0}}}}
    writer.finish([box])
    other = write(tmp_path, writer, "ball.glb")
    assert read_mesh(other).closed
    assert read_mesh(other).volume == pytest.approx(1e9 * ball.volume, rel=1e-3)
    monkeypatch.setitem(sys.modules, "DracoPy", None)
    if whole:
        assert_boxes(path)
    else:
        with pytest.raises(
            FormatError, match=rf"packed by {DRACO}; install DracoPy \(pip install DracoPy\), or export"
        ):
            read_mesh(path)


def test_draco_that_is_none(tmp_path: Path) -> None:
    for data in (b"", b"DRACO", DracoPy.encode(POINTS.astype(np.float32))):
        writer = Writer(**needs(DRACO))
        box = writer.box()
        box["extensions"] = {DRACO: {"bufferView": writer.view(data), "attributes": {"POSITION": 0}}}
        writer.finish([box])
        with pytest.raises(FormatError, match="Draco"):
            read_mesh(write(tmp_path, writer))


@pytest.mark.parametrize("name", ["EXT_meshopt_compression", "KHR_meshopt_compression"])
def test_meshopt(name: str, tmp_path: Path) -> None:
    """By its name where it is required, and else by the numbers that are there unpacked too."""
    packed = {
        "extensions": {
            name: {"buffer": 0, "byteOffset": 0, "byteLength": 4, "byteStride": 12, "mode": "ATTRIBUTES", "count": 8}
        }
    }
    writer = one(lambda writer: writer.box(), extensionsUsed=[name])
    writer.document["bufferViews"][0] |= packed
    assert_boxes(write(tmp_path, writer))
    fallback = copy.deepcopy(writer)
    fallback.document["buffers"][0]["extensions"] = {name: {"fallback": True}}
    with pytest.raises(FormatError, match=f"packed by {name}, which is not known here; export it without compression"):
        read_mesh(write(tmp_path, fallback))
    writer.document["extensionsRequired"] = [name]
    with pytest.raises(FormatError, match=f"packed by {name}"):
        read_mesh(write(tmp_path, writer))


@pytest.mark.parametrize("name", ["KHR_gaussian_splatting", "ACME_mesh", "MSFT_lod", "CESIUM_RTC", "\x1b[2J", 5, None])
def test_a_required_extension_that_is_not_known(name: Any, tmp_path: Path) -> None:
    writer = one(lambda writer: writer.box(), extensionsUsed=[name], extensionsRequired=["KHR_materials_unlit", name])
    shown = json.dumps(name).replace("\\u001b", "").replace("[", r"\[")
    with pytest.raises(FormatError, match="requires the extension .*, which is not known here") as caught:
        read_mesh(write(tmp_path, writer))
    assert shown.replace("\\", "").strip('"') in str(caught.value)
    assert str(caught.value).isprintable()
    del writer.document["extensionsRequired"]
    assert_boxes(write(tmp_path, writer))


@pytest.mark.parametrize(
    "name",
    ["KHR_materials_unlit", "KHR_materials_variants", "KHR_texture_transform", "KHR_texture_basisu", "KHR_lights_punctual", "KHR_xmp_json_ld", "EXT_texture_webp", "MSFT_texture_dds", "EXT_mesh_features", "KHR_animation_pointer", "VRMC_vrm"],
)  # fmt: skip
def test_a_required_extension_that_moves_nothing(name: str, tmp_path: Path) -> None:
    assert_boxes(write(tmp_path, one(lambda writer: writer.box(), **needs(name))))


# --- broken ----------------------------------------------------------------------------------------------


def put(*keys: Any, to: Any) -> Callable[[dict[str, Any]], None]:
    def change(document: dict[str, Any]) -> None:
        for key in keys[:-1]:
            document = document[key]
        document[keys[-1]] = to

    return change


A, V, N, M = ("accessors", 0), ("bufferViews", 0), ("nodes", 0), ("meshes", 0)
P = (*M, "primitives", 0)
BROKEN = {
    "a matrix of 15 numbers": (put(*N, "matrix", to=[1] * 15), "matrix that is not 16 numbers"),
    "a matrix of words": (put(*N, "matrix", to=["x"] * 16), "matrix that is not 16 numbers"),
    "a matrix of rows": (put(*N, "matrix", to=[[1, 0, 0, 0]] * 4), "matrix that is not 16 numbers"),
    "a matrix of nan": (put(*N, "matrix", to=[math.nan] * 16), "matrix that is not 16 numbers"),
    "a matrix of huge numbers": (put(*N, "matrix", to=[10**400] * 16), "matrix that is not 16 numbers"),
    "a matrix of perspective": (put(*N, "matrix", to=[1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]), "not an affine"),
    "a matrix that flattens": (put(*N, "matrix", to=[1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1]), "flattens"),
    "a scale that flattens": (put(*N, "scale", to=[1, 1, 0]), "flattens its mesh; give it a thickness"),
    "a scale of two": (put(*N, "scale", to=[1, 1]), "scale that is not 3 numbers"),
    "a scale that is a number": (put(*N, "scale", to=2), "scale that is not 3 numbers"),
    "a scale of truth": (put(*N, "scale", to=[True, 1, 1]), "scale that is not 3 numbers"),
    "a place that is infinite": (put(*N, "translation", to=[math.inf, 0, 0]), "translation that is not 3 numbers"),
    "a rotation by nothing": (put(*N, "rotation", to=[0, 0, 0, 0]), "rotation by nothing"),
    "a node in itself": (put(*N, "children", to=[0]), "node 0 stands in the scene twice"),
    "a node that is not there": (put(*N, "children", to=[7]), "number 7 of its nodes, and has 1"),
    "a node by a name": (put(*N, "children", to=["a"]), 'number "a" of its nodes'),
    "children that are none": (put(*N, "children", to="a"), "children that are not a list"),
    "a mesh that is not there": (put(*N, "mesh", to=3), "number 3 of its meshes"),
    "a mesh below none": (put(*N, "mesh", to=-1), "number -1 of its meshes"),
    "a mesh by a truth": (put(*N, "mesh", to=True), "number true of its meshes"),
    "a scene that is not there": (put("scene", to=4), "number 4 of its scenes"),
    "nodes that are no list": (put("nodes", to={}), "nodes are not a list"),
    "a node that is a number": (put(*N, to=5), "number 0 of its nodes"),
    "no primitives": (put(*M, to={}), "mesh 0 has no primitives"),
    "a primitive that is a number": (put(*P, to=5), "primitive that is not an object"),
    "a mode that is none": (put(*P, "mode", to=9), "mode 9"),
    "no positions": (put(*P, "attributes", to={}), "no positions"),
    "an accessor that is not there": (put(*P, "attributes", "POSITION", to=9), "number 9 of its accessors"),
    "corners that are coordinates": (put(*P, "indices", to=0), "accessor 0 is \"VEC3\", not SCALAR"),
    "corners that are fractions": (put("accessors", 1, "componentType", to=5126), "corners of a primitive are not whole"),
    "corners of more": (put("accessors", 1, "count", to=34), "34 corners, not three for each triangle"),
    "corners beyond": (put(*A, "count", to=7), "corners that do not exist, of 7"),
    "more than the buffer": (put(*A, "count", to=9), "accessor 0 ends 12 bytes beyond its buffer view"),
    "very much more": (put(*A, "count", to=10**15), "beyond its buffer view"),
    "a count below none": (put(*A, "count", to=-1), "count is -1, not a whole number"),
    "a count of a half": (put(*A, "count", to=7.5), "count is 7.5, not a whole number"),
    "an offset beyond": (put(*A, "byteOffset", to=999), "beyond its buffer view"),
    "a view beyond": (put(*V, "byteLength", to=10**6), "beyond its buffer"),
    "a view at a place below none": (put(*V, "byteOffset", to=-4), "byteOffset is -4"),
    "elements that overlap": (put(*V, "byteStride", to=8), "elements of 12 bytes, 8 bytes apart"),
    "a component that is none": (put(*A, "componentType", to=5124), "component type is 5124"),
    "a type that is none": (put(*A, "type", to="VEC5"), 'accessor 0 is "VEC5", not VEC3'),
    "a buffer that is longer": (put("buffers", 0, "byteLength", to=10**9), "buffer 0 is cut off"),
    "no buffer": (put("buffers", to=[]), "number 0 of its buffers, and has 0"),
    "a second buffer without data": (put(*V, "buffer", to=1), "number 1 of its buffers"),
    "a skin that is not there": (put(*N, "skin", to=0), "number 0 of its skins"),
    "targets that are none": (put(*P, "targets", to=5), "morph targets"),
    "extensions that are none": (put(*P, "extensions", to=[]), "extensions is"),
    "glTF 1": (put("asset", to={"version": "1.0"}), "export it as glTF 2.0"),
    "no version": (put("asset", to=7), "export it as glTF 2.0"),
    "instances without places": (put(*N, "extensions", to={"EXT_mesh_gpu_instancing": {}}), "instances"),
    "a sparse accessor that is none": (put(*A, "sparse", to=5), "sparse is 5, not an object"),
    "a number that is no whole one": (put(*N, "mesh", to="\x1b[2J"), "of its meshes"),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", BROKEN)
def test_what_is_broken_is_said(name: str, tmp_path: Path) -> None:
    change, says = BROKEN[name]
    writer = one(lambda writer: writer.box())
    change(writer.document)
    with pytest.raises(FormatError, match=says) as caught:
        read_mesh(write(tmp_path, writer))
    assert str(caught.value).isprintable()


def test_zeros_without_end_need_memory_that_is_asked_for(tmp_path: Path) -> None:
    writer = one(lambda writer: writer.box())
    del writer.document["accessors"][0]["bufferView"]
    writer.document["accessors"][0]["count"] = 10**13
    with pytest.raises(MemoryLimitError, match="may be broken; export the mesh again"):
        read_mesh(write(tmp_path, writer))


def test_instances_without_end_need_memory_that_is_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nodes by the thousand that share one mesh: a small file and a large part."""
    monkeypatch.setattr("infill.machine.available_memory", lambda: 10_000_000)
    ball = trimesh.creation.icosphere(3, radius=0.01)
    writer = Writer()
    points, corners = writer.accessor(ball.vertices, 5126), writer.accessor(ball.faces, 5125, "SCALAR")
    nodes = [{"mesh": 0, "translation": [k, 0, 0]} for k in range(200)]
    writer.finish([{"attributes": {"POSITION": points}, "indices": corners}], nodes)
    with pytest.raises(MemoryLimitError, match="places its meshes too often"):
        read_mesh(write(tmp_path, writer))


@pytest.mark.parametrize("cut", [3, 11, 19, 40, 200, -5])
def test_a_glb_that_is_cut_off(cut: int, tmp_path: Path) -> None:
    data = one(lambda writer: writer.box()).glb()
    (tmp_path / "a.glb").write_bytes(data[:cut])
    with pytest.raises(FormatError, match=r"cut off|does not begin"):
        read_mesh(tmp_path / "a.glb")


@pytest.mark.slow
def test_a_text_that_is_nested_without_end(tmp_path: Path) -> None:
    (tmp_path / "a.gltf").write_text("[" * 200_000)
    with pytest.raises(InfillError, match="is broken"):
        read_mesh(tmp_path / "a.gltf")
    nodes = [{"children": [k + 1]} for k in range(3000)] + [{"mesh": 0}]
    writer = Writer()
    writer.finish([writer.box()], nodes)
    writer.document["scenes"] = [{"nodes": [0]}]
    assert_boxes(write(tmp_path, writer))
