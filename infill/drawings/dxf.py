"""Read DXF by ezdxf (extra `drawings`): lines, arcs, ellipses, splines, polylines with bulges, and blocks, in mm.

Layers that are off or frozen are left out, and so are other entities than lines: texts, dimensions, solids.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from infill.drawing import (
    CHORD_TOLERANCE,
    MOST_POINTS,
    Drawing,
    Line,
    build_drawing,
    count_points,
    require_at_most,
)
from infill.errors import FormatError
from infill.files.broken import error_text, wrap_reader_errors
from infill.plain_numbers import plain_argument

SAVE_ADVICE = "save it again as DXF (R2000 or later, text)"
LARGEST_FILE = 10_000_000  # bytes: reading takes a second per million
MOST_ENTITIES = 50_000
MOST_FIT_POINTS = 1000  # of a spline: time and memory for its controls grow with their square
HIGHEST_DEGREE = 20  # of a spline
DEEPEST = 50  # blocks in blocks
CURVE_TYPES = ("LINE", "ARC", "CIRCLE", "ELLIPSE", "LWPOLYLINE", "POLYLINE", "SPLINE", "HELIX")
TEXT_TYPES = ("TEXT", "MTEXT", "ATTRIB", "ATTDEF")


def _import_ezdxf() -> ModuleType:
    """Import ezdxf, or raise FormatError if it is not installed."""
    try:
        import ezdxf
    except ImportError as error:
        raise FormatError("reading .dxf needs the extra drawings: pip install ezdxf") from error
    module: ModuleType = ezdxf
    return module


def read_dxf(path: Path) -> Drawing:
    """Read the lines in the model space of a DXF file; a file without a unit is in mm."""
    require_at_most(LARGEST_FILE, path.stat().st_size, "bytes")
    ezdxf = _import_ezdxf()
    left_out: Counter[str] = Counter()
    try:
        with wrap_reader_errors(path, advice=SAVE_ADVICE), np.errstate(all="ignore"):
            document = ezdxf.readfile(path)
            lines = _read_lines(document, left_out)
            unit = _unit_length(path, document.header.get("$INSUNITS", 0))
    except (ezdxf.DXFError, OSError, StopIteration) as error:
        raise FormatError(f"{path} is broken or not a .dxf file ({error_text(error)}); {SAVE_ADVICE}") from error
    return build_drawing(path, [line * unit for line in lines], left_out=+left_out)


def _unit_length(path: Path, unit: int) -> float:
    """Return the length of a DXF unit, mm; 0 means no unit, which is read as mm."""
    from ezdxf import enums, units

    try:
        return float(units.conversion_factor(enums.InsertUnits(unit), enums.InsertUnits.Millimeters)) if unit else 1.0
    except (ValueError, TypeError) as error:
        raise FormatError(
            f"{path} states the unit {unit!r} ($INSUNITS), which DXF does not define; set the drawing's units to "
            "millimetres (4) and save it again"
        ) from error


def _read_lines(document: Any, left_out: Counter[str]) -> list[Line]:  # noqa: ANN401 - a document of ezdxf
    """Return the lines of a document in its unit, and count the omitted entities."""
    from ezdxf import disassemble, path

    hidden = {layer.dxf.name for layer in document.layers if layer.is_off() or layer.is_frozen()}
    _require_few_entities(document)
    paths, corners, points = [], [], 0
    entities: Iterable[Any] = disassemble.recursive_decompose(document.modelspace())
    for entity in entities:
        kind = entity.dxftype()
        if entity.dxf.get("layer", "0") in hidden or entity.dxf.get("invisible", 0):
            left_out["hidden line"] += 1
            continue
        if kind in CURVE_TYPES:
            _require_short(_splines(entity))
            new_paths = [path.make_path(entity)]
            left_out["empty line"] += not len(new_paths[0])
        elif kind == "HATCH":
            _require_short(_splines(entity))
            new_paths = list(path.from_hatch(entity))
        else:
            left_out["text" if kind in TEXT_TYPES else kind.lower()] += 1
            continue
        for curve in new_paths:
            if len(curve):
                paths.append(curve)
                corners.append(np.array([(v.x, v.y) for v in curve.control_vertices()]))
                points += len(corners[-1])
        require_at_most(MOST_POINTS, points, "points or more")
    if not corners:
        return []
    size = float(np.ptp(np.concatenate(corners), axis=0).max())
    if not (math.isfinite(size) and size > 0):
        raise ValueError(f"its lines extend over {plain_argument(size)}")
    parts = (part for curve in paths for part in (curve.sub_paths() if curve.has_sub_paths else [curve]) if len(part))
    flat = (np.array([(v.x, v.y) for v in part.flattening(CHORD_TOLERANCE * size / 2)]) for part in parts)
    return list(count_points(flat))


def _splines(entity: Any) -> Iterator[Any]:  # noqa: ANN401 - an entity of ezdxf
    """Yield the splines of an entity: the entity itself, or the boundaries of a hatch."""
    if entity.dxftype() in ("SPLINE", "HELIX"):
        yield entity
    elif entity.dxftype() == "HATCH":
        for boundary in entity.paths:
            yield from (edge for edge in getattr(boundary, "edges", ()) if hasattr(edge, "fit_points"))


def _require_short(splines: Iterable[Any]) -> None:
    """Raise TooComplexError for a spline that would take minutes or gigabytes."""
    for spline in splines:
        require_at_most(MOST_FIT_POINTS, len(spline.fit_points), "points that a spline goes through")
        degree = spline.dxf.degree if hasattr(spline, "dxf") else spline.degree
        require_at_most(HIGHEST_DEGREE, degree, "as the degree of a spline")


def _require_few_entities(document: Any) -> None:  # noqa: ANN401 - a document of ezdxf
    """Raise TooComplexError if the model space has too many entities, with every copy of a block counted.

    The weight of each block is computed once, from the blocks in it, so that nested blocks are never expanded.
    """
    weights: dict[str, float] = {}

    def weight(layout: Any, inside: frozenset[str]) -> float:  # noqa: ANN401 - a layout of ezdxf
        """Count the entities of a layout with those of the blocks that it inserts."""
        total = 0.0
        for entity in layout:
            total += 1 + (len(entity.paths) if entity.dxftype() == "HATCH" else 0)
            if entity.dxftype() == "INSERT":
                total += entity.mcount * of_block(str(entity.dxf.get("name", "")), inside)
        return total

    def of_block(name: str, inside: frozenset[str]) -> float:
        """Count the entities of a block, once; raise ValueError for a block in itself."""
        if name in inside:
            raise ValueError(f"its block {name[:40]!r} contains itself")
        require_at_most(DEEPEST, len(inside), "blocks in one another")
        if name not in weights:
            block = document.blocks.get(name)
            weights[name] = 1.0 if block is None else 1 + weight(block, inside | {name})
        return weights[name]

    total = weight(document.modelspace(), frozenset())
    require_at_most(MOST_ENTITIES, total, "entities, repeated blocks counted")
