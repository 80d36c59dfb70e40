"""Write docs/report.md, the tables of all reports, from their declarations: `python tools/write_report_page.py`.

A chapter has a table of the keys of a report, and one for each of its sections. Keys inside a section are joined by
dots, `[]` stands for each item of a list, and `NAME` for each key of a dict. Sections that a chapter has twice have one
table.
"""

from __future__ import annotations

import re
import sys
import textwrap
import types
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Annotated, Any, NotRequired, Union, get_args, get_origin, get_type_hints, is_typeddict

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "report.md"
sys.path.insert(0, str(ROOT))

from infill.reports import checking, common, filling, making, profiles, refilling, smoothing, timing, verifying  # noqa: E402

HEAD = """# The report

Every product answers with a report: `result.report` in Python, and the JSON that `--json` prints at the command line. A
report is a plain dict of numbers, strings, lists and dicts, so that scripts can write `result.report["density"]` and
`json.dumps(result.report)`. Lengths are in millimetres, areas in mm², volumes in mm³, angles in degrees and times in
seconds.

A key that may be `missing` is not in every report; `null` stands for a value that does not exist. `form` is the version
of the form of the reports: it increases when a key is renamed or changes its type or meaning. New keys leave it
unchanged.

[`infill.reports`](../infill/reports) declares each key with its type and its meaning, so that editors and type checkers
know all of them: `from infill.reports.making import MakeReport`. This page is written from there, by `python
tools/write_report_page.py`.
"""


@dataclass(frozen=True, kw_only=True)
class Chapter:
    """A chapter of the page.

    Parameters
    ----------
    title : str
        Heading of the chapter.
    word : str
        First word in the headings of its sections.
    text : str
        What a reader should know before the tables.
    report : type
        The TypedDict that declares the report.
    known : tuple of type
        Sections that another chapter describes.
    """

    title: str
    word: str
    text: str
    report: Any
    known: tuple[Any, ...] = ()


CHAPTERS = (
    Chapter(
        title="Make: a block of infill",
        word="make",
        text="`make` returns this report, and `infill make` prints it. Scripts find the most important numbers at its "
        "top; the sections hold them again, with all others.",
        report=making.MakeReport,
    ),
    Chapter(
        title="Make: a dry run",
        word="make --dry-run",
        text="`infill make … --dry-run` prints the request, the grid, and the expected costs. `request` and `grid` "
        "have the keys of [the full report](#make-a-block-of-infill).",
        report=making.MakePlan,
        known=(making.BlockRequest, common.GridKeys),
    ),
    Chapter(
        title="Make: a block with a density, or of a pattern in space",
        word="make --density",
        text="Such a block is filled as a part is. `make` returns this report, and `infill make` prints it. `seconds` "
        "has the keys of [a filled part](#fill-a-part-with-its-infill).",
        report=making.LatticeReport,
        known=(common.GridKeys, filling.FillSeconds),
    ),
    Chapter(
        title="Make: a dry run of such a block",
        word="make --density --dry-run",
        text="`request` and `grid` have the keys of [the full report]"
        "(#make-a-block-with-a-density-or-of-a-pattern-in-space).",
        report=making.LatticePlan,
        known=(making.LatticeRequest, common.GridKeys, filling.PlannedSizes),
    ),
    Chapter(
        title="Smooth: a volume, a mesh or points",
        word="smooth",
        text="`smooth_volume`, `smooth_mesh` and `smooth_points` return this report, and `infill smooth` prints it. "
        "Meanings that begin with Volumes, Meshes or Points are for that kind of input.\n\n"
        "Every result is compared with its input: `verdict` reports all places that lie more than 1.25 cells apart. "
        "The exact numbers in `distance` take longer. They are measured when this section or the entire report is "
        "first read, as for `--json` and `-v`.",
        report=smoothing.SmoothReport,
    ),
    Chapter(
        title="Smooth: a dry run",
        word="smooth --dry-run",
        text="`infill smooth … --dry-run` prints the request, the grid, and the expected costs. `request` and `grid` "
        "have the keys of [the full report](#smooth-a-volume-a-mesh-or-points).",
        report=smoothing.SmoothForecast,
        known=(smoothing.SolidRequest, common.GridKeys),
    ),
    Chapter(
        title="Smooth: a volume in chunks",
        word="chunks",
        text="`infill smooth` prints this report of a [volume larger than the memory](scale.md), and `smooth_volume` "
        "returns it for a Dask array. `request`, `grid`, `input.segmentation`, `solid`, `topology` and `crumbs` have "
        "the keys of [the report of one solid](#smooth-a-volume-a-mesh-or-points).",
        report=smoothing.ChunksReport,
        known=(
            smoothing.SolidRequest,
            smoothing.SegmentationKeys,
            smoothing.CrumbKeys,
            common.GridKeys,
            common.Solid,
            common.Topology,
        ),
    ),
    Chapter(
        title="Smooth: a dry run of a volume in chunks",
        word="chunks --dry-run",
        text="`infill smooth … --dry-run` smooths some of the chunks, and prints the expected costs of all.",
        report=smoothing.ChunksForecast,
        known=(smoothing.SolidRequest, common.GridKeys),
    ),
    Chapter(
        title="Labels: every label of a segmentation",
        word="labels",
        text="`smooth_labels` returns this report, and `infill smooth` prints it with `{label}` in the name of an "
        "output or with `--each-label`. `request` has the keys of [the report of one "
        "solid](#smooth-a-volume-a-mesh-or-points), and so has each `labels[].report`; that of a label in chunks has "
        "those of [a volume in chunks](#smooth-a-volume-in-chunks).",
        report=smoothing.LabelsReport,
        known=(smoothing.SolidRequest, smoothing.SmoothReport),
    ),
    Chapter(
        title="Labels together: walls that neighbours share",
        word="together",
        text="`smooth_labels` with `together` returns this report, and `infill smooth --together` prints it. "
        "`request`, `labels[].topology`, `labels[].distance` and the places of `labels[].verdict` have the keys of "
        "[the report of one solid](#smooth-a-volume-a-mesh-or-points).",
        report=smoothing.TogetherReport,
        known=(smoothing.SolidRequest, smoothing.Topology, smoothing.Distance, smoothing.Place),
    ),
    Chapter(
        title="Labels together in chunks",
        word="together in chunks",
        text="`infill smooth --together` prints this report with `--workers` or `--scheduler`. `request` has the keys "
        "of [the report of one solid](#smooth-a-volume-a-mesh-or-points).",
        report=smoothing.PartedReport,
        known=(smoothing.SolidRequest,),
    ),
    Chapter(
        title="Labels: a dry run",
        word="labels --dry-run",
        text="`infill smooth … --dry-run` over labels prints the request, the labels, and the expected costs.",
        report=smoothing.LabelsForecast,
        known=(smoothing.SolidRequest,),
    ),
    Chapter(
        title="Components: every component of a mesh",
        word="components",
        text="`smooth_mesh` with `by_component` returns this report, and `infill smooth --by-component` prints it. "
        "`request` has the keys of [the report of one solid](#smooth-a-volume-a-mesh-or-points), and so has each "
        "`components[].report`.",
        report=smoothing.ComponentsReport,
        known=(smoothing.SolidRequest, smoothing.SmoothReport),
    ),
    Chapter(
        title="Fill: a part with its infill",
        word="fill",
        text="`fill` returns this report, and `infill fill` prints it. Inside the walls means inside a layer as thick "
        "as the wall, which lies along all of the skin except its open sides.",
        report=filling.FillReport,
    ),
    Chapter(
        title="Fill: a dry run",
        word="fill --dry-run",
        text="`infill fill … --dry-run` prints the request, the grid, and the expected costs. `request` and `grid` "
        "have the keys of [the full report](#fill-a-part-with-its-infill).",
        report=filling.FillForecast,
        known=(filling.FillRequest, common.GridKeys),
    ),
    Chapter(
        title="Refill: a sliced print",
        word="refill",
        text="`refill` returns this report, and `infill refill` prints it. Infill means sparse infill. A print that "
        "was refilled before has only the keys that are never missing.",
        report=refilling.RefillReport,
    ),
    Chapter(
        title="Motion: the time of a print",
        word="motion",
        text="`motion(…).to_dict()` returns this report, and `infill motion` prints it; for two files, it prints an "
        "object with a list of both, `files`.",
        report=timing.MotionReport,
    ),
    Chapter(
        title="Verify: a post-processed print",
        word="verify",
        text="`verify(…).report` is this report, and `infill verify --json` prints it.",
        report=verifying.VerifyReport,
    ),
    Chapter(
        title="Check: a mesh",
        word="check",
        text="`check(…).to_dict()` returns this report, and `infill check` prints it; for several files, it prints a "
        "list. A file that cannot be read then has two keys: `file`, and `error` with the reason. Lengths are in the "
        "unit of the file, or in millimetres if it states its unit.",
        report=checking.CheckReport,
    ),
    Chapter(
        title="Check: a print",
        word="check PRINT",
        text="`infill check` prints this report of a sliced print, alone or in the list of several files.",
        report=checking.PrintCheckReport,
    ),
    Chapter(
        title="Check: a project",
        word="check --for",
        text="`infill check --for SLICER` prints this report; for several projects, it prints a list. A project that "
        "cannot be read then has two keys: `file`, and `error` with the reason.",
        report=checking.ProjectReport,
    ),
    Chapter(
        title="List: the patterns",
        word="list",
        text="`infill list` prints this report; for one pattern, with that pattern alone.",
        report=checking.PatternList,
    ),
    Chapter(
        title="Setup: the profiles of a slicer",
        word="setup",
        text="`infill setup SLICER --json` prints this report.",
        report=profiles.SetupReport,
    ),
)


@dataclass(frozen=True, kw_only=True)
class Key:
    """A key of a report, as it is declared.

    Parameters
    ----------
    kind : type
        Its type, without annotations.
    meaning : str
        Empty if neither the key nor the type of its section has one.
    length : int or None
        Length of its list, if that is declared.
    required : bool
        Whether every report has it.
    """

    kind: Any
    meaning: str
    length: int | None
    required: bool

    @property
    def section(self) -> tuple[str, Any] | None:
        """What joins the keys of its section to its own name, and their TypedDict; None for a value."""
        for kind in get_args(self.kind) if is_union(self.kind) else (self.kind,):
            if is_typeddict(kind):
                return "", kind
            inner = [each for each in get_args(kind) if is_typeddict(each)]
            if inner:
                return ".NAME" if get_origin(kind) is dict else "[]", inner[0]
        return None


def is_union(kind: Any) -> bool:  # noqa: ANN401 - a type
    """Tell whether a type is a union of types."""
    return get_origin(kind) in (Union, types.UnionType)


def read_key(hint: Any) -> Key:  # noqa: ANN401 - a type
    """Read the declaration of a key."""
    required, notes = True, ()
    while get_origin(hint) in (NotRequired, Annotated):
        required &= get_origin(hint) is Annotated
        hint, *more = get_args(hint)
        notes += tuple(more)
    lengths, texts = ([note for note in notes if isinstance(note, kind)] for kind in (int, str))
    key = Key(kind=hint, meaning="".join(texts[-1:]), length=lengths[0] if lengths else None, required=required)
    if key.meaning or key.section is None:
        return key
    first_line = (key.section[1].__doc__ or "").split("\n\n")[0]
    return Key(kind=hint, meaning=" ".join(first_line.split()).rstrip("."), length=key.length, required=required)


@cache
def read_keys(declaration: Any) -> dict[str, Key]:  # noqa: ANN401 - a TypedDict
    """Read the declarations of all keys of a section or a report, by name."""
    return {name: read_key(hint) for name, hint in get_type_hints(declaration, include_extras=True).items()}


def spell_type(kind: Any, length: int | None = None) -> str:  # noqa: ANN401 - a type
    """Spell a type as the page does.

    >>> spell_type(float | None), spell_type(list[Annotated[list[float], 3]], 2), spell_type(dict[str, int])
    ('float or null', 'list of 2 lists of 3 float', 'object')
    """
    if get_origin(kind) is Annotated:
        key = read_key(kind)
        return spell_type(key.kind, key.length)
    if is_union(kind):
        return " or ".join(map(spell_type, get_args(kind)))
    if get_origin(kind) in (list, tuple):
        number = "" if length is None else f"{length} "
        inner = re.sub(r"^(list|object)\b", r"\1s", spell_type(get_args(kind)[0]))
        return f"list of {number}{inner}"
    if is_typeddict(kind) or get_origin(kind) is dict:
        return "object"
    return "any" if kind is Any else "null" if kind is type(None) else kind.__name__


def write_table(keys: dict[str, Key]) -> str:
    """Write the table of some keys."""
    rows = ["| key | type | meaning |", "|---|---|---|"]
    for name, key in keys.items():
        spelt = spell_type(key.kind, key.length) + ("" if key.required else " or missing")
        rows.append(f"| `{name}` | {spelt} | {key.meaning} |")
    return "\n".join(rows)


def nested_keys(name: str, key: Key, seen: dict[Any, str]) -> Iterator[tuple[str, Key]]:
    """Yield the keys inside a section, down to values; a section that was `seen` under another name is not repeated."""
    if key.section is None:
        return
    joint, declaration = key.section
    if declaration in seen:
        return
    seen[declaration] = f"{name}{joint}"
    for inner_name, inner in read_keys(declaration).items():
        place = f"{name}{joint}.{inner_name}"
        again = inner.section is not None and seen.get(inner.section[1])
        meaning = f"{inner.meaning}; keys as in `{again}`" if again else inner.meaning
        yield place, Key(kind=inner.kind, meaning=meaning, length=inner.length, required=inner.required)
        yield from nested_keys(place, inner, seen)


def write_chapter(chapter: Chapter) -> str:
    """Write a chapter."""
    keys = read_keys(chapter.report)
    paragraphs = (textwrap.fill(text, 120, break_on_hyphens=False) for text in chapter.text.split("\n\n"))
    parts = [f"## {chapter.title}", *paragraphs, write_table(keys)]
    seen = dict.fromkeys(chapter.known, "")
    for name, key in keys.items():
        if inner := dict(nested_keys(name, key, seen)):
            parts += [f"### {chapter.word}: {name}", write_table(inner)]
    return "\n\n".join(parts)


def write_anchor(title: str) -> str:
    """Write the anchor of a heading as a forge does.

    >>> write_anchor("Check: a mesh")
    'check-a-mesh'
    """
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def write_page() -> str:
    """Write the page."""
    contents = (f"* [{chapter.title}](#{write_anchor(chapter.title)})" for chapter in CHAPTERS)
    return "\n\n".join([HEAD.rstrip(), "\n".join(contents), *map(write_chapter, CHAPTERS)]) + "\n"


if __name__ == "__main__":
    PAGE.write_text(write_page(), encoding="utf-8")
    print(PAGE)
