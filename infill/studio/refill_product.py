"""Refill in the studio: one call of `infill.refill`, of one layer for a quick look."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

from infill.options.declaration import by_field, read_options
from infill.options.toml import format_options
from infill.refilling.request import Request
from infill.studio.equivalents import Call, assignments, join_words, plain_parameters, write_command
from infill.studio.frames import AnswerFrame
from infill.studio.numbers import refill_numbers
from infill.studio.print_layers import layer_frame, plan_print
from infill.studio.products import Made, Order

DECLARATION = Request
LEFT_OUT: tuple[str, ...] = ()


def make(order: Order) -> Made:
    """Refill a print into the target; for a quick look, one layer of it, which is shown."""
    from infill.refilling.job import refill
    from infill.refilling.settings import resolve

    content, options = order.need("print"), dict(order.options)
    if order.coarse:
        layer = order.layer or max(1, content.data.layers // 2)
        options["layers"] = [layer, layer]
    arguments = resolve(options, None, list(assignments(order.parameters)))
    order.target.parent.mkdir(exist_ok=True)
    result = refill(content.path, output=order.target, **arguments, progress=order.progress)
    frames: tuple[AnswerFrame, ...] = ()
    if order.coarse:
        frames = (layer_frame(plan_print(order.target), options["layers"][0]),)
        order.target.unlink(missing_ok=True)
    return Made(result=result, report=result.report, numbers=list(refill_numbers(result.report)), frames=frames)


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
