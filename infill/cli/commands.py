"""How a command reads its options and shows its help: flags without a type, mathematics last."""

from __future__ import annotations

from typing import Any

from typer.core import TyperCommand, TyperGroup

ADVANCED = "Advanced"  # the panel of what needs the mathematics


class Command(TyperCommand):
    """A command of ours."""

    def get_params(self, ctx: Any) -> list[Any]:  # noqa: ANN401 - typer's own class, which it does not export
        """Return the options and arguments in the order of the help."""
        return _shown(super().get_params(ctx))


class Group(TyperGroup):
    """The app itself, which shows its flags as its commands do."""

    def get_params(self, ctx: Any) -> list[Any]:  # noqa: ANN401
        """Return the options of the app."""
        return _shown(super().get_params(ctx))


def _shown(params: list[Any]) -> list[Any]:
    """Return parameters with those of the panel "Advanced" last; flags take no value, so they show no type of one."""
    for each in params:
        if getattr(each, "is_flag", False) and each.metavar is None:
            each.metavar = ""
    return sorted(params, key=lambda each: getattr(each, "rich_help_panel", None) == ADVANCED)
