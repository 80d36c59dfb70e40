"""Settings of volumes in slicers' projects: infill density, infill pattern and walls, and what they are called here.

PrusaSlicer, SuperSlicer     fill_density, fill_pattern, perimeters
Bambu Studio, OrcaSlicer     sparse_infill_density, sparse_infill_pattern, wall_loops
Cura                         infill_sparse_density, infill_pattern
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from dataclasses import dataclass

from infill.files.excerpts import excerpt
from infill.plain_numbers import plain_argument

DENSITIES = ("fill_density", "sparse_infill_density", "infill_sparse_density")  # of PrusaSlicer, Bambu Studio and Cura
PATTERNS = ("fill_pattern", "sparse_infill_pattern", "infill_pattern")
WALLS = ("perimeters", "wall_loops")
OUTER_WIDTHS = ("external_perimeter_extrusion_width", "outer_wall_line_width", "extrusion_width", "line_width")
INNER_WIDTHS = ("perimeter_extrusion_width", "inner_wall_line_width", "extrusion_width", "line_width")
LINE_WIDTH = 0.45  # mm: of a usual nozzle, where a project states none, or a share
PERCENT = re.compile(r"\s*(\d{1,3}(?:\.\d+)?)\s*%?\s*")
LENGTH = re.compile(r"\s*(\d{1,2}(?:\.\d+)?)\s*")
LOOPS = re.compile(r"\s*(\d{1,3})\s*")
# The patterns of slicers that have another name here; without dashes and underscores, small.
SLICER_PATTERNS = {
    "lines": "rectilinear",
    "line": "rectilinear",
    "zigzag": "rectilinear",
    "alignedrectilinear": "rectilinear",
    "monotonic": "rectilinear",
    "monotoniclines": "rectilinear",
    "monotonicline": "rectilinear",
    "stars": "tri-hexagon",
    "trihexagon": "tri-hexagon",
    "octagon": "octagons",
    "adaptivecubic": "adaptive-cubic",
    "cubicsubdiv": "adaptive-cubic",
    "supportcubic": "support-cubic",
    "quartercubic": "quarter-cubic",
    "3dhoneycomb": "honeycomb-3d",
    "2dhoneycomb": "lateral-honeycomb",
    "lateralhoneycomb": "lateral-honeycomb",
    "2dlattice": "lateral-lattice",
    "laterallattice": "lateral-lattice",
    "crosshatch": "cross-hatch",
    "cross3d": "cross-3d",
    "hilbertcurve": "hilbert",
    "archimedeanchords": "archimedean-chords",
    "octagramspiral": "octagram-spiral",
    "tpmsd": "schwarz-d",
    "tpmsfk": "fischer-koch-s",
    **{
        name: name
        for name in (
            "rectilinear",
            "grid",
            "triangles",
            "cubic",
            "tetrahedral",
            "concentric",
            "honeycomb",
            "gyroid",
            "lightning",
            "cross",
        )
    },
}


@dataclass(frozen=True, kw_only=True)
class VolumeSettings:
    """Settings of a volume of its own.

    Parameters
    ----------
    density : float or None
        The share that the slicer fills, 0 to 1.
    pattern : str or None
        The slicer's name of the pattern.
    wall : float or None
        Thickness of the slicer's perimeters, mm.
    """

    density: float | None = None
    pattern: str | None = None
    wall: float | None = None

    @property
    def is_any(self) -> bool:
        """True if there is a setting."""
        return not (self.density is None and self.pattern is None and self.wall is None)

    @property
    def text(self) -> str:
        """The settings as a note has them."""
        words = [] if self.density is None else [f"{plain_argument(100 * self.density)} % infill"]
        words += [] if self.pattern is None else [f"infill pattern {self.pattern}"]
        words += [] if self.wall is None else [f"walls of {plain_argument(self.wall)} mm"]
        return " and ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def find_pattern(name: str) -> str | None:
    """Return the name that a slicer's pattern has here; None for a pattern without an equivalent.

    >>> find_pattern("3dhoneycomb"), find_pattern("quarter_cubic"), find_pattern("crosszag")
    ('honeycomb-3d', 'quarter-cubic', None)
    """
    return SLICER_PATTERNS.get(re.sub(r"[-_ ]", "", name).lower())


def read_settings(settings: Mapping[str, str], project: Mapping[str, str] | None = None) -> VolumeSettings:
    """Read the settings of a volume by key; those that cannot be read are left out.

    Parameters
    ----------
    settings : mapping
        Of the volume.
    project : mapping, optional
        Of the whole project: the widths of lines, where the volume has none.

    >>> read_settings({"fill_density": "60%", "fill_pattern": "stars"})
    VolumeSettings(density=0.6, pattern='stars', wall=None)
    >>> read_settings({"perimeters": "3"}, {"external_perimeter_extrusion_width": "0.5"}).wall
    1.4
    """
    percent = next((match for key in DENSITIES if (match := PERCENT.fullmatch(settings.get(key, "")))), None)
    density = None if percent is None or float(percent[1]) > 100 else float(percent[1]) / 100
    pattern = next((excerpt(settings[key].strip()) for key in PATTERNS if settings.get(key, "").strip()), None)
    loops = next((match for key in WALLS if (match := LOOPS.fullmatch(settings.get(key, "")))), None)
    wall = None
    if loops is not None:
        widths = {**(project or {}), **settings}
        outer, inner = (_line_width(widths, keys) for keys in (OUTER_WIDTHS, INNER_WIDTHS))
        count = int(loops[1])
        wall = round(outer + (count - 1) * inner, 6) if count else 0.0
    return VolumeSettings(density=density, pattern=pattern, wall=wall)


def _line_width(settings: Mapping[str, str], keys: tuple[str, ...]) -> float:
    """Return the first width of lines among settings, mm, or the usual one; shares of other lengths do not count."""
    widths = (float(match[1]) for key in keys if (match := LENGTH.fullmatch(settings.get(key, ""))))
    return next((width for width in widths if width > 0), LINE_WIDTH)


def parse_project_settings(text: str) -> dict[str, str]:
    """Read the settings of a whole project: JSON of Bambu Studio and OrcaSlicer, or lines of PrusaSlicer.

    >>> parse_project_settings('{"line_width": ["0.42"], "wall_loops": "3"}')
    {'line_width': '0.42', 'wall_loops': '3'}
    >>> parse_project_settings("; extrusion_width = 0.45")
    {'extrusion_width': '0.45'}
    """
    if text.lstrip().startswith("{"):
        try:
            table = json.loads(text)
        except (ValueError, RecursionError):
            return {}
        firsts = {key: value[0] if isinstance(value, list) and value else value for key, value in table.items()}
        return {key: value for key, value in firsts.items() if isinstance(value, str)}
    rows = (line.lstrip("; ").split("=", 1) for line in text.splitlines() if "=" in line)
    return {key.strip(): value.strip() for key, value in rows}
