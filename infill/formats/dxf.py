"""DXF by ezdxf (extra `drawings`): lines, arcs, ellipses, splines, polylines with bulges, and blocks, in mm.

What is on layers that are off or frozen is left out, and so is what is not a line: texts, dimensions, solids.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from infill.errors import FormatError
from infill.formats.broken import one_line, told_broken
from infill.formats.drawing import FLATNESS, Drawing, Line, checked_drawing

AGAIN = "save it again as DXF (R2000 or later, text)"
LARGEST_FILE = 100_000_000  # bytes
MOST_ENTITIES = 50_000
DRAWN = ("LINE", "ARC", "CIRCLE", "ELLIPSE", "LWPOLYLINE", "POLYLINE", "SPLINE", "HELIX")
TEXTS = ("TEXT", "MTEXT", "ATTRIB", "ATTDEF")


def _ezdxf() -> ModuleType:
    try:
        import ezdxf
    except ImportError as error:
        raise FormatError("reading .dxf needs the extra drawings: pip install 'phasefill[drawings]'") from error
    module: ModuleType = ezdxf
    return module


def read_dxf(path: Path) -> Drawing:
    """Return the lines in the model space of a DXF file; a file that states no unit is in mm."""
    if path.stat().st_size > LARGEST_FILE:
        raise FormatError(f"{path} has {path.stat().st_size} bytes; the limit is {LARGEST_FILE}; simplify the drawing")
    ezdxf = _ezdxf()
    left_out: Counter[str] = Counter()
    try:
        with told_broken(path, advice=AGAIN), np.errstate(all="ignore"):
            document = ezdxf.readfile(path)
            lines = _lines(document, left_out)
            unit = _millimetres(document.header.get("$INSUNITS", 0))
    except (ezdxf.DXFError, OSError, StopIteration) as error:
        raise FormatError(f"{path} is broken or not a .dxf file ({one_line(error)}); {AGAIN}") from error
    return checked_drawing(path, [line * unit for line in lines], left_out=+left_out)


def _millimetres(unit: int) -> float:
    from ezdxf import enums, units

    return float(units.conversion_factor(enums.InsertUnits(unit), enums.InsertUnits.Millimeters)) if unit else 1.0


def _lines(document: Any, left_out: Counter[str]) -> list[Line]:  # noqa: ANN401 - a document of ezdxf
    from ezdxf import disassemble, path

    hidden = {layer.dxf.name for layer in document.layers if layer.is_off() or layer.is_frozen()}
    paths = []
    if any(each.dxftype() == "INSERT" and each.mcount > MOST_ENTITIES for each in document.entitydb.values()):
        raise ValueError(f"it repeats a block more than {MOST_ENTITIES} times")
    entities: Iterable[Any] = disassemble.recursive_decompose(document.modelspace())
    for number, entity in enumerate(entities):
        if number >= MOST_ENTITIES:
            raise ValueError(f"it holds more than {MOST_ENTITIES} entities")
        kind = entity.dxftype()
        if entity.dxf.get("layer", "0") in hidden or entity.dxf.get("invisible", 0):
            left_out["hidden line"] += 1
        elif kind in DRAWN:
            paths.append(path.make_path(entity))
            left_out["empty line"] += not len(paths[-1])
        elif kind == "HATCH":
            paths += path.from_hatch(entity)
        else:
            left_out["text" if kind in TEXTS else kind.lower()] += 1
    corners = [np.array([(v.x, v.y) for v in each.control_vertices()]) for each in paths if len(each)]
    if not corners:
        return []
    size = float(np.ptp(np.concatenate(corners), axis=0).max())
    if not (math.isfinite(size) and size > 0):
        raise ValueError(f"its lines extend over {size:g}")
    parts = [part for each in paths for part in (each.sub_paths() if each.has_sub_paths else [each]) if len(part)]
    return [np.array([(v.x, v.y) for v in part.flattening(FLATNESS * size / 2)]) for part in parts]
