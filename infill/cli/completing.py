"""Completions of words in a shell; the catalogue is loaded only on request."""

from __future__ import annotations

from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from patterns.declared import DescribedField


def block_pattern_names(incomplete: str) -> list[tuple[str, str]]:
    """Return the patterns of `make` whose names begin with the word, each with its summary."""
    from patterns import PATTERNS

    return [(name, kind.summary) for name, kind in PATTERNS.items() if name.startswith(incomplete) and kind.prismatic]


def sample_names(incomplete: str) -> list[tuple[str, str]]:
    """Return the samples whose names begin with the word, each with its summary."""
    from infill.samples.catalogue import SAMPLES

    return [(name, sample.summary) for name, sample in SAMPLES.items() if name.startswith(incomplete)]


def fill_pattern_names(incomplete: str) -> list[tuple[str, str]]:
    """Return all patterns whose names begin with the word, each with its summary."""
    from patterns import PATTERNS

    return [(name, kind.summary) for name, kind in PATTERNS.items() if name.startswith(incomplete)]


def slicer_names(incomplete: str) -> list[str]:
    """Return the slicers whose names begin with the word."""
    from infill.projects.project import SLICERS

    return [slicer for slicer in SLICERS if slicer.startswith(incomplete)]


def profiled_slicer_names(incomplete: str) -> list[str]:
    """Return the slicers of `setup` whose names begin with the word."""
    from infill.slicer_profiles.desktops import PROFILED_SLICERS

    return [slicer for slicer in PROFILED_SLICERS if slicer.startswith(incomplete)]


def fill_assignments(context: typer.Context, incomplete: str) -> list[tuple[str, str]]:
    """Return ``name=`` for the parameters of the pattern of a fill, without those that are options of `fill`."""
    from patterns import PATTERNS, parameters
    from patterns.shared import SHARED

    pattern = str(context.params.get("pattern"))
    declared = parameters(PATTERNS[pattern]) if pattern in PATTERNS else {}
    return _assignments({name: declared[name] for name in declared if name not in SHARED}, incomplete)


def pattern_assignments(context: typer.Context, incomplete: str) -> list[tuple[str, str]]:
    """Return ``name=`` for the parameters of the pattern typed, then ``name=value`` for a flag among them."""
    from patterns import PATTERNS, parameters

    # While --set is waiting for its value, positional arguments cannot be distinguished from leftovers.
    pattern = next((word for word in (context.params.get("pattern"), *context.args) if word in PATTERNS), None)
    if pattern is None:
        return []
    return _assignments(parameters(PATTERNS[pattern]), incomplete)


def placement_assignments(context: typer.Context, incomplete: str) -> list[tuple[str, str]]:
    """Return ``name=`` for the parameters of the pattern of a refill."""
    from infill.refilling.placement import default_parameters
    from patterns import parameters

    return _assignments(parameters(default_parameters(context.params.get("pattern") or "keep")), incomplete)


def _assignments(declared: dict[str, DescribedField], incomplete: str) -> list[tuple[str, str]]:
    """Return completions of `name=` and `name=true`, each with its help."""
    candidates = []
    for name, (field, described) in declared.items():
        word = f"{name if '_' in incomplete else name.replace('_', '-')}="
        values = ("true", "false") if isinstance(field.default, bool) and incomplete.startswith(word) else ("",)
        candidates += [(word + value, described.help) for value in values if (word + value).startswith(incomplete)]
    return candidates
