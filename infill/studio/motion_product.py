"""The time of a print in the studio: one call of `infill.motion`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from infill.errors import UsageError
from infill.options.declaration import by_field, read_options
from infill.studio.equivalents import Call, join_words, write_command
from infill.studio.numbers import motion_numbers
from infill.studio.products import Made, Order
from infill.timing.request import MotionOptions

DECLARATION = MotionOptions
LEFT_OUT: tuple[str, ...] = ()


def make(order: Order) -> Made:
    """Plan the moves of a print."""
    from infill.timing.printing_time import motion

    content = order.need("print")
    values: dict[str, Any] = by_field(MotionOptions, read_options("motion", MotionOptions, dict(order.options)))
    order.progress("plan", 0.1)
    result = motion(content.path, **values)
    report = dict(result.to_dict())
    return Made(result=result, report=report, numbers=list(motion_numbers(report)))


def write(made: Made, path: Path) -> None:  # noqa: ARG001 - as all products
    """Raise UsageError: there is no file."""
    raise UsageError("a time has no file; save the command instead")


def again(order: Order, file: str) -> dict[str, str]:  # noqa: ARG001 - as all products
    """Return the command and the Python that plan the print again."""
    content, options = order.need("print"), dict(order.options)
    values: dict[str, Any] = by_field(MotionOptions, read_options("motion", MotionOptions, options))
    plain = {name: str(value) if isinstance(value, Path) else value for name, value in values.items()}
    call = Call(function="motion", positional=(content.path,), keywords=plain)
    words = write_command("motion", [content.path], MotionOptions, options, {})
    return {"command": join_words(words), "python": call.to_python(), "toml": ""}  # the command takes no file
