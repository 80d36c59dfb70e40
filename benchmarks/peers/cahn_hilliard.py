"""The smoother of Choi, Jeong, Lee, Kim and Kim 2017, which the paper compares itself with.

    phi_t = Laplace(phi^3 - phi - eps^2 Laplace(phi)) + lam (f - phi)

Source: Choi et al., "Curve and surface smoothing using a modified Cahn-Hilliard equation", Mathematical Problems in
Engineering 2017, 5971295. It says of its scheme that the splitting is linearly stable and the space Fourier spectral.
We read that as Eyre's: with phi^3 - phi = (phi^3 - 3 phi) + 2 phi, the first part is explicit, all the rest implicit,

    (1 + dt (2 k^2 + eps^2 k^4 + lam)) phi_new = phi - dt k^2 F(phi^3 - 3 phi) + dt lam f,

on a periodic box. Lengths are in cells: dt / h^2, eps / h and lam h^2.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import fft


@dataclass(frozen=True, kw_only=True)
class CahnHilliard:
    """How strongly to smooth.

    Parameters
    ----------
    steps : int
    dt : float
        Time step over h².
    fidelity : float
        lam h².
    eps : float
        eps over h. The defaults are dt = 0.01, lam = 1e4, eps = h at h = 0.01.
    """

    steps: int = 10
    dt: float = 100.0
    fidelity: float = 1.0
    eps: float = 1.0


def smooth(
    f: NDArray[Any], settings: CahnHilliard = CahnHilliard(), *, kind: type = np.float32, threads: int = -1
) -> NDArray[Any]:
    """Return phi after all steps, in the precision `kind`.

    Parameters
    ----------
    f : (...) array in [-1, 1]
    threads : int
        Of the transforms; -1 for as many as there are cores.
    """
    data = np.asarray(f, dtype=kind)
    axes = tuple(range(data.ndim))
    squared = wave_numbers(data.shape).astype(kind)
    scale = kind(1) / (1 + kind(settings.dt) * (squared * (2 + kind(settings.eps**2) * squared) + settings.fidelity))
    across = kind(settings.dt) * squared * scale
    phi, spectrum = data, fft.rfftn(data, workers=threads)
    held = spectrum * kind(settings.dt * settings.fidelity) * scale
    for _ in range(settings.steps):
        spectrum = spectrum * scale - across * fft.rfftn(phi * (phi * phi - 3), workers=threads) + held
        phi = fft.irfftn(spectrum, s=data.shape, axes=axes, workers=threads)
    return phi


def wave_numbers(shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return k² of the half spectrum of real data, in 1 / cells²."""
    parts = [2 * np.pi * (fft.rfftfreq(n) if i == len(shape) - 1 else fft.fftfreq(n)) for i, n in enumerate(shape)]
    total = np.zeros([1] * len(shape))
    for i, part in enumerate(parts):
        total = total + (part**2).reshape([-1 if i == j else 1 for j in range(len(shape))])
    return total
