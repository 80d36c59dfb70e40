"""Volumes as other programs write them, byte by byte: every format, packing and order of bytes that is read."""

from __future__ import annotations

import base64
import bz2
import gzip
import io
import struct
import zipfile
import zlib
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
import tifffile

NRRD_TYPES = {"u1": "uchar", "i1": "int8", "i2": "short", "u2": "ushort", "i4": "int", "u4": "uint32", "f4": "float"}
NRRD_TYPES |= {"i8": "longlong", "u8": "uint64", "f8": "double"}
META_TYPES = {"u1": "UCHAR", "i1": "CHAR", "i2": "SHORT", "u2": "USHORT", "i4": "INT", "u4": "UINT", "f4": "FLOAT"}
META_TYPES |= {"i8": "LONG_LONG", "u8": "ULONG_LONG", "f8": "DOUBLE"}
NIFTI_TYPES = {"u1": 2, "i2": 4, "i4": 8, "f4": 16, "f8": 64, "i1": 256, "u2": 512, "u4": 768, "i8": 1024, "u8": 1280}
PACK: dict[str, Callable[[bytes], bytes]] = {
    "raw": bytes,
    "gzip": lambda data: gzip.compress(data, mtime=0),
    "gz": lambda data: gzip.compress(data[:50], mtime=0) + gzip.compress(data[50:], mtime=0),  # two members
    "bzip2": bz2.compress,
    "hex": lambda data: "\n".join(data.hex()[at : at + 70] for at in range(0, 2 * len(data), 70)).encode(),
}


@dataclass(frozen=True, kw_only=True)
class Written:
    """A file, those beside it, and where in which of them what is packed, with its checksum, lies."""

    name: str
    data: bytes
    beside: dict[str, bytes] = field(default_factory=dict)
    packed: tuple[str, int, int] | None = None  # name, first byte, and how many

    def files(self) -> dict[str, bytes]:
        return {self.name: self.data, **self.beside}


def flat(values: np.ndarray, order: str = "<") -> bytes:
    return values.astype(values.dtype.newbyteorder(order)).tobytes(order="F")


def text(values: np.ndarray) -> bytes:
    return ("\n".join(map(str, values.ravel(order="F").tolist())) + "\n").encode()


def nrrd_head(values: np.ndarray, encoding: str, *, order: str = "<", **fields: str | None) -> str:
    known: dict[str, str | None] = {
        "type": NRRD_TYPES[values.dtype.str[1:]],
        "dimension": str(values.ndim),
        "space": "left-posterior-superior",
        "sizes": " ".join(map(str, values.shape)),
        "space directions": "(1,0,0) (0,0.5,0) (0,0,3)",
        "endian": "little" if order == "<" else "big",
        "encoding": encoding,
        "space origin": "(-10,5,100)",
        **{key.replace("_", " "): text for key, text in fields.items()},
    }
    return "NRRD0004\n# a comment: with a colon\n" + "".join(f"{k}: {v}\n" for k, v in known.items() if v is not None)


def nrrd(values: np.ndarray, encoding: str = "raw", *, order: str = "<", **fields: str | None) -> Written:
    head = nrrd_head(values, encoding, order=order, **fields).encode() + b"\n"
    body = text(values) if encoding in ("text", "ascii") else PACK[encoding](flat(values, order))
    packed = ("a.nrrd", len(head), len(body)) if encoding in ("gzip", "gz", "bzip2") else None
    return Written(name="a.nrrd", data=head + body, packed=packed)


def nhdr(values: np.ndarray, encoding: str = "raw", **fields: str | None) -> Written:
    head = nrrd_head(values, encoding, data_file="a.raw", **fields).encode()
    body = PACK[encoding](flat(values))
    packed = ("a.raw", 0, len(body)) if encoding != "raw" else None
    return Written(name="a.nhdr", data=head, beside={"a.raw": body}, packed=packed)


def nhdr_list(values: np.ndarray, encoding: str = "raw") -> Written:
    names = [f"s{k}.raw" for k in range(values.shape[2])]
    head = nrrd_head(values, encoding, data_file="LIST").encode() + "".join(f"{name}\n" for name in names).encode()
    beside = {name: PACK[encoding](flat(values[:, :, k])) for k, name in enumerate(names)}
    packed = (names[1], 0, len(beside[names[1]])) if encoding != "raw" else None
    return Written(name="a.nhdr", data=head, beside=beside, packed=packed)


def nhdr_numbered(values: np.ndarray) -> Written:
    head = nrrd_head(values, "raw", data_file=f"./s%02d.raw 0 {values.shape[2] - 1} 1").encode()
    beside = {f"s{k:02d}.raw": flat(values[:, :, k]) for k in range(values.shape[2])}
    return Written(name="a.nhdr", data=head, beside=beside)


def nhdr_skipping(values: np.ndarray, encoding: str = "raw", lines: int = 0, skip: int = 0) -> Written:
    head = nrrd_head(values, encoding, data_file="a.raw", line_skip=str(lines), byte_skip=str(skip)).encode()
    before, inside = b"a line\n" * lines, b"#" * (100 if skip < 0 else skip)
    body = before + (inside + flat(values) if encoding == "raw" else PACK[encoding](inside + flat(values)))
    packed = ("a.raw", len(before), len(body) - len(before)) if encoding != "raw" else None
    return Written(name="a.nhdr", data=head, beside={"a.raw": body}, packed=packed)


def meta_head(values: np.ndarray, data: str, *, order: str = "<", **fields: str | None) -> bytes:
    known: dict[str, str | None] = {
        "ObjectType": "Image",
        "NDims": str(values.ndim),
        "BinaryData": "True",
        "BinaryDataByteOrderMSB": str(order == ">"),
        "TransformMatrix": "1 0 0 0 1 0 0 0 1",
        "Offset": "-10 5 100",
        "ElementSpacing": "1 0.5 3",
        "DimSize": " ".join(map(str, values.shape)),
        "ElementType": f"MET_{META_TYPES[values.dtype.str[1:]]}",
        **fields,
    }
    lines = [f"{key} = {each}" for key, each in known.items() if each is not None]
    return "\n".join([*lines, f"ElementDataFile = {data}", ""]).encode()


def mha(
    values: np.ndarray, *, packed: bool = False, sized: bool = True, order: str = "<", **more: str | None
) -> Written:
    body = flat(values, order)
    fields: dict[str, str | None] = {}
    if packed:
        body = zlib.compress(body)
        fields = {"CompressedData": "True", "CompressedDataSize": str(len(body)) if sized else None}
    head = meta_head(values, "LOCAL", order=order, **fields, **more)
    return Written(name="a.mha", data=head + body, packed=("a.mha", len(head), len(body)) if packed else None)


def mha_text(values: np.ndarray) -> Written:
    return Written(name="a.mha", data=meta_head(values, "LOCAL", BinaryData="False") + text(values))


def mhd(values: np.ndarray, *, packed: bool = False, sized: bool = True, header: int = 0, end: bool = False) -> Written:
    body = flat(values)
    fields: dict[str, str | None] = {}
    if packed:
        body = zlib.compress(body)
        fields = {"CompressedData": "True", "CompressedDataSize": str(len(body)) if sized else None}
    if header:
        fields["HeaderSize"] = "-1" if end else str(header)
    head = meta_head(values, "a.raw", **fields)
    place = ("a.raw", header, len(body)) if packed else None
    return Written(name="a.mhd", data=head, beside={"a.raw": b"#" * header + body}, packed=place)


def mhd_list(values: np.ndarray, *, packed: bool = False, numbered: bool = False) -> Written:
    names = [f"s{k:03d}.raw" for k in range(values.shape[2])]
    if numbered:
        data = f"s%03d.raw 0 {values.shape[2] - 1} 1"
    else:
        data = "LIST\n" + "\n".join(names)
    head = meta_head(values, data, CompressedData=str(packed))
    pack = zlib.compress if packed else bytes
    beside = {name: pack(flat(values[:, :, k])) for k, name in enumerate(names)}
    return Written(
        name="a.mhd", data=head, beside=beside, packed=(names[2], 0, len(beside[names[2]])) if packed else None
    )


def nifti_head(
    values: np.ndarray,
    *,
    version: int = 1,
    order: str = "<",
    sform: np.ndarray | None = None,
    sform_code: int = 1,
    quaternion: tuple[float, ...] = (0, 0, 0, 0, 0, 0),
    qform_code: int = 0,
    pixdim: tuple[float, ...] = (1, 1, 0.5, 3),
    units: int = 2,
    slope: tuple[float, float] = (0, 0),
) -> bytes:
    dims = [values.ndim, *values.shape, *[1] * (7 - values.ndim)]
    sizes = [*pixdim, *[1] * (8 - len(pixdim))]
    affine = np.array([[-1, 0, 0, 10], [0, -0.5, 0, -5], [0, 0, 3, 100.0]]) if sform is None else sform[:3]
    kind, bits = NIFTI_TYPES[values.dtype.str[1:]], 8 * values.dtype.itemsize
    if version == 1:
        head = bytearray(352)
        for form, at, numbers in (
            ("i", 0, [348]),
            ("8h", 40, dims),
            ("2h", 70, [kind, bits]),
            ("8f", 76, sizes),
            ("3f", 108, [352, *slope]),
            ("B", 123, [units]),
            ("2h", 252, [qform_code, sform_code]),
            ("6f", 256, quaternion),
            ("12f", 280, affine.ravel()),
            ("4s", 344, [b"n+1\0"]),
        ):
            struct.pack_into(order + form, head, at, *numbers)
        return bytes(head)
    head = bytearray(544)
    for form, at, numbers in (
        ("i8s2h8q", 0, [540, b"n+2\0\r\n\x1a\n", kind, bits, *dims]),
        ("8d", 104, sizes),
        ("q2d", 168, [544, *slope]),
        ("2i", 344, [qform_code, sform_code]),
        ("6d", 352, quaternion),
        ("12d", 400, affine.ravel()),
        ("i", 500, [units]),
    ):
        struct.pack_into(order + form, head, at, *numbers)
    return bytes(head)


def nifti(values: np.ndarray, *, packed: bool = False, version: int = 1, order: str = "<", **more: object) -> Written:
    whole = nifti_head(values, version=version, order=order, **more) + flat(values, order)  # type: ignore[arg-type]
    if not packed:
        return Written(name="a.nii", data=whole)
    whole = gzip.compress(whole, mtime=0)
    return Written(name="a.nii.gz", data=whole, packed=("a.nii.gz", 0, len(whole)))


def mgh(values: np.ndarray, *, packed: bool = False) -> Written:
    kinds = {"u1": 0, "i4": 1, "f4": 3, "i2": 4, "u2": 10}
    head = struct.pack(
        ">7ih15f",
        1,
        *values.shape,
        1,
        kinds[values.dtype.str[1:]],
        0,
        1,
        1,
        0.5,
        3,
        -1,
        0,
        0,
        0,
        -1,
        0,
        0,
        0,
        1,
        0,
        0,
        0,
    )
    whole = head.ljust(284, b"\0") + flat(values, ">")
    if not packed:
        return Written(name="a.mgh", data=whole)
    whole = gzip.compress(whole, mtime=0)
    return Written(name="a.mgz", data=whole, packed=("a.mgz", 0, len(whole)))


def npy(values: np.ndarray) -> Written:
    file = io.BytesIO()
    np.save(file, values)
    return Written(name="a.npy", data=file.getvalue())


def npz(values: np.ndarray, *, packed: bool = True) -> Written:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED if packed else zipfile.ZIP_STORED) as archive:
        archive.writestr("values.npy", npy(values).data)
    # Stored members have a checksum too: behind a local header of 30 bytes and the name.
    end = file.getvalue().index(b"PK\1\2")
    return Written(name="a.npz", data=file.getvalue(), packed=("a.npz", 40, end - 40))


def tiff(values: np.ndarray, compression: str | None = None, **more: object) -> Written:
    file = io.BytesIO()
    tifffile.imwrite(file, values.T, compression=compression, **more)  # type: ignore[arg-type]
    data = file.getvalue()
    if compression is None:
        return Written(name="a.tif", data=data)
    with tifffile.TiffFile(io.BytesIO(data)) as read:
        page = read.pages[2]
        return Written(name="a.tif", data=data, packed=("a.tif", page.dataoffsets[0], page.databytecounts[0]))


def vtk(values: np.ndarray, *, as_text: bool = False) -> Written:
    kinds = {"u1": "unsigned_char", "i2": "short", "i4": "int", "f4": "float", "f8": "double"}
    head = (
        f"# vtk DataFile Version 3.0\nmade by hand\n{'ASCII' if as_text else 'BINARY'}\nDATASET STRUCTURED_POINTS\n"
        f"DIMENSIONS {' '.join(map(str, values.shape))}\nORIGIN -10 5 100\nSPACING 1 0.5 3\nPOINT_DATA {values.size}\n"
        f"SCALARS a {kinds[values.dtype.str[1:]]} 1\nLOOKUP_TABLE default\n"
    ).encode()
    return Written(name="a.vtk", data=head + (text(values) if as_text else flat(values, ">")) + b"\n")


def vti(
    values: np.ndarray, *, form: str = "appended", packed: bool = True, raw: bool = True, block: int = 300
) -> Written:
    kinds = {"u1": "UInt8", "i2": "Int16", "i4": "Int32", "f4": "Float32", "f8": "Float64"}
    data = flat(values)
    if packed:
        blocks = [zlib.compress(data[at : at + block]) for at in range(0, len(data), block)]
        sizes = [len(blocks), block, len(data) % block, *map(len, blocks)]
        pieces = [np.array(sizes, "<u4").tobytes(), b"".join(blocks)]
    else:
        pieces = [np.array([len(data)], "<u4").tobytes() + data]
    coded = b"".join(pieces) if raw else b"".join(base64.b64encode(piece) for piece in pieces)
    extent = " ".join(f"0 {count - 1}" for count in values.shape)
    compressor = ' compressor="vtkZLibDataCompressor"' if packed else ""
    head = (
        f'<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt32"{compressor}>\n'
        f'<ImageData WholeExtent="{extent}" Origin="-10 5 100" Spacing="1 0.5 3">\n<Piece Extent="{extent}">'
        f'<PointData Scalars="a"><DataArray type="{kinds[values.dtype.str[1:]]}" Name="a" format="{form}"'
        + (' offset="0">' if form == "appended" else ">")
    ).encode()
    if form == "ascii":
        head += text(values)
    if form == "binary":
        head += coded
    head += b"</DataArray></PointData></Piece></ImageData>\n"
    if form != "appended":
        return Written(name="a.vti", data=head + b"</VTKFile>\n")
    head += f'<AppendedData encoding="{"raw" if raw else "base64"}">\n_'.encode()
    begin = len(head) + len(pieces[0])
    packing = ("a.vti", begin, len(pieces[1])) if packed and raw else None
    return Written(name="a.vti", data=head + coded + b"\n</AppendedData></VTKFile>\n", packed=packing)


# Every way to write one volume, by name.
WAYS: dict[str, Callable[[np.ndarray], Written]] = {
    **{f"nrrd {each}": lambda v, e=each: nrrd(v, e) for each in (*PACK, "text")},
    "nrrd big": lambda v: nrrd(v, order=">"),
    **{f"nhdr {each}": lambda v, e=each: nhdr(v, e) for each in ("raw", "gzip", "bzip2")},
    "nhdr list": nhdr_list,
    "nhdr list gzip": lambda v: nhdr_list(v, "gzip"),
    "nhdr numbered": nhdr_numbered,
    "nhdr skipping": lambda v: nhdr_skipping(v, lines=2, skip=5),
    "nhdr from the end": lambda v: nhdr_skipping(v, skip=-1),
    "nhdr skipping gzip": lambda v: nhdr_skipping(v, "gzip", lines=1, skip=7),
    "mha": mha,
    "mha big": lambda v: mha(v, order=">"),
    "mha packed": lambda v: mha(v, packed=True),
    "mha packed without size": lambda v: mha(v, packed=True, sized=False),
    "mha text": mha_text,
    "mhd": mhd,
    "mhd packed": lambda v: mhd(v, packed=True),
    "mhd packed without size": lambda v: mhd(v, packed=True, sized=False),
    "mhd header": lambda v: mhd(v, header=33),
    "mhd from the end": lambda v: mhd(v, header=33, end=True),
    "mhd list": mhd_list,
    "mhd list packed": lambda v: mhd_list(v, packed=True),
    "mhd numbered": lambda v: mhd_list(v, numbered=True),
    "nii": nifti,
    "nii big": lambda v: nifti(v, order=">"),
    "nii.gz": lambda v: nifti(v, packed=True),
    "nii 2": lambda v: nifti(v, version=2),
    "nii.gz 2 big": lambda v: nifti(v, version=2, packed=True, order=">"),
    "mgh": mgh,
    "mgz": lambda v: mgh(v, packed=True),
    "npy": npy,
    "npz": npz,
    "npz stored": lambda v: npz(v, packed=False),
    "tif": tiff,
    "tif zlib": lambda v: tiff(v, "zlib"),
    "vtk": vtk,
    "vtk text": lambda v: vtk(v, as_text=True),
    "vti raw": lambda v: vti(v, packed=False),
    "vti zlib": vti,
    "vti base64": lambda v: vti(v, packed=False, raw=False),
    "vti zlib base64": lambda v: vti(v, raw=False),
    "vti binary": lambda v: vti(v, form="binary", packed=False, raw=False),
    "vti binary zlib": lambda v: vti(v, form="binary", raw=False),
    "vti text": lambda v: vti(v, form="ascii", packed=False, raw=False),
}
