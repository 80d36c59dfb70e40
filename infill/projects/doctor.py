"""Predictions of how a slicer reads a 3MF: the printed volumes, their settings, and silent losses."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import cast

from infill.checks import choose_word
from infill.errors import FormatError, UsageError
from infill.formats.mesh_files import READERS as MESH_READERS
from infill.plain_numbers import count_noun
from infill.projects import bambustudio, cura, prusaslicer
from infill.projects.findings import Finding, PrintedVolume, Severity, as_problem, as_warning
from infill.projects.project import NAMES, SLICERS, Slicer
from infill.projects.reading import RELATIONS, Package, read_package
from infill.projects.rules_bambustudio import volumes_for_bambustudio
from infill.projects.rules_cura import volumes_for_cura
from infill.projects.rules_prusaslicer import volumes_for_prusaslicer
from infill.reports.checking import ProjectReport
from infill.reports.common import declare

MOST_ON_COMMAND_LINE = 1_000_000  # triangles that OrcaSlicer takes from a command line


@dataclass(frozen=True, kw_only=True)
class Diagnosis:
    """Result of `check_project`.

    The attributes are the keys of `infill.reports.checking.ProjectReport`, which docs/report.md explains.
    """

    slicer: str
    fine: bool
    problems: tuple[str, ...]
    warnings: tuple[str, ...]
    application: str
    unit: str
    volumes: tuple[PrintedVolume, ...] = field(default_factory=tuple)

    def to_dict(self) -> ProjectReport:
        """Convert the diagnosis to plain values, as ``--json`` prints it."""
        return declare(ProjectReport, asdict(self))


def check_project(path: str | os.PathLike[str], slicer: Slicer) -> Diagnosis:
    """Diagnose a 3MF for a slicer: the volumes that it prints, problems, and warnings.

    Parameters
    ----------
    path : str or Path
    slicer : {"prusaslicer", "orcaslicer", "bambustudio", "cura", "plain"}

    Returns
    -------
    Diagnosis

    Raises
    ------
    FormatError
        If the file is missing or not a 3MF.
    UsageError
        For an unknown slicer.

    Notes
    -----
    The rules are those that the readers of the slicers follow; their own exit status is 0 in most of these cases.
    """
    slicer = cast("Slicer", choose_word(slicer, SLICERS))
    if slicer not in SLICERS:
        raise UsageError.about("slicer", f"is {slicer!r}; choose from {', '.join(SLICERS)}")
    if Path(path).suffix.lower() in set(MESH_READERS) - {".3mf"}:
        raise FormatError(
            f"{path} is a mesh, and only a .3mf has settings of a slicer; leave --for out to check the mesh, or give a "
            ".3mf"
        )
    package = read_package(Path(path))
    findings: list[Finding] = []
    volumes: list[PrintedVolume] = []
    for result in _examine(package, slicer):
        (volumes if isinstance(result, PrintedVolume) else findings).append(result)  # type: ignore[arg-type]
    texts = {
        kind: tuple(dict.fromkeys(finding.text for finding in findings if finding.kind is kind)) for kind in Severity
    }
    return Diagnosis(
        slicer=slicer,
        fine=not texts[Severity.PROBLEM],
        problems=texts[Severity.PROBLEM],
        warnings=texts[Severity.WARNING],
        application=package.metadata.get("Application", ""),
        unit=package.unit,
        volumes=tuple(volumes),
    )


def _examine(package: Package, slicer: Slicer) -> Iterator[PrintedVolume | Finding]:
    """Yield the volumes that a slicer prints, and the findings."""
    yield from _check_package(package, slicer)
    volumes = []
    for result in READERS[slicer](package):
        if isinstance(result, PrintedVolume):
            volumes.append(result)
        yield result
    for volume in volumes:
        yield from _check_mesh(volume)
    total = sum(volume.triangles for volume in volumes)
    if slicer in ("orcaslicer", "bambustudio") and total > MOST_ON_COMMAND_LINE:
        yield as_warning(
            f"it has {total:,} triangles, and OrcaSlicer's command line takes a million; its window takes more"
        )
    if not any(volume.prints for volume in volumes):
        yield as_problem("there is nothing in it to print")


def _check_package(package: Package, slicer: Slicer) -> Iterator[Finding]:
    """Yield findings that hold in every slicer."""
    if not package.has(RELATIONS):
        yield as_problem(f"it has no {RELATIONS}, without which newer slicers do not open it")
    if package.unit not in STATED_UNITS:
        yield as_problem(f"its unit is {package.unit!r}, and 3MF knows {', '.join(STATED_UNITS)}")
    elif package.unit != "millimeter":
        yield as_warning(f"its unit is the {package.unit}, and it is scaled to millimetres")
    for extension in package.extensions:
        if not extension.known:
            yield as_problem(
                f"it requires the extension {extension}, which slicers do not know: they leave out what it describes"
            )
    for item in package.items:
        if not item.prints:
            yield as_warning(f"object {item.key} is not to be printed")
    for key in dict.fromkeys(item.key for item in package.items):
        if key in package.bodies:
            yield from _check_tree(package, key, slicer)
        else:
            yield as_problem(f"it builds an object {key} that it does not hold")
    made_for = [name for name, config in CONFIGS.items() if package.has(config)]
    if any(key.startswith(f"{{{cura.NAMESPACE}}}") for body in package.bodies.values() for key in body.settings):
        made_for.append("cura")
    if slicer != "plain" and made_for and FAMILY[slicer] not in made_for:
        yield as_problem(
            f"its settings are for {' and '.join(NAMES[name] for name in made_for)}, and {NAMES[slicer]} does not read "
            f"them; make it again with --for {slicer}"
        )


def _check_tree(package: Package, key: str, slicer: Slicer) -> Iterator[Finding]:
    """Yield findings about an object that is built, and about its components."""
    tree = package.tree(key)
    for component in tree.missing:
        yield as_problem(f"object {key} consists of {component}, which is not there, holds itself, or lies too deep")
    if not tree.whole:
        yield as_problem(f"object {key} consists of more objects or triangles than a slicer can take")
    for leaf in tree.leaves:
        if (alien := leaf.other) is not None and slicer != "prusaslicer":  # PrusaSlicer has a separate rule
            yield as_problem(
                f"object {alien.number} is of type {alien.kind!r}, which is not a part: slicers leave it out, print it "
                "or refuse the file"
            )
        for body in (*leaf.above, leaf.body):
            for shape in body.foreign:
                yield as_problem(f"object {body.number} has {shape}, which slicers leave out")
    body = package.bodies[key]
    if not tree.leaves and body.foreign:
        yield as_problem(f"object {key} has {' and '.join(body.foreign)}, which slicers leave out")


def _check_mesh(volume: PrintedVolume) -> Iterator[Finding]:
    """Yield findings about the mesh of a volume."""
    if not volume.triangles:
        yield as_problem(f"{volume.name} has no triangles")
    elif not volume.closed:
        yield as_problem(f"{volume.name} is not closed: slicers leave out layers where it is open, without a word")
    elif not volume.outward:
        yield as_problem(f"{volume.name} faces inwards")
    elif volume.shared:
        yield as_warning(
            f"{volume.name} has {count_noun(volume.shared, 'edge')} with more than two faces: slicers mostly cope"
        )


def _volumes_of_plain(package: Package) -> Iterator[PrintedVolume | Finding]:
    """Yield each mesh of the objects to print as a part of its own; warn if there are several."""
    meshes = [
        PrintedVolume.of(leaf.body.name or f"object {leaf.key}", leaf.body.mesh, "part", {})
        for item in package.items
        if item.prints
        for leaf in package.tree(item.key).leaves
        if leaf.other is None and leaf.body.mesh is not None
    ]
    yield from meshes
    if len(meshes) > 1:
        yield as_warning(
            f"its {len(meshes)} objects have no settings: a slicer fills each by its profile and prints overlaps "
            "twice, unless you combine them there"
        )


FAMILY = {"prusaslicer": "prusaslicer", "orcaslicer": "bambustudio", "bambustudio": "bambustudio", "cura": "cura"}
CONFIGS = {"prusaslicer": prusaslicer.CONFIG, "bambustudio": bambustudio.CONFIG}
STATED_UNITS = ("micron", "millimeter", "centimeter", "inch", "foot", "meter")
READERS: dict[str, Callable[[Package], Iterator[PrintedVolume | Finding]]] = {
    "prusaslicer": volumes_for_prusaslicer,
    "orcaslicer": lambda package: volumes_for_bambustudio(package, "orcaslicer"),
    "bambustudio": lambda package: volumes_for_bambustudio(package, "bambustudio"),
    "cura": volumes_for_cura,
    "plain": _volumes_of_plain,
}
