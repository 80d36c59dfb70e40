"""The JSON document of glTF 2.0 and its numbers: chunks, buffers, views and accessors, each checked."""

from __future__ import annotations

import base64
import json
import re
import struct
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NoReturn
from urllib.parse import unquote

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.errors import FormatError, escape_unprintable
from infill.machine import require_memory

JsonObject = dict[str, Any]

MAGIC, JSON_CHUNK, BINARY_CHUNK = b"glTF", 0x4E4F534A, 0x004E4942
KINDS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}
MESHOPT = ("EXT_meshopt_compression", "KHR_meshopt_compression")


def split_chunks(path: Path, data: bytes) -> tuple[JsonObject, bytes | None]:
    """Split a .glb file into its JSON document and its binary chunk, or None without one."""
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
            document = parse_document(path, data[place : place + size])
        elif kind == BINARY_CHUNK and binary is None:
            binary = data[place : place + size]
        place += size
    if document is None:
        raise FormatError(f"{path} is broken: it has no description of its meshes; export the mesh again")
    return document, binary


def parse_document(path: Path, data: bytes) -> JsonObject:
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
            self.fail(f"it refers to number {quote(index)} of its {name}, and has {len(entries)}")
        entry: JsonObject = entries[index]
        return entry

    def whole(self, holder: JsonObject, key: str, default: int | None = None) -> int:
        """Return a whole number of at least 0."""
        value = holder.get(key, default)
        if type(value) is not int or value < 0:
            self.fail(f"{key} is {quote(value)}, not a whole number")
        return value

    def numbers(self, holder: JsonObject, key: str, count: int, default: list[float]) -> Floats:
        """Return `count` finite numbers."""
        value = holder.get(key, default)
        is_valid = (
            isinstance(value, list) and len(value) == count and all(type(number) in (int, float) for number in value)
        )
        if not is_valid or not all(abs(number) < 1e300 for number in value):
            self.fail(f"a node has a {key} that is not {count} numbers: {quote(value)}")
        return np.array(value, dtype=np.float64)

    def part(self, holder: JsonObject, key: str) -> JsonObject:
        """Return an object inside another; empty if it is missing."""
        value = holder.get(key, {})
        if not isinstance(value, dict):
            self.fail(f"{key} is {quote(value)}, not an object")
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
            self.fail(f"buffer {index} has the address {quote(uri)}")
        if uri.startswith("data:"):
            head, _, encoded = uri.partition(",")
            if not head.endswith(";base64"):
                self.fail(f"buffer {index} is not in base64")
            return base64.b64decode(encoded, validate=True)
        name = unquote(uri)
        relative = Path(name)
        if re.match(r"[a-zA-Z][\w+.-]+:|[/\\]", name) or ".." in re.split(r"[/\\]", name) or relative.is_absolute():
            self.fail(f"its numbers lie in {quote(uri)}, outside its folder", "export it as .glb")
        file = self.path.parent / relative
        if not file.is_file():
            self.fail(
                f"its numbers lie in {quote(name)} and that is not there",
                "keep both files together, or export a .glb",
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
            self.fail(f"accessor {index} is {quote(description.get('type'))}, not {shape}")
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
            self.fail(f"a component type is {quote(kind)}, not one of {', '.join(map(str, KINDS))}")
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


def quote(value: object) -> str:
    """Return a value as a message shows it."""
    text = escape_unprintable(json.dumps(value, ensure_ascii=False, default=str))
    return text if len(text) <= 60 else text[:60] + "…"
