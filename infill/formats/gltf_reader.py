"""Read glTF 2.0, binary or as JSON with separate files of numbers: every mesh in each of its places."""

from __future__ import annotations

import base64
import json
import math
import re
import struct
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn
from urllib.parse import unquote

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError, escape_unprintable
from infill.formats.draco import unpack_draco
from infill.machine import require_memory
from infill.meshes.polygons import split_fan, split_strips

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
JsonObject = dict[str, Any]

MAGIC, JSON_CHUNK, BINARY_CHUNK = b"glTF", 0x4E4F534A, 0x004E4942
MILLIMETRE = 0.001  # of a metre
KINDS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
TRIANGLES, STRIP, FAN = 4, 5, 6
MOST_MODES = 7
DRACO, INSTANCES = "KHR_draco_mesh_compression", "EXT_mesh_gpu_instancing"
MESHOPT = ("EXT_meshopt_compression", "KHR_meshopt_compression")
READ_EXTENSIONS = {"KHR_mesh_quantization", DRACO, INSTANCES}
# Extensions on look, sound, motion or meaning of a part, and not on the place of its surface.
HARMLESS_EXTENSIONS = re.compile(
    r"KHR_(materials|texture|lights|xmp|animation|techniques|audio|environment)\w*"
    r"|EXT_(texture|lights|materials|structural_metadata|feature_metadata|mesh_features|instance_features)\w*"
    r"|MSFT_(texture|packing)\w*|(ADOBE|NV)_materials\w*|AGI_(articulations|stk_metadata)|CESIUM_primitive_outline"
    r"|FB_geometry_metadata|VRM|VRMC_(vrm|materials_mtoon|springBone\w*)"
)
FLAT_TOLERANCE = 1e-9  # the shortest over the longest axis of a transform that leaves a solid no thickness
BYTES_PER_CORNER = 100  # bytes of memory that a vertex, or a triangle, takes while it is read


def read_glb(path: Path) -> tuple[Floats, Integers]:
    """Read a binary file; return vertices in mm and triangles of every mesh in each of its places in the scene.

    Notes
    -----
    The default scene is read, or the first; skins and morph targets at rest. Points and lines are left out.

    Raises
    ------
    FormatError
        If a required extension or a compression is unknown, or anything is broken.
    """
    document, binary = _chunks(path, path.read_bytes())
    return _read_scene(Gltf(path=path, document=document, binary=binary))


def read_gltf(path: Path) -> tuple[Floats, Integers]:
    """Read a JSON file and the files that it names; return vertices in mm and triangles: see `read_glb`."""
    return _read_scene(Gltf(path=path, document=_document(path, path.read_bytes()), binary=None))


def _chunks(path: Path, data: bytes) -> tuple[JsonObject, bytes | None]:
    """Split a binary file into the description and the numbers."""
    if data[:4] != MAGIC or len(data) < 12:
        raise FormatError(f"{path} is broken or not a .glb file (it does not begin with 'glTF'); export the mesh again")
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise FormatError(f"{path} is glTF {version}; export it as glTF 2.0")
    if length > len(data):
        raise FormatError(f"{path} is cut off: it has {len(data)} bytes of {length}; export the mesh again")
    document, binary, place = None, None, 12
    while place + 8 <= length:
        size, kind = struct.unpack_from("<II", data, place)
        place += 8
        if size > length - place:
            raise FormatError(
                f"{path} is cut off or broken: a chunk has {length - place} bytes of {size}; export it again"
            )
        if kind == JSON_CHUNK and document is None:
            document = _document(path, data[place : place + size])
        elif kind == BINARY_CHUNK and binary is None:
            binary = data[place : place + size]
        place += size
    if document is None:
        raise FormatError(f"{path} is broken: it has no description of its meshes; export the mesh again")
    return document, binary


def _document(path: Path, data: bytes) -> JsonObject:
    """Parse the description and check its version."""
    document = json.loads(data.decode("utf-8-sig").rstrip(" \0"))
    if not isinstance(document, dict):
        raise FormatError(f"{path} is broken or not a glTF file; export the mesh again")
    version = document.get("asset", {}).get("version") if isinstance(document.get("asset"), dict) else None
    if not isinstance(version, str) or not version.startswith("2."):
        raise FormatError(f"{path} does not say that it is glTF 2; export it as glTF 2.0")
    return document


@dataclass(frozen=True, kw_only=True, eq=False)
class Gltf:
    """A description and its numbers; items are checked when they are read.

    Parameters
    ----------
    path : Path
    document : dict
    binary : bytes, optional
        The numbers in the file itself.
    """

    path: Path
    document: JsonObject
    binary: bytes | None
    buffers: dict[int, bytes] = field(default_factory=dict)

    def fail(self, complaint: str, advice: str = "export the mesh again") -> NoReturn:
        """Raise FormatError."""
        raise FormatError(f"{self.path}: {complaint}; {advice}")

    def items(self, name: str) -> list[Any]:
        """Return all items of a kind, such as "nodes"."""
        entries = self.document.get(name, [])
        if not isinstance(entries, list):
            self.fail(f"its {name} are not a list")
        return entries

    def item(self, name: str, index: object) -> JsonObject:
        """Return an item by its number."""
        entries = self.items(name)
        if type(index) is not int or not 0 <= index < len(entries) or not isinstance(entries[index], dict):
            self.fail(f"it refers to number {_quote(index)} of its {name}, and has {len(entries)}")
        entry: JsonObject = entries[index]
        return entry

    def whole(self, holder: JsonObject, key: str, default: int | None = None) -> int:
        """Return a whole number of at least 0."""
        value = holder.get(key, default)
        if type(value) is not int or value < 0:
            self.fail(f"{key} is {_quote(value)}, not a whole number")
        return value

    def numbers(self, holder: JsonObject, key: str, count: int, default: list[float]) -> Floats:
        """Return `count` finite numbers."""
        value = holder.get(key, default)
        is_valid = (
            isinstance(value, list) and len(value) == count and all(type(number) in (int, float) for number in value)
        )
        if not is_valid or not all(abs(number) < 1e300 for number in value):
            self.fail(f"a node has a {key} that is not {count} numbers: {_quote(value)}")
        return np.array(value, dtype=np.float64)

    def part(self, holder: JsonObject, key: str) -> JsonObject:
        """Return an object inside another; empty if it is missing."""
        value = holder.get(key, {})
        if not isinstance(value, dict):
            self.fail(f"{key} is {_quote(value)}, not an object")
        return value

    def extension(self, holder: JsonObject, name: str) -> JsonObject | None:
        """Return the data of an extension, or None."""
        extensions = self.part(holder, "extensions")
        return self.part(extensions, name) if name in extensions else None

    # --- numbers -----------------------------------------------------------------------------------------

    def buffer(self, index: object) -> bytes:
        """Return all bytes of a buffer."""
        description = self.item("buffers", index)
        assert isinstance(index, int)
        if index not in self.buffers:
            size = self.whole(description, "byteLength")
            data = self._bytes_of(index, description.get("uri"))
            if len(data) < size:
                self.fail(f"buffer {index} is cut off: it has {len(data)} bytes of {size}")
            self.buffers[index] = data[:size]
        return self.buffers[index]

    def _bytes_of(self, index: int, uri: object) -> bytes:
        """Read the bytes of a buffer from the file itself, a data address or another file."""
        if uri is None:
            if index or self.binary is None:
                self.fail(f"buffer {index} has no data")
            return self.binary
        if not isinstance(uri, str):
            self.fail(f"buffer {index} has the address {_quote(uri)}")
        if uri.startswith("data:"):
            head, _, encoded = uri.partition(",")
            if not head.endswith(";base64"):
                self.fail(f"buffer {index} is not in base64")
            return base64.b64decode(encoded, validate=True)
        name = unquote(uri)
        relative = Path(name)
        if re.match(r"[a-zA-Z][\w+.-]+:|[/\\]", name) or ".." in re.split(r"[/\\]", name) or relative.is_absolute():
            self.fail(f"its numbers lie in {_quote(uri)}, outside its folder", "export it as .glb")
        file = self.path.parent / relative
        if not file.is_file():
            self.fail(
                f"its numbers lie in {_quote(name)} and that is not there", "keep both files together, or export a .glb"
            )
        return file.read_bytes()

    def view(self, index: object) -> tuple[bytes, int]:
        """Return the bytes of a part of a buffer and the stride of its elements, 0 for adjacent ones."""
        description = self.item("bufferViews", index)
        for name in MESHOPT:
            compression = self.extension(description, name)
            if compression is not None and not self._has_fallback(description, name):
                self.fail(f"it is packed by {name}, which is not known here", "export it without compression")
        data = self.buffer(description.get("buffer"))
        begin, size = self.whole(description, "byteOffset", 0), self.whole(description, "byteLength")
        if begin + size > len(data):
            self.fail(f"buffer view {index} ends {begin + size - len(data)} bytes beyond its buffer")
        return data[begin : begin + size], self.whole(description, "byteStride", 0)

    def _has_fallback(self, description: JsonObject, name: str) -> bool:
        """Tell whether the file holds the same numbers uncompressed too."""
        buffer = self.item("buffers", description.get("buffer"))
        return name not in self.items("extensionsRequired") and self.extension(buffer, name) is None

    def accessor(self, index: object, shape: str) -> NDArray[Any]:
        """Return numbers (count, n), unchanged, or as fractions for normalised integers."""
        description = self.item("accessors", index)
        if description.get("type") != shape:
            self.fail(f"accessor {index} is {_quote(description.get('type'))}, not {shape}")
        kind = self._kind(description)
        count, width = self.whole(description, "count"), WIDTHS[shape]
        if "bufferView" in description:
            data, stride = self.view(description["bufferView"])
            values = self._elements(data, self.whole(description, "byteOffset", 0), stride, kind, count, width, index)
        else:
            require_memory(count * width * kind.itemsize, None, f"{self.path} may be broken; export the mesh again")
            values = np.zeros((count, width), dtype=kind)
        if "sparse" in description:
            values = self._apply_sparse(values, self.part(description, "sparse"), index)
        if description.get("normalized", False) and kind.kind in "iu":
            return np.maximum(values / np.float64(np.iinfo(kind).max), -1.0)
        return values

    def _kind(self, description: JsonObject) -> np.dtype[Any]:
        """Return the NumPy type of an accessor's components."""
        kind = description.get("componentType")
        if type(kind) is not int or kind not in KINDS:
            self.fail(f"a component type is {_quote(kind)}, not one of {', '.join(map(str, KINDS))}")
        return np.dtype(KINDS[kind])

    def _elements(
        self, data: bytes, begin: int, stride: int, kind: np.dtype[Any], count: int, width: int, index: object
    ) -> NDArray[Any]:
        """Return numbers (count, width) at a stride."""
        size = width * kind.itemsize
        stride = stride or size
        if stride < size:
            self.fail(f"accessor {index} has elements of {size} bytes, {stride} bytes apart")
        if count and begin + (count - 1) * stride + size > len(data):
            missing = begin + (count - 1) * stride + size - len(data)
            self.fail(f"accessor {index} ends {missing} bytes beyond its buffer view")
        if count == 0:
            return np.empty((0, width), dtype=kind)
        return np.ndarray((count, width), dtype=kind, buffer=data, offset=begin, strides=(stride, kind.itemsize)).copy()

    def _apply_sparse(self, array: NDArray[Any], sparse: JsonObject, index: object) -> NDArray[Any]:
        """Replace the elements that a sparse accessor lists; return the numbers."""
        count, indices, replacements = (
            self.whole(sparse, "count"),
            self.part(sparse, "indices"),
            self.part(sparse, "values"),
        )
        data, stride = self.view(indices.get("bufferView"))
        places = self._elements(
            data, self.whole(indices, "byteOffset", 0), stride, self._kind(indices), count, 1, index
        )[:, 0]
        data, stride = self.view(replacements.get("bufferView"))
        begin = self.whole(replacements, "byteOffset", 0)
        values = self._elements(data, begin, stride, array.dtype, count, array.shape[1], index)
        if places.dtype.kind != "u" or (count and int(places.max()) >= len(array)):
            self.fail(f"accessor {index} replaces elements that it does not have")
        array[places.astype(np.int64)] = values
        return array


def _quote(value: object) -> str:
    """Return a value as a message shows it."""
    text = escape_unprintable(json.dumps(value, ensure_ascii=False, default=str))
    return text if len(text) <= 60 else text[:60] + "…"


# --- the scene -------------------------------------------------------------------------------------------


def _read_scene(gltf: Gltf) -> tuple[Floats, Integers]:
    """Check the required extensions; return vertices in mm and triangles of the scene."""
    for name in gltf.items("extensionsRequired"):
        if not isinstance(name, str) or not (
            name in READ_EXTENSIONS or name in MESHOPT or HARMLESS_EXTENSIONS.fullmatch(name)
        ):
            gltf.fail(f"it requires the extension {_quote(name)}, which is not known here", "export it without that")
    vertices, faces, count = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int64)], 0
    for points, triangles in _place_meshes(gltf):
        vertices.append(points)
        faces.append(triangles + count)
        count += len(points)
    return np.concatenate(vertices), np.concatenate(faces)


def _place_meshes(gltf: Gltf) -> Iterator[tuple[Floats, Integers]]:
    """Yield the vertices, mm, and triangles of every mesh in each of its places."""
    places = _place_nodes(gltf)
    memory = 0
    for index, node in places.items():
        if "mesh" not in node.item:
            continue
        matrices = _instances(gltf, node)
        for points, triangles, is_mirrored in _primitives(gltf, node.item, places):
            copies = [np.eye(4)] if is_mirrored is not None else matrices
            memory += len(copies) * BYTES_PER_CORNER * (len(points) + len(triangles))
            require_memory(memory, None, f"{gltf.path} places its meshes too often; export the mesh again")
            for matrix in copies:
                if not np.isfinite(matrix).all():
                    gltf.fail(f"node {index} is placed at infinity")
                linear = matrix[:3, :3]
                axes = np.linalg.svd(linear, compute_uv=False)
                if axes[0] == 0:  # a scale of 0 hides it
                    continue
                if axes[2] <= FLAT_TOLERANCE * axes[0]:
                    gltf.fail(
                        f"node {index} has a transform that flattens its mesh", "give it a thickness, or leave it out"
                    )
                mirrored = np.linalg.det(linear) < 0 if is_mirrored is None else is_mirrored
                # A scale of a thousandth becomes exactly 1, so that numbers in mm are read to the last bit.
                linear, shift = linear / MILLIMETRE, matrix[:3, 3] / MILLIMETRE
                # A mirrored part would face inwards: its corners are taken in reverse order.
                yield points @ linear.T + shift, triangles[:, ::-1] if mirrored else triangles


@dataclass(frozen=True, kw_only=True, eq=False)
class Node:
    """A node with its transform to the scene.

    Parameters
    ----------
    item : dict
    matrix : (4, 4) float64
        From its own coordinates to those of the scene.
    """

    item: JsonObject
    matrix: Floats


def _place_nodes(gltf: Gltf) -> dict[int, Node]:
    """Return the nodes of the scene by their number."""
    nodes = gltf.items("nodes")
    placed: dict[int, Node] = {}
    stack = [(index, np.eye(4)) for index in reversed(_roots(gltf))]
    while stack:
        index, parent = stack.pop()
        node = gltf.item("nodes", index)
        if index in placed:
            gltf.fail(f"node {index} stands in the scene twice")
        with np.errstate(over="ignore", invalid="ignore"):  # infinite numbers raise later
            matrix = parent @ _local(gltf, node)
        placed[index] = Node(item=node, matrix=matrix)
        children = node.get("children", [])
        if not isinstance(children, list) or len(children) > len(nodes):
            gltf.fail(f"node {index} has children that are not a list of nodes")
        stack += [(child, matrix) for child in reversed(children)]
    return placed


def _roots(gltf: Gltf) -> list[Any]:
    """Return the indices of the top nodes of the default scene, or of all nodes without a parent."""
    if gltf.items("scenes"):
        roots = gltf.item("scenes", gltf.document.get("scene", 0)).get("nodes", [])
        if not isinstance(roots, list):
            gltf.fail("its scene is not a list of nodes")
        return roots
    nodes = [node for node in gltf.items("nodes") if isinstance(node, dict)]
    lists = [node["children"] for node in nodes if isinstance(node.get("children"), list)]
    children = {child for node_children in lists for child in node_children if type(child) is int}
    return [index for index in range(len(gltf.items("nodes"))) if index not in children]


def _local(gltf: Gltf, node: JsonObject) -> Floats:
    """Return the transform of a node, from its own coordinates to those of its parent."""
    if "matrix" in node:
        matrix = gltf.numbers(node, "matrix", 16, []).reshape(4, 4).T  # column after column
        if not np.array_equal(matrix[3], [0, 0, 0, 1]):
            gltf.fail("a node has a matrix that is not an affine transform: its last row is not 0 0 0 1")
        return matrix
    translation = gltf.numbers(node, "translation", 3, [0, 0, 0])
    quaternion = gltf.numbers(node, "rotation", 4, [0, 0, 0, 1])
    scale = gltf.numbers(node, "scale", 3, [1, 1, 1])
    return _transform(gltf, translation, quaternion, scale)


def _transform(gltf: Gltf, translation: Floats, quaternion: Floats, scale: Floats) -> Floats:
    """Return the matrix of a scale, a rotation by a quaternion, and a translation."""
    length = math.sqrt(float(quaternion @ quaternion))
    if not 0 < length < math.inf:
        gltf.fail("a node has a rotation by nothing: 0 0 0 0")
    x, y, z, w = quaternion / length
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )
    matrix = np.eye(4)
    matrix[:3, :3] = rotation * scale
    matrix[:3, 3] = translation
    return matrix


def _instances(gltf: Gltf, node: Node) -> list[Floats]:
    """Return the transforms of all copies of the mesh of a node."""
    description = gltf.extension(node.item, INSTANCES)
    if description is None:
        return [node.matrix]
    attributes = gltf.part(description, "attributes")
    attribute_values = {
        name: gltf.accessor(attributes[name], shape).astype(np.float64)
        for name, shape in (("TRANSLATION", "VEC3"), ("ROTATION", "VEC4"), ("SCALE", "VEC3"))
        if name in attributes
    }
    counts = {len(values) for values in attribute_values.values()}
    if len(counts) != 1:
        gltf.fail(f"its instances ({INSTANCES}) have no places, or not as many of each kind")
    count = counts.pop()
    translations = attribute_values.get("TRANSLATION", np.zeros((count, 3)))
    rotations = attribute_values.get("ROTATION", np.tile([0.0, 0, 0, 1], (count, 1)))
    scales = attribute_values.get("SCALE", np.ones((count, 3)))
    return [node.matrix @ _transform(gltf, translations[i], rotations[i], scales[i]) for i in range(count)]


# --- meshes ----------------------------------------------------------------------------------------------


def _primitives(
    gltf: Gltf, node: JsonObject, places: dict[int, Node]
) -> Iterator[tuple[Floats, Integers, bool | None]]:
    """Yield vertices and triangles of a mesh, and, if bones place it, whether they mirror it."""
    mesh = gltf.item("meshes", node["mesh"])
    primitives = mesh.get("primitives")
    if not isinstance(primitives, list):
        gltf.fail(f"mesh {node['mesh']} has no primitives")
    bones = _joint_transforms(gltf, node["skin"], places) if "skin" in node else None
    for primitive in primitives:
        if not isinstance(primitive, dict):
            gltf.fail(f"mesh {node['mesh']} has a primitive that is not an object")
        mode = gltf.whole(primitive, "mode", TRIANGLES)
        if mode >= MOST_MODES:
            gltf.fail(f"a primitive has the mode {mode}, which glTF does not have")
        if mode < TRIANGLES:  # points and lines
            continue
        points, triangles = _corners(gltf, primitive, mode)
        if len(triangles) and (triangles.min() < 0 or triangles.max() >= len(points)):
            gltf.fail(f"mesh {node['mesh']} has triangles with corners that do not exist, of {len(points)}")
        points = _morph(gltf, primitive, points, node.get("weights", mesh.get("weights", [])))
        if bones is None:
            yield points, triangles, None
        else:
            yield (*_move_by_joints(gltf, primitive, points, triangles, bones),)


def _corners(gltf: Gltf, primitive: JsonObject, mode: int) -> tuple[Floats, Integers]:
    """Return the vertices and triangles of a primitive."""
    attributes = gltf.part(primitive, "attributes")
    compression = gltf.extension(primitive, DRACO)
    if compression is not None:
        mesh = unpack_draco(gltf.view(compression.get("bufferView"))[0])
        if mesh is not None:
            return mesh
        description = gltf.item("accessors", attributes.get("POSITION"))
        if DRACO in gltf.items("extensionsRequired") or "bufferView" not in description:
            gltf.fail(
                f"it is packed by {DRACO}", "install DracoPy (pip install DracoPy), or export it without compression"
            )
    if "POSITION" not in attributes:
        gltf.fail("a primitive has no positions")
    points = gltf.accessor(attributes["POSITION"], "VEC3").astype(np.float64)
    if "indices" in primitive:
        indices = gltf.accessor(primitive["indices"], "SCALAR")[:, 0]
        if indices.dtype.kind != "u":
            gltf.fail("the corners of a primitive are not whole numbers")
        corners = indices.astype(np.int64)
    else:
        corners = np.arange(len(points))
    if mode == STRIP:
        return points, split_strips(corners, np.array([len(corners)]))
    if mode == FAN:
        return points, split_fan(corners)
    if len(corners) % 3:
        gltf.fail(f"a primitive has {len(corners)} corners, not three for each triangle")
    return points, corners.reshape(-1, 3)


def _morph(gltf: Gltf, primitive: JsonObject, points: Floats, weights: object) -> Floats:
    """Move vertices by the morph targets, by their weights at rest; return the vertices."""
    targets = primitive.get("targets", [])
    if not isinstance(targets, list) or not isinstance(weights, list):
        gltf.fail("its morph targets or their weights are not a list")
    for target, weight in zip(targets, weights, strict=False):
        if type(weight) not in (int, float) or not isinstance(target, dict):
            gltf.fail(f"a morph target has the weight {_quote(weight)}")
        if weight and "POSITION" in target:
            offsets = gltf.accessor(target["POSITION"], "VEC3").astype(np.float64)
            if len(offsets) != len(points):
                gltf.fail(f"a morph target moves {len(offsets)} vertices of {len(points)}")
            points = points + weight * offsets
    return points


def _joint_transforms(gltf: Gltf, index: object, places: dict[int, Node]) -> Floats:
    """Return the transforms of the joints of a skin at rest, (J, 4, 4)."""
    skin = gltf.item("skins", index)
    joints = skin.get("joints")
    if (
        not isinstance(joints, list)
        or not all(type(joint) is int and joint in places for joint in joints)
        or not joints
    ):
        gltf.fail(f"skin {index} has joints that are not in the scene")
    transforms = np.stack([places[joint].matrix for joint in joints])
    if "inverseBindMatrices" in skin:
        inverse = gltf.accessor(skin["inverseBindMatrices"], "MAT4").astype(np.float64)
        if len(inverse) < len(joints):
            gltf.fail(f"skin {index} has {len(inverse)} matrices for {len(joints)} joints")
        transforms = transforms @ inverse[: len(joints)].reshape(-1, 4, 4).transpose(0, 2, 1)
    return np.asarray(transforms)


def _move_by_joints(
    gltf: Gltf, primitive: JsonObject, points: Floats, triangles: Integers, bones: Floats
) -> tuple[Floats, Integers, bool]:
    """Move vertices by the joints; return them, the triangles, and whether the joints mirror them."""
    attributes = gltf.part(primitive, "attributes")
    if "JOINTS_0" not in attributes or "WEIGHTS_0" not in attributes:
        gltf.fail("a mesh with a skin does not say by which joints its vertices are moved")
    blended, total = np.zeros((len(points), 4, 4)), np.zeros(len(points))
    for name in sorted(attributes):
        if not name.startswith("JOINTS_"):
            continue
        joints = gltf.accessor(attributes[name], "VEC4")
        weights = gltf.accessor(attributes.get(f"WEIGHTS_{name[7:]}"), "VEC4").astype(np.float64)
        if (
            joints.dtype.kind != "u"
            or not len(joints) == len(points) == len(weights)
            or int(joints.max(initial=0)) >= len(bones)
        ):
            gltf.fail("a mesh with a skin names joints that do not exist")
        for joint, weight in zip(joints.T.astype(np.int64), weights.T, strict=True):
            blended += weight[:, None, None] * bones[joint]
            total += weight
    if not (np.isfinite(total) & (total > 0)).all():
        gltf.fail("a mesh with a skin has vertices that no joint moves")
    blended /= total[:, None, None]
    placed = np.einsum("nij,nj->ni", blended[:, :3, :3], points) + blended[:, :3, 3]
    mirrored = bool((np.linalg.det(blended[:, :3, :3]) < 0).mean() > 0.5) if len(points) else False
    return placed, triangles, mirrored
