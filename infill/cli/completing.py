"""What a shell offers for a word that is begun; the catalogue is loaded only when it asks."""

from __future__ import annotations

import typer


def pattern_names(incomplete: str) -> list[tuple[str, str]]:
    """Return the patterns whose names begin so, each with its summary."""
    from patterns import PATTERNS

    return [(name, kind.summary) for name, kind in PATTERNS.items() if name.startswith(incomplete)]


def pattern_assignments(context: typer.Context, incomplete: str) -> list[tuple[str, str]]:
    """Return ``name=`` for the parameters of the pattern that was typed, then ``name=value`` for a flag among them."""
    from patterns import PATTERNS, parameters

    pattern = context.params.get("pattern") or ""
    if pattern not in PATTERNS:
        return []
    begun = incomplete.replace("_", "-")
    offered = []
    for name, (field, described) in parameters(PATTERNS[pattern]).items():
        word = f"{name.replace('_', '-')}="
        if isinstance(field.default, bool) and begun.startswith(word):
            offered += [(f"{word}{value}", described.help) for value in ("true", "false")]
        else:
            offered.append((word, described.help))
    return [(word, text) for word, text in offered if word.startswith(begun)]
