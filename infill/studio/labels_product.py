"""Labels in the studio: one call of `infill.smooth_labels`."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any, BinaryIO, cast

from infill.options.declaration import by_field, read_options
from infill.smoothing.settings import NOT_FOR_LABELS, SmoothSettings, resolve
from infill.studio.changed_places import list_places
from infill.studio.equivalents import Call, Code, join_words, write_command, write_value
from infill.studio.numbers import label_numbers
from infill.studio.products import Made, Order
from infill.studio.smoothing_keywords import shared_keywords

DECLARATION = SmoothSettings
LEFT_OUT: tuple[str, ...] = ("as", "array", "series", "frame", "spacing", "roi", "each_label", *NOT_FOR_LABELS)


def make(order: Order) -> Made:
    """Smooth the labels of a scan; coarsely, in few steps, with all triangles."""
    from infill.imaging.label_tables import read_labels
    from infill.smoothing.labels import smooth_labels
    from infill.smoothing.sources import read_label_source

    content, options = order.need("scan"), dict(order.options)
    if order.coarse:
        options |= {"tolerance": 0.0, "allow_broken": True, "smooth": "plain"}
    settings = resolve(options)
    choice = {name: getattr(settings, name) for name in ("label", "keep_going", "together")}
    means: Any = {**choice, **settings.options, "max_memory": order.memory, "progress": order.progress}
    table = () if settings.labels is None else read_labels(settings.labels)
    result: Any = smooth_labels(
        read_label_source(content.path),
        table=table,
        **means,
    )
    return Made(
        result=result,
        report=result.report,
        numbers=list(label_numbers(result.report, coarse=order.coarse)),
        surfaces=dict(result.surfaces),
        colours=dict(result.colours),
        more={"places": list_places(result.report)},
    )


def write(made: Made, path: Path) -> None:
    """Write all labels into one file; a .zip holds an STL of each, named as ``-o {label}.stl`` names them."""
    if path.suffix != ".zip":
        made.result.save(path)
        return
    from infill.files.file_names import safe_names
    from infill.formats.mesh_files import mesh_writer

    surfaces = made.result.surfaces
    names = safe_names(list(surfaces), [f"label_{number}" for number in range(1, len(surfaces) + 1)])
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, surface in zip(names, surfaces.values(), strict=True):
            with archive.open(f"{name}.stl", "w") as file:
                mesh_writer(Path(f"{name}.stl"))(surface, cast("BinaryIO", file))


def again(order: Order, file: str) -> dict[str, str]:
    """Return the command, the Python and the TOML that make the file of all labels again."""
    content, options = order.need("scan"), dict(order.options)
    values = by_field(SmoothSettings, read_options("smooth", SmoothSettings, options))
    keywords: dict[str, Any] = {
        name: values.pop(name) for name in ("label", "keep_going", "together") if name in values
    }
    table = values.pop("labels", None)
    if table is not None:
        keywords["table"] = Code(f"read_labels({write_value(str(table))})")
    keywords |= shared_keywords(values)
    imports = [name for name, is_used in (("Smoothing", "smoothing" in keywords), ("read_labels", table)) if is_used]
    call = Call(
        function="smooth_labels",
        positional=(content.path,),
        keywords=keywords,
        imports=tuple(imports),
        save=f"result.save({write_value(file)})",
    )
    typed = options if options.get("together") else {**options, "each_label": True}
    words = write_command("smooth", [content.path], SmoothSettings, typed, {})
    return {
        "command": join_words([*words, "-o", file]),
        "python": call.to_python(),
        "toml": resolve(typed).to_toml(),
    }
