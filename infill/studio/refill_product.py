"""Refill in the studio: one call of `infill.refill`, of one layer for a quick look."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

from infill.errors import FormatError
from infill.options.command_words import assignments
from infill.options.declaration import by_field, read_options
from infill.options.toml import format_options
from infill.plain_numbers import count_noun
from infill.refilling.request import Request
from infill.studio.equivalents import Call, join_words, plain_parameters, write_command
from infill.studio.frames import AnswerFrame
from infill.studio.numbers import Number, refill_draft_numbers, refill_numbers
from infill.studio.print_layers import layer_frame, plan_print
from infill.studio.print_reading import describe_features
from infill.studio.products import Made, Order

DECLARATION = Request
LEFT_OUT: tuple[str, ...] = ()


def make(order: Order) -> Made:
    """Refill a print into the target; for a quick look, one layer of it, which is shown."""
    from infill.refilling.job import refill
    from infill.refilling.settings import resolve
    from infill.timing.printing_time import motion

    content, options = order.need("print"), dict(order.options)
    if order.coarse:
        layer = order.layer or max(1, content.data.layers // 2)
        options["layers"] = [layer, layer]
    arguments = resolve(options, None, list(assignments(order.parameters)))
    order.target.parent.mkdir(exist_ok=True)
    result = refill(content.path, output=order.target, **arguments, progress=order.progress)
    frames: tuple[AnswerFrame, ...] = ()
    more: dict[str, Any] = {}
    if order.coarse:
        frames = (layer_frame(plan_print(order.target), options["layers"][0]),)
        order.target.unlink(missing_ok=True)
        numbers = list(refill_draft_numbers(result.report))
    else:
        numbers = [
            verdict_number(content.path, order.target, changes_filament="density" in options),
            *refill_numbers(result.report),
        ]
        more = {"features": describe_features(motion(order.target).to_dict())}
    return Made(result=result, report=result.report, numbers=numbers, frames=frames, more=more)


def verdict_number(before: str, after: Path, *, changes_filament: bool) -> Number:
    """Compare the refilled print with the one before, as `infill verify` does; return the verdict.

    With a density of its own, the filament of layers is meant to change.
    """
    from infill.verifying.job import verify

    try:
        count = len(verify(before, after, allow=("material",) if changes_filament else ()).violations)
    except FormatError:
        verdict = "not compared"
    else:
        verdict = f"{count_noun(count, 'place')} changed besides" if count else "nothing else changed"
    return Number(name="verdict", value=verdict, help="Of infill verify: whether anything but sparse infill changed")


def write(made: Made, path: Path) -> None:
    """Copy the refilled print."""
    shutil.copyfile(made.result.path, path)


def again(order: Order, file: str) -> dict[str, str]:
    """Return the command, the Python and the TOML that refill the print again."""
    content, options = order.need("print"), dict(order.options)
    values: dict[str, Any] = by_field(Request, read_options("refill", Request, options))
    call = Call(
        function="refill",
        positional=(content.path,),
        keywords={"output": file, **values, **plain_parameters(order.parameters)},
    )
    words = write_command("refill", [content.path], Request, options, order.parameters)
    head = "infill refill PRINT --config THIS_FILE -o OUT"
    toml = format_options({**options, "parameters": plain_parameters(order.parameters)}, head)
    return {"command": join_words([*words, "-o", file]), "python": call.to_python(), "toml": toml}
