"""Blocks in the studio: one call of `infill.make`."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from infill.errors import UsageError
from infill.making.settings import MakeSettings, resolve
from infill.options.command_words import assignments
from infill.options.declaration import by_field, read_options
from infill.studio.equivalents import Call, join_words, plain_parameters, write_command, write_value
from infill.studio.numbers import block_numbers
from infill.studio.products import Made, Order
from infill.studio.smoothing_keywords import SMOOTHING, smoothing_code

DECLARATION = MakeSettings
LEFT_OUT: tuple[str, ...] = ()


def _settings(order: Order) -> MakeSettings:
    """Return the settings of a block."""
    if "pattern" not in order.options:
        raise UsageError.about("pattern", "is missing; choose one")
    return resolve(dict(order.options), None, list(assignments(order.parameters)))


def make(order: Order) -> Made:
    """Make a block."""
    result = _settings(order).make(max_memory=order.memory, progress=order.progress)
    return Made(
        result=result,
        report=result.report,
        numbers=list(block_numbers(result.report)),
        surfaces=dict(result.surfaces),
        volume=result.report["volume"],
    )


def write(made: Made, path: Path) -> None:
    """Write the file of a block."""
    made.result.save(path)


def again(order: Order, file: str) -> dict[str, str]:
    """Return the command, the Python and the TOML that make the file of a block again."""
    options: dict[str, Any] = {name: value for name, value in order.options.items() if name != "pattern"}
    pattern, settings = order.options["pattern"], _settings(order)
    values = by_field(MakeSettings, read_options("make", MakeSettings, options))
    code = smoothing_code(values)
    keywords = {name: value for name, value in values.items() if name not in SMOOTHING}
    call = Call(
        function="make",
        positional=(pattern,),
        keywords={**keywords, **code, **plain_parameters(order.parameters)},
        imports=("Smoothing",) if code else (),
        save=f"result.save({write_value(file)})",
    )
    words = write_command("make", [pattern], MakeSettings, options, order.parameters)
    return {"command": join_words([*words, "-o", file]), "python": call.to_python(), "toml": settings.to_toml()}
