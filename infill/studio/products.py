"""The products of the studio: each request is one call of a public function of `infill`."""

from __future__ import annotations

import importlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, cast

from infill.errors import UsageError
from infill.studio.frames import ANSWER, MESH, AnswerFrame
from infill.studio.numbers import Number, grams_by_material
from infill.viewer.packing import pack_surfaces

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from infill.result import Progress
    from infill.studio.reading import Content
    from infill.surface import Surface


@dataclass(frozen=True, kw_only=True, eq=False)
class Order:
    """A request to a product, checked.

    Parameters
    ----------
    options : dict
        By key, as on the command line, with names of files in the folder of the page.
    parameters : dict
        Parameters of the pattern by name.
    content : Content or None
        The file that it is for.
    coarse : bool
        Whether a quick look is enough.
    layer : int or None
        Of a print, counted from 1.
    target : Path
        File that the call may write, for products that write files; its suffix is that of the input.
    progress : callable
    memory : int
        Bytes.
    """

    options: Mapping[str, Any]
    parameters: Mapping[str, Any]
    content: Content | None
    coarse: bool
    layer: int | None
    target: Path
    progress: Progress
    memory: int

    def need(self, *kinds: str) -> Content:
        """Return the file, or raise UsageError if it is missing or of another kind."""
        if self.content is None or self.content.kind not in kinds:
            raise UsageError(f"this needs a {' or a '.join(kinds)}; choose a file first")
        return self.content


@dataclass(frozen=True, kw_only=True, eq=False)
class Made:
    """The outcome of a product.

    Parameters
    ----------
    result : any
        Of the library, for files.
    report : mapping
    numbers : list of Number
    surfaces : mapping of str to Surface
        To be shown.
    colours : mapping
    values : mapping of str to (V,) uint8
        Numbers of the vertices of surfaces, which the page shows as colours.
    frames : tuple of AnswerFrame
        Further ones, such as a layer of a print.
    volume : float or None
        Of material, mm³.
    more : mapping
        What else the page gets to know, as plain values.
    """

    result: Any
    report: Mapping[str, Any]
    numbers: list[Number]
    surfaces: Mapping[str, Surface] = field(default_factory=dict)
    colours: Mapping[str, Any] = field(default_factory=dict)
    values: Mapping[str, NDArray[np.uint8]] = field(default_factory=dict)
    frames: tuple[AnswerFrame, ...] = ()
    volume: float | None = None
    more: Mapping[str, Any] = field(default_factory=dict)


class ProductCode(Protocol):
    """A module of a product."""

    DECLARATION: type[Any]
    LEFT_OUT: tuple[str, ...]  # options that it does not have here

    def make(self, order: Order) -> Made:
        """Make it."""
        ...

    def write(self, made: Made, path: Path) -> None:
        """Write its file."""
        ...

    def again(self, order: Order, file: str) -> dict[str, str]:
        """Return how to make a file again: "command", "python" and "toml"."""
        ...


@dataclass(frozen=True, kw_only=True)
class Product:
    """A product and the files that it can be had as.

    Parameters
    ----------
    module : str
        In `infill.studio`: see `ProductCode`.
    downloads : tuple of str
        Formats, the usual one first.
    word : str
        Ending of the names of its files, after that of the input.
    """

    module: str
    downloads: tuple[str, ...]
    word: str = ""

    @property
    def code(self) -> ProductCode:
        """The module of the product."""
        return cast("ProductCode", importlib.import_module(f"infill.studio.{self.module}"))

    def file_name(self, stored: str | None, file_format: str) -> str:
        """Return the name of a file in a format, made of an input with a name, or of none."""
        from infill.studio.upload_names import split_suffix

        stem, suffix = (self.word, "") if stored is None else split_suffix(stored)
        parameters = {"project": ".3mf", "gcode": suffix}
        return f"{stem if stored is None else f'{stem}-{self.word}'}{parameters.get(file_format, f'.{file_format}')}"


MESHES = ("stl", "3mf", "obj", "ply", "glb")
PRODUCTS: Mapping[str, Product] = {
    "fill": Product(module="fill_product", downloads=(*MESHES, "project"), word="filled"),
    "make": Product(module="make_product", downloads=MESHES, word="block"),
    "smooth": Product(module="smooth_product", downloads=MESHES, word="smooth"),
    "labels": Product(module="labels_product", downloads=("3mf", "glb", "zip"), word="labels"),
    "refill": Product(module="refill_product", downloads=("gcode",), word="refilled"),
    "motion": Product(module="motion_product", downloads=()),
}


def find_product(name: object) -> Product:
    """Return the product of a name, or raise UsageError."""
    product = PRODUCTS.get(str(name))
    if product is None:
        raise UsageError(f"there is no product {str(name)[:40]!r}; choose from {', '.join(PRODUCTS)}")
    return product


def describe_product(name: str) -> list[dict[str, Any]]:
    """Return the options of a product as plain values."""
    from infill.studio.option_forms import describe_options

    code = PRODUCTS[name].code
    return describe_options(code.DECLARATION, code.LEFT_OUT)


def answer_frames(
    name: str, made: Made, again: Mapping[str, str], result: str | None, warnings: list[str]
) -> Iterator[AnswerFrame]:
    """Yield the answer of a product: numbers, warnings, the report, how to make it again, and meshes to show."""
    answer = {
        "product": name,
        "result": result,
        "numbers": [number.facts() for number in made.numbers],
        "grams": {} if made.volume is None else grams_by_material(made.volume),
        "warnings": [*made.report.get("problems", ()), *warnings],
        "report": dict(made.report),
        **made.more,
        **again,
        "downloads": list(PRODUCTS[name].downloads) if result is not None else [],
    }
    yield AnswerFrame.of_json(ANSWER, answer)
    if made.surfaces:
        packed = pack_surfaces(made.surfaces, colours=made.colours, values=made.values)
        yield AnswerFrame(kind=MESH, payload=packed)
    yield from made.frames
