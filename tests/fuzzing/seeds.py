"""Small valid files of every format that a command reads, by name. Most are written by other libraries than ours."""

from __future__ import annotations

import gzip
import io
import json
import re
import tempfile
import zipfile
import zlib
from pathlib import Path

import numpy as np
import trimesh

from tests.handmade_prints import Dialect, written

MESHES = ("stl", "obj", "ply", "off", "glb")
LARGEST = 40_000  # bytes of a file of the corpus that is taken as a seed: mutations of more are mostly harmless


def mesh_seeds() -> dict[str, bytes]:
    """A box with a hole, two parts, polygons; binary and text."""
    box = trimesh.creation.box((20, 10, 5))
    tube = trimesh.creation.annulus(3, 5, 8, sections=12)
    both = trimesh.util.concatenate([box, tube.apply_translation((30, 0, 0))])
    files = {
        f"{name}.{suffix}": _exported(mesh, suffix)
        for name, mesh in (("box", box), ("both", both))
        for suffix in MESHES
    }
    files["ascii.stl"] = trimesh.exchange.stl.export_stl_ascii(tube).encode()
    files["ascii.ply"] = trimesh.exchange.ply.export_ply(tube, encoding="ascii")
    files["quads.obj"] = _polygons_obj()
    files["mixed.ply"] = _polygons_ply()
    files["polygons.off"] = _polygons_off()
    files["box.3mf"] = _package(box)
    files["both.3mf"] = _package(box, tube)
    files["scene.glb"] = _exported(trimesh.Scene([box, tube]), "glb")
    return files


def volume_seeds() -> dict[str, bytes]:
    """A block in a noisy box: text headers, packed and raw, written by nibabel, SimpleITK, tifffile and by hand."""
    import nibabel
    import SimpleITK
    import tifffile

    cells = np.random.default_rng(3).integers(0, 200, (14, 12, 10)).astype("<i2")
    cells[4:10, 3:9, 2:8] += 1000
    files: dict[str, bytes] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        affine = np.diag([1.0, 0.5, 3.0, 1.0])
        affine[:3, 3] = -10, 5, 100
        for suffix in ("nii", "nii.gz"):
            nibabel.save(nibabel.Nifti1Image(cells, affine), folder / f"n.{suffix}")
        nibabel.save(nibabel.Nifti2Image(cells, affine), folder / "two.nii")
        nibabel.save(nibabel.freesurfer.MGHImage(cells.astype(np.int32), affine), folder / "m.mgz")
        image = SimpleITK.GetImageFromArray(np.ascontiguousarray(cells.T))
        image.SetSpacing((1, 0.5, 3))
        image.SetOrigin((-10, 5, 100))
        for stem, packed in (("raw", False), ("packed", True)):
            for suffix in ("mha", "nrrd"):
                SimpleITK.WriteImage(image, str(folder / f"{stem}.{suffix}"), packed)
        SimpleITK.WriteImage(image, str(folder / "legacy.vtk"))
        tifffile.imwrite(
            folder / "t.tif",
            np.ascontiguousarray(cells.T).astype(np.uint16),
            imagej=True,
            resolution=(2.0, 2.0),
            metadata={"spacing": 3.0, "unit": "mm"},
        )
        np.save(folder / "a.npy", cells)
        np.savez_compressed(folder / "a.npz", cells)
        for path in sorted(folder.iterdir()):
            files[path.name] = path.read_bytes()
    files["image.vti"] = _vti(cells)
    files["frames.dcm"] = _dicom(cells)
    return files


def point_seeds() -> dict[str, bytes]:
    """Points on a ball, as text, table, array and PLY."""
    ball = trimesh.creation.icosphere(subdivisions=2, radius=5.0)
    points = np.asarray(ball.vertices)
    text = io.StringIO()
    np.savetxt(text, np.hstack([points, ball.vertex_normals]), fmt="%.4f")
    array = io.BytesIO()
    np.save(array, points)
    rows = text.getvalue()
    return {
        "points.xyz": rows.encode(),
        "points.pts": f"{len(points)}\n{rows}".encode(),
        "points.csv": ("x,y,z,nx,ny,nz\n" + rows.replace(" ", ",")).encode(),
        "points.npy": array.getvalue(),
        "points.ply": trimesh.PointCloud(points).export(file_type="ply"),
    }


def drawing_seeds() -> dict[str, bytes]:
    """A leaf and its relatives, as SVG, DXF, WKT and PNG."""
    import ezdxf
    from PIL import Image

    svg = (
        '<?xml version="1.0" encoding="UTF-8"?><svg xmlns="http://www.w3.org/2000/svg" width="20mm" height="20mm" viewBox="0 0 20 20">'
        '<defs><g id="leaf"><path d="M2 2 C 4 8, 8 8, 10 2 S 16 2 18 10 A 4 4 30 1 0 12 14 Q 8 18 4 12 T 2 2 Z"/></g></defs>'
        '<use href="#leaf" transform="translate(1 1) rotate(10) scale(.9)"/><circle cx="10" cy="10" r="3"/>'
        '<polyline points="1,19 5,15 9,19"/><rect x="1" y="1" width="18" height="18" rx="2"/><text x="1" y="1">a</text></svg>'
    )
    document = ezdxf.new(setup=False)
    space = document.modelspace()
    space.add_line((0, 0), (20, 0))
    space.add_arc((10, 10), 5, 20, 300)
    space.add_lwpolyline([(0, 0, 0.5), (10, 0), (10, 10)], format="xyb", close=True)
    space.add_spline([(0, 0), (5, 9), (12, 3), (20, 20)])
    space.add_ellipse((10, 10), (6, 0), 0.5)
    document.blocks.new("B").add_circle((0, 0), 2)
    space.add_blockref("B", (3, 3), dxfattribs={"xscale": 2, "rotation": 30})
    text = io.StringIO()
    ezdxf.options.write_fixed_meta_data_for_testing = True
    document.write(text)
    picture = io.BytesIO()
    grey = np.full((24, 24), 255, np.uint8)
    grey[6:18, 8:16] = 0
    Image.fromarray(grey).save(picture, "PNG")
    wkt = "LINESTRING (0 0, 10 5, 20 0)\nPOLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (2 2, 4 2, 4 4, 2 2))\nGEOMETRYCOLLECTION (MULTILINESTRING ((1 1, 2 9), (3 3, 9 1)), POINT (1 2))\n"
    return {
        "leaf.svg": svg.encode(),
        "lines.dxf": re.sub(r"[\d.]+ @ \d.*", "1.4.5 @ 2026-01-02", text.getvalue()).encode(),
        "lines.wkt": wkt.encode(),
        "dark.png": picture.getvalue(),
    }


def print_seeds() -> dict[str, bytes]:
    """Sliced prints in the dialects of several slicers."""
    small = {"layers": 4, "size": 9.0}
    dialects = {
        "prusa": Dialect(**small),
        "orca": Dialect(slicer="orca", labels="EXCLUDE_OBJECT", **small),
        "bambu": Dialect(slicer="bambu", absolute=True, **small),
        "cura": Dialect(slicer="cura", absolute=True, wipe=False, **small),
        "arcs": Dialect(arcs=True, firmware=True, numbered=True, **small),
        "packed": Dialect(packed=True, crlf=True, tools=2, **small),
    }
    return {f"{name}.gcode": written(dialect) for name, dialect in dialects.items()}


def field_seeds() -> dict[str, bytes]:
    """Fields over the box of `print_seeds`, 9 mm wide: a table, and results of a simulation in two formats."""
    points = np.stack(np.meshgrid([0.0, 4.5, 9.0], [0.0, 9.0], [0.0, 0.8], indexing="ij"), axis=-1).reshape(-1, 3)
    values, bed = points[:, 0] + 0.5 * points[:, 1], np.array([100.0, 100.0, 0.0])
    rows = [",".join(map(str, [*(point + bed), value])) for point, value in zip(points, values, strict=True)]
    nodes = "\n".join(f" -1{n:10d}" + "".join(f"{x:12.5E}" for x in point) for n, point in enumerate(points, 1))
    stresses = "\n".join(f" -1{n:10d}{value:12.5E}{0:12.5E}" for n, value in enumerate(values, 1))
    return {
        "table.csv": ("x,y,z,value\n" + "\n".join(rows)).encode(),
        "results.frd": (
            f"    1C\n    2C{len(points):30d}{1:38d}\n{nodes}\n -3\n  100CL  101 1.000000000{len(points):12d}{0:21d}{1:5d}"
            f"{1:12d}\n -4  STRESS      3    1\n -5  SXX         1    4    1    1\n -5  SYY         1    4    2    2\n"
            f" -5  ALL         1    2    0    0    1ALL\n{stresses}\n -3\n 9999\n"
        ).encode(),
        "mesh.vtu": _vtu(points, values),
    }


def printer_seeds() -> dict[str, bytes]:
    """Limits of printers: Klipper's configuration, Moonraker's answer, and Marlin's to M503."""
    klipper = (
        "[include gone/*.cfg]\n[printer]\nkinematics: corexy\nmax_velocity: 300 # fast\nmax_accel = 3000\n"
        "max_z_velocity: 15\nmax_accel_to_decel: 1500\n[extruder]\nnozzle_diameter: 0.4\nfilament_diameter: 1.75\n"
        "[gcode_macro START_PRINT]\ngcode:\n    {% set bed = 60 %}\n    SET_VELOCITY_LIMIT ACCEL=900\n    M204 S800\n"
        "#*# <---------------------- SAVE_CONFIG ---------------------->\n#*# [printer]\n#*# max_accel = 7\n"
    )
    printer = {"kinematics": "delta", "max_velocity": 300.0, "max_accel": 3000.0, "minimum_cruise_ratio": 0.5}
    status = {
        "configfile": {"settings": {"printer": printer, "gcode_macro start_print": {"gcode": "M204 S500"}}},
        "toolhead": {"max_velocity": 250.0, "max_accel": 2000.0, "square_corner_velocity": 5.0},
    }
    marlin = (
        "Recv: echo:  G21    ; Units in mm\nRecv: echo:; Maximum feedrates (units/s):\n"
        "Recv: echo:  M203 X300.00 Y300.00 Z5.00 E25.00\nRecv: echo:  M201 X3000.00 Y3000.00 Z100.00 E10000.00\n"
        "Recv: echo:  M204 P500.00 R1000.00 T500.00\nRecv: echo:  M205 B20000.00 S0.00 T0.00 J0.08\n"
    )
    return {
        "printer.cfg": klipper.encode(),
        "answer.json": json.dumps({"result": {"eventtime": 1.5, "status": status}}).encode(),
        "m503.txt": marlin.encode(),
    }


def settings_seeds() -> dict[str, bytes]:
    """Options in TOML, as `--save-config` writes them."""
    fill = 'pattern = "gyroid"\ndensity = 0.2\nwall = 1.2\nline-width = 0.45\n'
    make = 'pattern = "honeycomb"\nsize = [60.0, 40.0]\nheight = 6.0\ncell = 6.0\n[set]\nangle = 5.0\n'
    return {"fill.toml": fill.encode(), "make.toml": make.encode()}


def corpus_seeds(folder: Path, suffixes: tuple[str, ...]) -> dict[str, bytes]:
    """Small real files below a folder, with one of the suffixes."""
    paths = sorted(
        path for path in folder.rglob("*") if path.suffix.lower() in suffixes and path.stat().st_size <= LARGEST
    )
    return {path.name: path.read_bytes() for path in paths}


def _exported(mesh: trimesh.Trimesh | trimesh.Scene, suffix: str) -> bytes:
    data = mesh.export(file_type=suffix)
    return data.encode() if isinstance(data, str) else bytes(data)


RING = [(20, 10), (10, 10), (10, 30), (0, 30), (0, 0), (20, 0)]  # an L, from a corner that a fan would leave


def _package(*meshes: trimesh.Trimesh) -> bytes:
    """Return a 3MF: an object a mesh, all of them components of one, and settings as PrusaSlicer writes them."""
    core = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
    objects = []
    for number, mesh in enumerate(meshes, 1):
        points = "".join(f'<vertex x="{x:g}" y="{y:g}" z="{z:g}"/>' for x, y, z in mesh.vertices)
        faces = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in mesh.faces)
        objects.append(
            f'<object id="{number}" type="model"><mesh><vertices>{points}</vertices><triangles>{faces}</triangles></mesh></object>'
        )
    parts = "".join(
        f'<component objectid="{number}" transform="1 0 0 0 1 0 0 0 1 {number} 0 0"/>'
        for number in range(1, len(meshes) + 1)
    )
    model = (
        f'<?xml version="1.0" encoding="UTF-8"?><model unit="millimeter" xml:lang="en-US" xmlns="{core}"><metadata name="Title">a</metadata>'
        f'<resources>{"".join(objects)}<object id="9" type="model"><components>{parts}</components></object></resources>'
        '<build><item objectid="9" transform="0 1 0 -1 0 0 0 0 1 5 5 0"/></build></model>'
    )
    types = (
        '<?xml version="1.0" encoding="UTF-8"?><Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" '
        'ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" '
        'ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>'
    )
    relations = (
        '<?xml version="1.0" encoding="UTF-8"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship '
        'Target="/3D/3dmodel.model" Id="r0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
    )
    last = len(meshes[0].faces) - 1
    settings = (
        f'<?xml version="1.0" encoding="UTF-8"?><config><object id="9" instances_count="1"><volume firstid="0" lastid="{last}"><metadata type="volume" '
        'key="volume_type" value="ModelPart"/></volume></object></config>'
    )
    members = {
        "[Content_Types].xml": types,
        "_rels/.rels": relations,
        "3D/3dmodel.model": model,
        "Metadata/Slic3r_PE_model.config": settings,
    }
    return repacked_zip({name: text.encode() for name, text in members.items()})


def _l_shape() -> tuple[list[tuple[int, int, int]], list[list[int]]]:
    n = len(RING)
    points = [(x, y, z) for z in (0, 5) for x, y in RING]
    sides = [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)]
    return points, [list(range(n - 1, -1, -1)), list(range(n, 2 * n)), *sides]


def _polygons_obj() -> bytes:
    points, faces = _l_shape()
    rows = [
        "o part",
        *(f"v {x} {y} {z}" for x, y, z in points),
        *("f " + " ".join(f"{k + 1}//1" for k in face) for face in faces),
    ]
    return "\n".join(rows).encode()


def _polygons_ply() -> bytes:
    points, faces = _l_shape()
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    body = b"".join(bytes([len(face)]) + np.array(face, "<i4").tobytes() for face in faces)
    return head.encode() + np.array(points, "<f4").tobytes() + body


def _polygons_off() -> bytes:
    points, faces = _l_shape()
    rows = [
        "OFF",
        f"{len(points)} {len(faces)} 0",
        *(f"{x} {y} {z}" for x, y, z in points),
        *(" ".join(map(str, [len(face), *face])) for face in faces),
    ]
    return "\n".join(rows).encode()


def _vti(cells: np.ndarray) -> bytes:
    import base64

    raw = np.asfortranarray(cells).tobytes(order="F")
    packed = zlib.compress(raw)
    head = np.array([1, len(raw), 0, len(packed)], "<u4").tobytes()
    data = (base64.b64encode(head) + base64.b64encode(packed)).decode()
    extent = f"0 {cells.shape[0] - 1} 0 {cells.shape[1] - 1} 0 {cells.shape[2] - 1}"
    return (
        '<?xml version="1.0"?><VTKFile type="ImageData" version="0.1" byte_order="LittleEndian" compressor="vtkZLibDataCompressor">'
        f'<ImageData WholeExtent="{extent}" Origin="-10 5 100" Spacing="1 0.5 3"><Piece Extent="{extent}"><PointData Scalars="a">'
        f'<DataArray type="Int16" Name="a" format="binary">{data}</DataArray></PointData></Piece></ImageData></VTKFile>'
    ).encode()


def _vtu(points: np.ndarray, values: np.ndarray) -> bytes:
    """Write two cells of points along x: their places packed and appended, values at points in base64, cells as text."""
    import base64

    raw = points.astype("<f8").tobytes()
    packed = zlib.compress(raw)
    places = np.array([1, len(raw), 0, len(packed)], "<u4").tobytes() + packed
    raw = values.astype("<f4").tobytes()
    packed = zlib.compress(raw)
    load = base64.b64encode(np.array([1, len(raw), 0, len(packed)], "<u4").tobytes()) + base64.b64encode(packed)
    corners = " ".join(map(str, [*range(8), *range(4, 12)]))
    return (
        (
            '<?xml version="1.0"?><VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" '
            'compressor="vtkZLibDataCompressor"><UnstructuredGrid><Piece NumberOfPoints="12" NumberOfCells="2"><PointData>'
            f'<DataArray type="Float32" Name="load" format="binary">{load.decode()}</DataArray></PointData><Points>'
            '<DataArray type="Float64" Name="Points" NumberOfComponents="3" format="appended" offset="0"/></Points><Cells>'
            f'<DataArray type="Int64" Name="connectivity" format="ascii">{corners}</DataArray><DataArray type="Int64" '
            'Name="offsets" format="ascii">8 16</DataArray></Cells></Piece></UnstructuredGrid><AppendedData encoding="raw">_'
        ).encode()
        + places
        + b"</AppendedData></VTKFile>"
    )


def _dicom(cells: np.ndarray) -> bytes:
    from pydicom.dataset import Dataset, FileMetaDataset
    from pydicom.uid import EnhancedCTImageStorage, ExplicitVRLittleEndian

    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = EnhancedCTImageStorage, "2.25.1"
    meta.TransferSyntaxUID = ExplicitVRLittleEndian
    data = Dataset()
    data.SOPClassUID, data.SOPInstanceUID, data.Modality = EnhancedCTImageStorage, "2.25.1", "CT"
    data.SeriesInstanceUID, data.StudyInstanceUID = "2.25.2", "2.25.3"
    data.Rows, data.Columns, data.NumberOfFrames = cells.shape[1], cells.shape[0], cells.shape[2]
    data.SamplesPerPixel, data.PhotometricInterpretation = 1, "MONOCHROME2"
    data.BitsAllocated = data.BitsStored = 16
    data.HighBit, data.PixelRepresentation = 15, 1
    shared, measures, orientation = Dataset(), Dataset(), Dataset()
    measures.PixelSpacing, measures.SliceThickness = [0.5, 1.0], 3.0
    orientation.ImageOrientationPatient = [1, 0, 0, 0, 1, 0]
    shared.PixelMeasuresSequence, shared.PlaneOrientationSequence = [measures], [orientation]
    data.SharedFunctionalGroupsSequence = [shared]
    frames = []
    for k in range(cells.shape[2]):
        frame, position = Dataset(), Dataset()
        position.ImagePositionPatient = [-10.0, 5.0, 100.0 + 3 * k]
        frame.PlanePositionSequence = [position]
        frames.append(frame)
    data.PerFrameFunctionalGroupsSequence = frames
    data.PixelData = np.ascontiguousarray(cells.T).tobytes()
    data.file_meta = meta
    file = io.BytesIO()
    data.save_as(file, enforce_file_format=True)
    return file.getvalue()


def repacked_zip(members: dict[str, bytes]) -> bytes:
    """Return a ZIP file with these members."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in members.items():
            member = zipfile.ZipInfo(name)  # without the time of day: seeds are the same in every run
            member.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(member, data)
    return file.getvalue()


def unzipped(data: bytes) -> dict[str, bytes] | None:
    """Return the members of a ZIP file, or None if it is none, or a broken one."""
    broken = (zipfile.BadZipFile, zlib.error, ValueError, OSError, EOFError, LookupError, RuntimeError)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return {name: archive.read(name) for name in archive.namelist()}
    except broken:
        return None


def gunzipped(data: bytes) -> bytes | None:
    """Return what a gzip file holds, or None if it is none, or a broken one."""
    try:
        return gzip.decompress(data)
    except (OSError, EOFError, zlib.error):
        return None


def glb_parts(data: bytes) -> tuple[dict[str, object], bytes]:
    """Return the JSON of a GLB and what follows it."""
    size = int.from_bytes(data[12:16], "little")
    return json.loads(data[20 : 20 + size]), data[20 + size :]
