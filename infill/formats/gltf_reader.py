"""Read glTF 2.0, binary or as JSON with separate files of numbers: every mesh in each of its places."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from infill.arrays import Floats, Integers
from infill.formats.gltf_document import MESHOPT, Gltf, JsonObject, parse_document, quote, split_chunks
from infill.machine import require_memory
from infill.meshes.polygons import split_fan, split_strips

MILLIMETRE = 0.001  # of a metre
TRIANGLES, STRIP, FAN = 4, 5, 6
MOST_MODES = 7
DRACO, INSTANCES = "KHR_draco_mesh_compression", "EXT_mesh_gpu_instancing"
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
    document, binary = split_chunks(path, path.read_bytes())
    return _read_scene(Gltf(path=path, document=document, binary=binary))


def read_gltf(path: Path) -> tuple[Floats, Integers]:
    """Read a JSON file and the files that it names; return vertices in mm and triangles: see `read_glb`."""
    return _read_scene(Gltf(path=path, document=parse_document(path, path.read_bytes()), binary=None))


def _read_scene(gltf: Gltf) -> tuple[Floats, Integers]:
    """Check the required extensions; return vertices in mm and triangles of the scene."""
    for name in gltf.items("extensionsRequired"):
        if not isinstance(name, str) or not (
            name in READ_EXTENSIONS or name in MESHOPT or HARMLESS_EXTENSIONS.fullmatch(name)
        ):
            gltf.fail(f"it requires the extension {quote(name)}, which is not known here", "export it without that")
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
        mesh = _unpack_draco(gltf.view(compression.get("bufferView"))[0])
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
            gltf.fail(f"a morph target has the weight {quote(weight)}")
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


def _unpack_draco(data: bytes) -> tuple[Floats, Integers] | None:
    """Decompress a mesh by DracoPy; return vertices and triangles, or None if it is not installed.

    Raises
    ------
    ValueError
        If the data hold no mesh.
    """
    try:
        import DracoPy
    except ImportError:
        return None
    try:
        mesh = DracoPy.decode(data)
    except DracoPy.FileTypeException as error:
        raise ValueError("the Draco data cannot be unpacked") from error
    faces = getattr(mesh, "faces", None)
    if faces is None:
        raise ValueError("the Draco data hold points and no triangles")
    return np.asarray(mesh.points, dtype=np.float64).reshape(-1, 3), np.asarray(faces, dtype=np.int64).reshape(-1, 3)
