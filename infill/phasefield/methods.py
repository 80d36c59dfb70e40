"""`smooth`: a single entry point to all kernels."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from infill.errors import ParameterError, UsageError
from infill.phasefield.allen_cahn import Smoothing, as_phase_field, smooth_reference
from infill.phasefield.inplace import smooth_inplace

Method = Literal["auto", "numpy", "inplace", "dense", "sparse"]
Kernel = Callable[..., NDArray[np.floating]]
COMPILED = ("dense", "sparse")
COMPILED_AXES = 3
WORTH_COMPILING = 2e8  # cells times steps: some seconds without a compiler, about as long as compiling takes


def _dense(*args: Any, **options: Any) -> NDArray[np.floating]:  # noqa: ANN401 - hands on
    """Call `smooth_dense`, imported only now."""
    from infill.phasefield.dense import smooth_dense

    return smooth_dense(*args, **options)


def _sparse(*args: Any, **options: Any) -> NDArray[np.floating]:  # noqa: ANN401 - hands on
    """Call `smooth_sparse`, imported only now."""
    from infill.phasefield.sparse import smooth_sparse

    return smooth_sparse(*args, **options)


KERNELS: dict[str, Kernel] = {
    "numpy": smooth_reference,
    "inplace": smooth_inplace,
    "dense": _dense,
    "sparse": _sparse,
}


def smooth(
    f: ArrayLike,
    smoothing: Smoothing = Smoothing(),  # noqa: B008 - frozen
    *,
    spacing: float | tuple[float, ...] = 1.0,
    initial: ArrayLike | None = None,
    mask: ArrayLike | None = None,
    method: Method = "auto",
) -> NDArray[np.floating]:
    """Return the phase field after smoothing by the modified Allen-Cahn equation.

    Parameters
    ----------
    f : (...) array in [-1, 1], or bool
        The data, in any number of dimensions: +1 solid, -1 void, grey between; for booleans, True is
        solid. The fidelity term pulls the result towards the data, which are not changed.
    smoothing : Smoothing
        Steps, fidelity, interface width and time step, in units of cells.
    spacing : float or one float per axis
        Cell size. Only the ratios matter: axes are weighted by (h_min / h_axis)^2.
    initial : (...) array in [-1, 1], optional
        The field to start from; by default, the data.
    mask : (...) bool, optional
        The domain. No flux crosses its boundary; cells outside keep their initial values.
    method : {"auto", "numpy", "inplace", "dense", "sparse"}
        "numpy" is the specification in float64; the others work in float32 and agree with it to 2e-5.
        "inplace" needs no compiler. "dense" and "sparse" take up to three axes; they are compiled when
        first used, which takes a few seconds and is reported to the log "infill", and kept on disk. "sparse"
        leaves out cells at rest, and its result is bit-identical to that of "dense". "auto" chooses "inplace"
        for two axes and for little work; in three axes, for more than 2e8 cells times steps, it chooses "sparse"
        for whole numbers and booleans and "dense" for grey data.

    Returns
    -------
    (...) float64 for "numpy", else float32

    Raises
    ------
    ParameterError
        For data outside [-1, 1], shapes that differ, or a time step above the stability limit.

    Notes
    -----
    Source: Wang et al. 2020, Eqs. (3)-(14); zero Neumann at every edge. Walls thinner than three cells
    get even thinner and vanish: see `Smoothing`.

    >>> smooth(np.ones((3, 3)), Smoothing(steps=4)).tolist()[0]
    [1.0, 1.0, 1.0]
    """
    if method != "auto" and method not in KERNELS:
        raise UsageError.about("method", f"is {method!r}; choose from auto, {', '.join(KERNELS)}")
    if method in COMPILED and np.ndim(f) > COMPILED_AXES:
        raise ParameterError(f"method {method!r} takes up to {COMPILED_AXES} axes, not {np.ndim(f)}; choose inplace")
    field = as_phase_field(f)
    start = None if initial is None else as_phase_field(initial, "the initial field")
    domain = None if mask is None else np.asarray(mask)
    for name, array in (("the initial field", start), ("the mask", domain)):
        if array is not None and array.shape != field.shape:
            raise ParameterError.about(name, f"has the shape {array.shape}, the data {field.shape}; give equal shapes")
    if domain is not None and domain.dtype != bool:
        raise ParameterError(f"the mask is of type {domain.dtype}; give booleans")
    chosen = _choose_kernel(np.asarray(f), smoothing) if method == "auto" else method
    if chosen not in COMPILED:
        return KERNELS[chosen](field, smoothing, spacing=spacing, initial=start, mask=domain)
    from infill.kernels.compiling import log_compilation

    with log_compilation("the smoother"):
        return KERNELS[chosen](field, smoothing, spacing=spacing, initial=start, mask=domain)


def _choose_kernel(f: NDArray[np.generic], smoothing: Smoothing) -> str:
    """Choose the kernel for the method "auto"."""
    if f.ndim != COMPILED_AXES or f.size * smoothing.steps < WORTH_COMPILING:
        return "inplace"
    return "dense" if f.dtype.kind == "f" else "sparse"
