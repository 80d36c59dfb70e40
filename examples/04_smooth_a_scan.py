"""A scan of grey values in, a smooth and closed mesh out, in the scan's own millimetres.

python examples/04_smooth_a_scan.py [folder]
"""

import sys
from pathlib import Path

import numpy as np

from infill import Smoothing, Volume, smooth_volume


def bone() -> Volume:
    """Return a stand-in for a CT: a hollow shaft in Hounsfield units, its slices thicker than its pixels."""
    spacing = (0.5, 0.5, 1.25)
    x, y, z = (h * (np.arange(n) - n / 2 + 0.5) for h, n in zip(spacing, (80, 80, 40), strict=True))
    radius = np.hypot(x[:, None, None], y[:, None]) - 0.003 * z**2
    wall = 3 - np.abs(radius - 11)  # 6 mm of bone around the marrow
    values = np.where(np.abs(z) < 20, np.clip(1000 * wall, -100, 900), -100)
    return Volume(values=values.astype(np.int16), spacing=spacing, origin=(-20, 130, 40), space="LPS")


def main(folder: Path) -> float:
    """Write the bone and return its volume in mm³."""
    scan = bone()  # or: infill.read_volume("scan.nrrd"), or a folder of DICOM
    result = smooth_volume(scan, threshold=300, smoothing=Smoothing(steps=30))
    result.save(folder / "bone.stl")
    print({name: result.report[name] for name in ("volume_change", "topology", "walls", "distance")})
    return result.report["volume"]


if __name__ == "__main__":
    print(f"{main(Path(sys.argv[1] if len(sys.argv) > 1 else '.')):.1f} mm³")
