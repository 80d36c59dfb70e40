"""Fields that a density follows: a number at every point of a part; only the order and the ratios of steps count."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from infill.arrays import Floats
from infill.drawings.bitmaps import read_grey
from infill.errors import FormatError, ParameterError, UsageError
from infill.files.array_names import SIMULATIONS, split_array_name
from infill.files.broken import require_readable, wrap_reader_errors
from infill.files.excerpts import excerpt
from infill.formats.simulations import read_simulation
from infill.options.modules import load_object, names_code, user_error_text
from infill.plain_numbers import count_noun, plain_argument

if TYPE_CHECKING:
    from scipy.spatial import cKDTree

AXES = ("x", "y", "z")
SKIN, ROOFS = "skin", "roofs"
PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff")
TABLES, ARRAYS = (".csv", ".txt"), (".npy",)
COLUMNS = 4  # x, y, z and a value
BEYOND = 0.1  # of the side of a box: how far it may reach beyond the points of a field, whose nearest one counts


class FieldPlace(Protocol):
    """The part, or the print, in which fields are evaluated."""

    @property
    def bounds(self) -> Floats:
        """The lowest and the highest corner of its box, (2, 3), mm."""
        ...

    def skin_depth(self, points: Floats) -> Floats:
        """Return the distance of points (N, 3), mm, from the skin, in a unit of its own: (N,)."""
        ...


@runtime_checkable
class PlaceWithRoofs(FieldPlace, Protocol):
    """A place that also knows what lies above a point."""

    def roof_depth(self, points: Floats) -> Floats:
        """Return how far points (N, 3) lie below the roof above them: (N,), mm."""
        ...


class Field(Protocol):
    """A number at every point."""

    def at(self, points: Floats, place: FieldPlace) -> Floats:
        """Evaluate the field at points (N, 3), mm, inside the walls of a part: (N,)."""
        ...


@dataclass(frozen=True, kw_only=True)
class AxisField:
    """The coordinate along an axis."""

    axis: int

    def at(self, points: Floats, place: FieldPlace) -> Floats:  # noqa: ARG002 - of the protocol
        """Return the coordinates of points (N, 3) along the axis, mm: (N,)."""
        return points[:, self.axis]


@dataclass(frozen=True, kw_only=True)
class SkinDepthField:
    """The distance from the inner side of the walls."""

    def at(self, points: Floats, place: FieldPlace) -> Floats:
        """Return the depth of points (N, 3) below the inner side of the walls: (N,)."""
        return place.skin_depth(points)


@dataclass(frozen=True, kw_only=True)
class RoofDepthField:
    """The distance upwards to the roof, in a place that knows its roofs."""

    def at(self, points: Floats, place: FieldPlace) -> Floats:
        """Return the depth of points (N, 3) below roofs: (N,)."""
        assert isinstance(place, PlaceWithRoofs)
        return place.roof_depth(points)


@dataclass(frozen=True, kw_only=True, eq=False)
class ScatteredField:
    """Numbers at points, linear in between, and the number of the nearest point beyond.

    Parameters
    ----------
    points : (N, 3) float64, mm
    values : (N,) float64
    """

    points: Floats
    values: Floats

    def covers(self, low: Floats, high: Floats) -> bool:
        """Tell whether the points lie all over a box, or nearly; points in a plane hold for all heights."""
        first, last = self.points.min(axis=0), self.points.max(axis=0)
        most = BEYOND * (high - low)
        most[2] = most[2] if last[2] > first[2] else np.inf
        return not ((first - low > most) | (high - last > most)).any()

    @cached_property
    def _tree(self) -> cKDTree:
        """Search tree of the points."""
        from scipy.spatial import cKDTree

        return cKDTree(self.points)

    @cached_property
    def _interpolate(self) -> Callable[[Floats], Floats] | None:
        """The linear interpolation, or None without tetrahedra between the points."""
        from scipy.interpolate import LinearNDInterpolator
        from scipy.spatial import QhullError

        try:
            interpolate: Callable[[Floats], Floats] = LinearNDInterpolator(self.points, self.values, rescale=True)
        except QhullError:  # fewer than four, or all in a plane
            return None
        return interpolate

    def at(self, points: Floats, place: FieldPlace) -> Floats:  # noqa: ARG002 - of the protocol
        """Interpolate the values at points (N, 3), mm; beyond them, the nearest value counts: (N,)."""
        interpolated = np.full(len(points), np.nan) if self._interpolate is None else self._interpolate(points)
        beyond = ~np.isfinite(interpolated)
        interpolated[beyond] = self.values[self._tree.query(points[beyond])[1]]
        return interpolated


@dataclass(frozen=True, kw_only=True, eq=False)
class SimulatedField(ScatteredField):
    """Numbers at points of a whole part, which may lie elsewhere than the part does on a bed."""


@dataclass(frozen=True, kw_only=True, eq=False)
class BoxedField:
    """Numbers in equal boxes that make up the box around the part, linear in between.

    Parameters
    ----------
    values : (nx, ny, nz) float64
    """

    values: Floats

    def at(self, points: Floats, place: FieldPlace) -> Floats:
        """Interpolate the array over the box of the part at points (N, 3), mm: (N,)."""
        from scipy.ndimage import map_coordinates

        low, high = np.asarray(place.bounds, dtype=np.float64)
        nodes = (points - low) / np.maximum(high - low, 1e-12) * self.values.shape - 0.5
        interpolated: Floats = map_coordinates(self.values, nodes.T, order=1, mode="nearest")
        return interpolated


@dataclass(frozen=True, kw_only=True, eq=False)
class FunctionField:
    """A function of points (N, 3), mm, that returns a number for each."""

    function: Callable[[Floats], Any]
    name: str

    def at(self, points: Floats, place: FieldPlace) -> Floats:  # noqa: ARG002 - of the protocol
        """Call the function with points (N, 3), mm, and check its numbers: (N,)."""
        try:
            numbers = np.asarray(self.function(points), dtype=np.float64)
        except (Exception, SystemExit) as error:
            raise ParameterError.about("by", f"is {self.name}, which fails: {user_error_text(error)}") from error
        if numbers.shape != (len(points),):
            raise UsageError.about(
                "by", f"is {self.name}, which returns {numbers.shape} for {points.shape} points; return (N,)"
            )
        return numbers


def resolve_field(by: object, *, roofs: bool = False) -> tuple[Field, str]:
    """Resolve the field that a density follows; return it and its name.

    Parameters
    ----------
    by : str, Path, array or callable
        "x", "y", "z" or "skin"; a file: a .csv of x, y, z and a value, results of a simulation, .vtu or .frd, a .npy of
        three axes, or a picture seen from above, over the box around the part; "module.py:name"; such an array; or a
        function of points (N, 3), mm. "results.vtu:name" is one of the arrays of results.
    roofs : bool
        Take "roofs" too: the place knows them.

    Raises
    ------
    UsageError
        If it is none of these.
    FormatError
        If there is no such file, or it holds something else.
    """
    if callable(by):
        name = getattr(by, "__name__", type(by).__name__)
        return FunctionField(function=by, name=name), name
    if isinstance(by, np.ndarray):
        return _field_of_array(by, "an array"), f"an array of shape {by.shape}"
    words = ", ".join((*AXES, SKIN, *([ROOFS] if roofs else [])))
    if not isinstance(by, (str, Path)):
        raise UsageError.about("by", f"is {by!r}; give {words}, a file, an array or a function")
    text = str(by)
    if text in AXES:
        return AxisField(axis=AXES.index(text)), text
    if text == SKIN:
        return SkinDepthField(), text
    if text == ROOFS and roofs:
        return RoofDepthField(), text
    path = Path(text)
    suffix = path.suffix.lower()
    if names_code(text):
        loaded = load_object(text)
        if not callable(loaded):
            raise FormatError(f"{text} is not a function; check the name")
        return FunctionField(function=loaded, name=text), text
    if suffix in PICTURES:
        grey = read_grey(require_readable(path, PICTURES, "a picture"))
        return BoxedField(values=grey[::-1].T[:, :, None].astype(np.float64)), text
    results, array = split_array_name(text)
    if results.suffix.lower() in SIMULATIONS:
        simulated = read_simulation(results, array)
        return SimulatedField(points=simulated.points, values=simulated.values), text
    if suffix in (*TABLES, *ARRAYS):
        source = require_readable(path, (*TABLES, *ARRAYS), "a field")
        with wrap_reader_errors(source, "holds something other than numbers", "write rows of x, y, z and a value"):
            values = np.load(source, allow_pickle=False) if suffix in ARRAYS else _read_table(source)
        return _field_of_array(values, text), text
    files = ", ".join(f"a {known}" for known in (TABLES[0], *ARRAYS, *SIMULATIONS))
    raise UsageError.about("by", f"is {text!r}; give {words}, {files}, a picture, or module.py:name")


def _field_of_array(values: NDArray[Any], name: str) -> Field:
    """Return the field of an array: a box of values (nx, ny, nz), or rows of x, y, z and a value."""
    values = np.asarray(values, dtype=np.float64)
    if not values.size or not np.isfinite(values).all():
        raise FormatError.about("by", f"is {name}, which holds nothing, or numbers that are not finite; check it")
    if values.ndim == 3:
        return BoxedField(values=values)
    if values.ndim == 2 and values.shape[1] == COLUMNS:
        return ScatteredField(points=values[:, :3], values=values[:, 3])
    raise FormatError.about("by", f"is {name} of shape {values.shape}; give rows of x, y, z and a value, or three axes")


def _read_table(path: Path) -> Floats:
    """Read the rows of a table with or without a heading; between semicolons, numbers may have a decimal comma."""
    rows: list[list[float]] = []
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        words = (line.replace(",", ".").replace(";", " ") if ";" in line else line.replace(",", " ")).split()
        if not words or words[0].startswith("#"):
            continue
        try:
            row = [float(word) for word in words]
        except ValueError:
            if number == 1:
                continue
            complaint = f"is {excerpt(line)!r}"
        else:
            rows.append(row)
            if len(row) == COLUMNS:
                continue
            complaint = f"has {count_noun(len(row), 'number')}"
        raise FormatError(f"line {number} of {path} {complaint}; write x, y, z and a value, four numbers in each row")
    return np.array(rows)


def describe_box(low: Floats, high: Floats) -> str:
    """Describe a box in words: the ranges of x, y and z."""
    return ", ".join(
        f"{axis} {plain_argument(round(float(a), 1))} to {plain_argument(round(float(b), 1))}"
        for axis, a, b in zip(AXES, low, high, strict=True)
    )
