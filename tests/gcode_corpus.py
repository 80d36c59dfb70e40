"""Prints of every kind that a refill meets: sliced here, small, by PrusaSlicer and CuraEngine, and made by hand.

`CORPUS` says in a line what each is; `corpus(folder)` makes one when it is asked for, once.
"""

from __future__ import annotations

import zipfile
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import trimesh
from hypothesis import strategies as st

from tests.handmade_prints import Dialect, written
from tests.prints import cura_print, prusa_print
from tests.slicers import missing_cura, missing_prusa

FEW: Mapping[str, object] = {"top_solid_layers": 1, "bottom_solid_layers": 1}
CURA_FEW: Mapping[str, object] = {"top_layers": 1, "bottom_layers": 1, "initial_bottom_layers": 1}
ABSOLUTE: Mapping[str, object] = {"use_relative_e_distances": 0, "layer_gcode": ""}
TWO: Mapping[str, object] = {
    "nozzle_diameter": "0.4,0.4",
    "filament_diameter": "1.75,1.75",
    "temperature": "210,220",
    "first_layer_temperature": "215,225",
    "retract_length": "0.8,0.8",
    "retract_speed": "35,35",
    "retract_lift": "0.4,0.4",
    "retract_before_travel": "1,1",
    "wipe": "1,1",
}


@dataclass(frozen=True)
class Print:
    """One print of the corpus: what it is, how it is made, what must be there to make it."""

    summary: str
    make: Callable[[Path], Path]  # in a folder
    missing: Callable[[], str] = str
    infilled: bool = True
    stands: bytes = b""  # what stands in it, if it is what it should be
    settings: Mapping[str, object] | None = None  # of PrusaSlicer, if it slices one mesh


def block(folder: Path, size: tuple[float, float, float] = (12, 12, 1.2), name: str = "block") -> Path:
    path = folder / f"{name}.stl"
    mesh = trimesh.creation.box(size)
    mesh.apply_translation([0, 0, size[2] / 2])
    mesh.export(path)
    return path


def ring(folder: Path) -> Path:
    """A thick ring, so that there is a hole that no infill may bridge."""
    path = folder / "ring.stl"
    trimesh.creation.annulus(r_min=4, r_max=9.5, height=1.2, sections=24).export(path)
    return path


def overhang(folder: Path) -> Path:
    """A block with a ledge that asks for support."""
    path = folder / "overhang.stl"
    ledge = trimesh.creation.box([16, 8, 0.8])
    ledge.apply_translation([4, 0, 2])
    foot = trimesh.creation.box([8, 8, 1.8])
    foot.apply_translation([0, 0, 0.9])
    trimesh.boolean.union([foot, ledge], engine="manifold").export(path)
    return path


def two(folder: Path) -> list[Path]:
    return [block(folder, name="one"), block(folder, (10, 14, 1.2), name="other")]


def in_ranges(folder: Path) -> Path:
    """A 3MF file that asks for thinner layers in its upper half."""
    path = folder / "ranges.3mf"
    mesh = trimesh.load_mesh(block(folder))
    points = "".join(f'<vertex x="{x:g}" y="{y:g}" z="{z:g}"/>' for x, y, z in mesh.vertices)
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in mesh.faces)
    head = '<?xml version="1.0" encoding="utf-8"?>\n'
    ranges = '<range min_z="0.6" max_z="1.2"><option opt_key="extruder">0</option><option opt_key="layer_height">0.1</option>'
    files = {
        "[Content_Types].xml": '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default '
        'Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default '
        'Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>',
        "_rels/.rels": '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship '
        'Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>'
        "</Relationships>",
        "3D/3dmodel.model": '<model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" '
        'xmlns:slic3rpe="http://schemas.slic3r.org/3mf/2017/06"><metadata name="slic3rpe:Version3mf">1</metadata>'
        f'<resources><object id="1" type="model"><mesh><vertices>{points}</vertices><triangles>{triangles}</triangles>'
        '</mesh></object></resources><build><item objectid="1"/></build></model>',
        "Metadata/Prusa_Slicer_layer_config_ranges.xml": f'<objects><object id="1">{ranges}</range></object></objects>',
    }
    with zipfile.ZipFile(path, "w") as archive:
        for name, text in files.items():
            archive.writestr(name, head + text)
    return path


def prusa(summary: str, part: Callable[[Path], Path | list[Path]] = block, *, stands: bytes = b"", **settings) -> Print:
    def make(folder: Path) -> Path:
        return prusa_print(part(folder), folder / "print.gcode", {**FEW, **settings})

    return Print(
        summary,
        make,
        missing_prusa,
        infilled=settings.get("fill_density") != "0%",
        stands=stands,
        settings={**FEW, **settings} if part in (block, ring, overhang) else None,
    )


def cura(summary: str, part: Callable[[Path], Path] = block, *, stands: bytes = b"", **settings) -> Print:
    def make(folder: Path) -> Path:
        return cura_print(part(folder), folder / "print.gcode", {**CURA_FEW, **settings})

    return Print(summary, make, missing_cura, stands=stands)


def handmade(summary: str, dialect: Dialect, *, stands: bytes = b"") -> Print:
    def make(folder: Path) -> Path:
        path = folder / "print.gcode"
        path.write_bytes(written(dialect))
        return path

    return Print(summary, make, stands=stands)


ORCA = Dialect(slicer="orca", labels="EXCLUDE_OBJECT", objects=2, fan_in_infill=True, acceleration="M204 S{}")
BAMBU = Dialect(slicer="bambu", labels="M624", objects=2, hop=0.4, odd=(b"M73 L3",))

CORPUS: dict[str, Print] = {
    "prusa": prusa("relative filament, wipe and z-hop", stands=b"M83"),
    "prusa-absolute": prusa("absolute filament", stands=b"M82", **ABSOLUTE),
    "prusa-no-wipe": prusa("retraction without a wipe", wipe=0),
    "prusa-no-hop": prusa("retraction without a z-hop", retract_lift=0),
    "prusa-bare": prusa("neither wipe nor z-hop, absolute filament", wipe=0, retract_lift=0, **ABSOLUTE),
    "prusa-two-objects": prusa("two objects side by side", two),
    "prusa-labels": prusa("two objects with labels", two, gcode_label_objects=1, stands=b"; printing object"),
    "prusa-by-object": prusa(
        "two objects, one after the other",
        two,
        complete_objects=1,
        extruder_clearance_radius=5,
        gcode_label_objects=1,
        infill_first=1,
    ),
    "prusa-ring": prusa("a part with a hole", ring),
    "prusa-heights": prusa("layers of two heights", in_ranges, stands=b";HEIGHT:0.1\n"),
    "prusa-combined": prusa("infill of two layers printed as one", infill_every_layers=2, stands=b";HEIGHT:0.4"),
    "prusa-vase": prusa(
        "a spiral vase", spiral_vase=1, perimeters=1, fill_density="0%", top_solid_layers=0, bottom_solid_layers=1
    ),
    "prusa-raft": prusa("a raft", raft_layers=2),
    "prusa-support": prusa("supports", overhang, support_material=1, stands=b";TYPE:Support material"),
    "prusa-ironing": prusa("ironing", ironing=1, stands=b";TYPE:Ironing"),
    "prusa-two-tools": prusa("infill of a second extruder", infill_extruder=2, stands=b"\nT1\n", **TWO),
    "prusa-purge": prusa(
        "a wipe tower, and filament purged into the infill",
        **{
            **TWO,
            "infill_extruder": 2,
            "single_extruder_multi_material": 1,
            "wipe_tower": 1,
            "wipe_tower_x": 150,
            "wipe_into_infill": 1,
            "wiping_volumes_matrix": "0,20,20,0",
        },
        stands=b"; PURGING FINISHED",
    ),
    "prusa-firmware": prusa("retraction by the firmware", use_firmware_retraction=1, wipe=0, stands=b"G10"),
    "prusa-klipper": prusa("for Klipper", gcode_flavor="klipper", machine_limits_usage="time_estimate_only"),
    "prusa-first-layer": prusa("infill from the first layer on", bottom_solid_layers=0, top_solid_layers=0),
    "prusa-slowed": prusa("layers slowed for cooling", slowdown_below_layer_time=20),
    "prusa-volumetric": prusa("speed bound by the volume of filament", max_volumetric_speed=3),
    "prusa-equalised": prusa("speed changed in small steps", max_volumetric_extrusion_rate_slope_positive=5),
    "prusa-volumetric-e": prusa("filament in mm³", use_volumetric_e=1, stands=b"; use_volumetric_e = 1"),
    "prusa-infill-first": prusa("infill before walls", infill_first=1),
    "prusa-comments": prusa("a comment behind each move", gcode_comments=1, stands=b"; infill"),
    "prusa-gyroid": prusa("gyroid", fill_pattern="gyroid"),
    "prusa-3d-honeycomb": prusa("3D honeycomb", fill_pattern="3dhoneycomb"),
    "prusa-hilbert": prusa("Hilbert curve", fill_pattern="hilbertcurve"),
    "prusa-grid": prusa("grid, each line anchored", fill_pattern="grid"),
    "prusa-loose-lines": prusa("lines that are not joined", fill_pattern="rectilinear", infill_anchor_max=0),
    "prusa-concentric": prusa("concentric", fill_pattern="concentric"),
    "prusa-empty": prusa("no infill", fill_density="0%"),
    "cura": cura("gyroid, absolute filament", stands=b"M82"),
    "cura-relative": cura("relative filament", relative_extrusion="true", stands=b"M83"),
    "cura-firmware": cura("retraction by the firmware", machine_firmware_retract="true", infill_pattern="lines"),
    "cura-combined": cura("infill of two layers printed as one", infill_sparse_thickness=0.4, infill_pattern="grid"),
    "cura-slowed": cura("layers slowed for cooling", infill_pattern="zigzag", cool_min_layer_time=15),
    "cura-ring": cura("a part with a hole, z-hop", ring, retraction_hop_enabled="true", retraction_hop=0.4),
    "orca": handmade("OrcaSlicer for Klipper: objects, fan in the infill", ORCA, stands=b"EXCLUDE_OBJECT_START"),
    "orca-limits": handmade(
        "accelerations the Klipper way, in the infill too",
        replace(
            ORCA,
            acceleration="SET_VELOCITY_LIMIT ACCEL={} ACCEL_TO_DECEL=500",
            odd=(b"SET_VELOCITY_LIMIT ACCEL=900", b"SET_PRESSURE_ADVANCE ADVANCE=0.03", b"G4 P0"),
        ),
    ),
    "orca-arcs": handmade("arcs in the infill", replace(ORCA, arcs=True), stands=b"\nG2 "),
    "orca-numbered": handmade("line numbers", replace(ORCA, numbered=True), stands=b"\nN7 "),
    "bambu": handmade("Bambu Studio: its tags, objects and layers", BAMBU, stands=b"; FEATURE: Sparse infill"),
    "bambu-arcs": handmade("arcs, CRLF, absolute filament", replace(BAMBU, arcs=True, crlf=True, absolute=True)),
    "crlf": handmade("lines that end with CR and LF, the last with nothing", Dialect(crlf=True, newline=False)),
    "latin-1": handmade(
        "names that are not UTF-8", Dialect(name=b"Br\xfccke \xff.stl", labels="comment", objects=2), stands=b"\xff"
    ),
    "odd": handmade(
        "what users and printers put between lines",
        Dialect(
            objects=2,
            odd=(b"", b";", b"M117 50%", b"  ; indented", b"M104 S211", b"M900 K0.04", b"; \x80\x81", b"@pause"),
        ),
    ),
    "packed": handmade("no blanks between words", Dialect(packed=True, absolute=True)),
    "sequential": handmade("by object, infill first", Dialect(objects=2, sequential=True, labels="M486")),
    "thick": handmade("combined infill by hand, absolute", Dialect(thick=2, absolute=True, zero=True, layers=8)),
    "variable": handmade("layers of three heights", Dialect(heights=(0.2, 0.12, 0.28), layers=8)),
    "tools": handmade("an object for each of two tools", Dialect(objects=2, tools=2, labels="M486")),
    "plain-tools": handmade("two tools, firmware retraction", Dialect(objects=2, tools=2, firmware=True)),
    "unretracted": handmade("travels in the infill without retraction", Dialect(retract=False, hop=0.0)),
    "cura-by-hand": handmade(
        "Cura with a new zero of filament in the middle of the infill",
        Dialect(slicer="cura", absolute=True, acceleration="", progress="", hop=0.0),
    ),
}


class Made(Mapping[str, Path]):
    """The corpus in a folder; a print is made when it is first asked for."""

    def __init__(self, folder: Path) -> None:
        self.folder = Path(folder)

    def __getitem__(self, name: str) -> Path:
        entry = CORPUS[name]
        folder = self.folder / name
        path = folder / "print.gcode"
        if not path.exists():
            folder.mkdir(parents=True)
            path = entry.make(folder)
            assert entry.stands in path.read_bytes(), f"{name} is not what it should be: no {entry.stands!r} in it"
        return path

    def __iter__(self) -> Iterator[str]:
        return iter(CORPUS)

    def __len__(self) -> int:
        return len(CORPUS)


def corpus(folder: Path) -> Made:
    """Return the prints of the corpus by name, made in a folder as they are asked for."""
    return Made(folder)


ODD = (
    b"",
    b";",
    b"; FEATURE",
    b";TYPE",
    b";;TYPE:Internal infill",
    b" ;TYPE:Perimeter is not a tag",
    b"M117 ;TYPE:Solid infill",
    b"M106 S80",
    b"M107",
    b"M104 S205",
    b"M204 P900",
    b"M205 X7 Y7",
    b"M900 K0.05",
    b"M73 P50",
    b"M73 P51 R3 Q50 S4",
    b"G4 P1",
    b"; \xff\xfe \x80",
    b"M117 \xc3\xa4 G1 X0 Y0 E5",
    b"SET_VELOCITY_LIMIT ACCEL=1200 SQUARE_CORNER_VELOCITY=4",
    b"M400",
    b"@comment",
)


def prints() -> st.SearchStrategy[bytes]:
    """Small valid prints of any dialect, with odd lines in odd places."""
    labels = {"prusa": ["", "comment", "M486"], "orca": ["", "EXCLUDE_OBJECT"], "bambu": ["", "M624"], "cura": [""]}

    @st.composite
    def one(draw: st.DrawFn) -> bytes:
        slicer = draw(st.sampled_from(["prusa", "orca", "bambu", "cura"]))
        yes, seldom = st.booleans(), st.sampled_from([False, False, False, True])
        objects = draw(st.integers(1, 2))
        return written(
            Dialect(
                slicer=slicer,
                absolute=draw(yes),
                wipe=draw(yes),
                hop=draw(st.sampled_from([0.0, 0.2, 0.4])),
                retract=draw(yes),
                firmware=draw(yes),
                crlf=draw(yes),
                labels=draw(st.sampled_from(labels[slicer])),
                progress=draw(st.sampled_from(["", "P{done} R{left}", "P{done}"])),
                fan_in_infill=draw(yes),
                arcs=draw(seldom),
                acceleration=draw(st.sampled_from(["", "M204 S{}", "SET_VELOCITY_LIMIT ACCEL={}"])),
                zero=draw(yes),
                comments=draw(yes),
                sequential=draw(yes),
                objects=objects,
                tools=draw(st.integers(1, objects)),
                layers=draw(st.integers(4, 6)),
                thick=draw(st.sampled_from([1, 1, 2])),
                heights=draw(st.sampled_from([(), (0.2, 0.1)])),
                odd=tuple(draw(st.lists(st.sampled_from(ODD), max_size=3))),
                newline=draw(yes),
                packed=draw(seldom),
                size=draw(st.sampled_from([8.0, 12.0, 16.0])),
                cell=draw(st.sampled_from([1.6, 3.0, 5.0])),
                infill_first=draw(yes),
            )
        )

    return one()
