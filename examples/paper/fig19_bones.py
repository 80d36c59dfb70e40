"""Fig. 19: mandible, foot and skull from points on their surface, by the narrow volume, smoothed for 30 steps.

python -m examples.paper.fig19_bones [folder] [--small]
"""

import time
from contextlib import suppress
from pathlib import Path

import numpy as np
import trimesh

from benchmarks.peers.meshers import surface_nets
from examples.paper import models, plots
from examples.paper.entry import NOT_GIVEN, PICTURE_ONLY, Entry, Row, run
from infill import Smoothing, smooth_points
from infill.meshes.distance import distances
from infill.smoothing.comparing import subsample

STEPS, WIDTH = 30, 5  # voxels


def main(folder: Path, *, small: bool = False) -> Entry:
    """Scatter points over each bone and smooth the shell around them."""
    cells, count = (50, 20_000) if small else (180, 250_000)
    names = ("mandible",) if small else ("mandible", "foot", "skull")
    figure, axes = plots.panels(3, len(names))
    rows, numbers, closed_up, spreads = [], {}, {}, {}
    for name, line in zip(names, axes, strict=True):
        bone = models.surface(name)
        points, _ = trimesh.sample.sample_surface(bone.to_trimesh(), count, seed=19)
        voxel = float(np.ptp(bone.vertices, axis=0).max()) / cells
        shell = {"voxel": voxel, "shell": WIDTH * voxel, "allow_broken": True, "tolerance": None}
        result = smooth_points(points, smoothing=Smoothing(steps=STEPS), method="plain", **shell)
        refined = smooth_points(points, refine=True, **shell)
        report, raw, counts = result.report, result.stages.staircase(), result.report["topology"]
        surfaces = {"data": raw, "ours": result.surface, "refined": refined.surface}
        off = {which: distances(subsample(surface.vertices), bone) / voxel for which, surface in surfaces.items()}
        data = result.stages.data
        with suppress(ModuleNotFoundError):
            surface_nets(np.ones((2, 2, 2)))  # loads
            begin = time.perf_counter()
            nets = surface_nets(np.where(data.values, 1.0, -1.0))
            netted = time.perf_counter() - begin
            middle = np.array(data.origin) + np.array(data.values.shape) * voxel / 2
            off["nets"] = distances(subsample(nets.vertices) * voxel + middle, bone) / voxel
        unit = "mm" if name != "skull" else ""  # of which the unit is not known
        titles = (f"{name}: narrow volume", f"{STEPS} steps")
        plots.show_solids(line[:2], [raw, result.surface], titles, unit=unit)
        phi = result.stages.levelled.field.to_dense() - np.float32(result.stages.levelled.height)
        axis = int(np.argmin(data.values.shape[:2]))
        flat = [np.take(field, field.shape[axis] // 2, axis=axis) for field in (phi, np.where(data.values, 1.0, -1.0))]
        corner = [data.origin[i] for i in range(3) if i != axis]
        names_of_axes = tuple("xyz".replace("xyz"[axis], ""))
        plots.show_smoothed(
            line[2],
            *flat,
            "slice through the middle",
            h=voxel,
            origin=corner,
            unit=unit,
            names=names_of_axes,
            label="surface",
        )
        spread = {which: float(np.sqrt(np.mean((each - WIDTH / 2) ** 2))) for which, each in off.items()}
        spreads[name] = spread
        rows += [
            Row(
                what=f"{name}: distance from the bone less half the width, rms, voxels",
                ours=f"{spread['ours']:.3f} (voxels {spread['data']:.3f}); refined {spread['refined']:.3f}",
                peer=f"surface nets (VTK) {spread['nets']:.3f}" if "nets" in spread else "VTK is not installed",
            ),
            Row(
                what=f"{name}: components, cavities, tunnels; volume, change",
                paper=PICTURE_ONLY,
                ours="{components}, {cavities}, {tunnels} ".format(**counts["result"])
                + "(data {components}, {cavities}, {tunnels}); ".format(**counts["data"])
                + f"{report['volume_change']:+.4%}",
            ),
            Row(
                what=f"{name}: triangles, seconds",
                ours=f"{report['triangles']:,}, {report['seconds']['total']:.1f} with all checks",
                peer=f"surface nets (VTK) {len(nets.faces):,}, {netted:.1f}" if "nets" in spread else NOT_GIVEN,
            ),
        ]
        closed_up[name] = sum(counts["data"][each] - counts["result"][each] for each in ("cavities", "tunnels"))
        numbers[f"{name} median"] = float(np.median(np.abs(off["ours"] - WIDTH / 2)))
        numbers |= {f"{name} rms, refined": spread["refined"]}
        numbers |= {f"{name} rms": spread["ours"], f"{name} volume change": report["volume_change"]}
        numbers |= {f"{name} closed": float(report["closed"]), f"{name} problems": len(report["problems"])}
    plots.legend(figure, axes[0, 2])
    plots.save(figure, folder / "fig19.png")
    closed = all(numbers[f"{name} closed"] for name in names)
    broken = [name for name in names if numbers[f"{name} problems"]]
    lost = f"What broke in {', '.join(broken)} is told as an error" if broken else "No wall broke"
    voids = ", ".join(f"{count} in the {name}" for name, count in closed_up.items())
    told = [
        f"{label} {min(values):.2f} to {max(values):.2f}"
        for which, label in (
            ("ours", "plain"),
            ("refined", "refined"),
            ("nets", "surface nets"),
            ("data", "the voxels"),
        )
        if (values := [spreads[name][which] for name in names if which in spreads[name]])
    ]
    return Entry(
        name="fig19",
        title="Fig. 19: bones from surface points",
        setting=(
            f"{count:,} points scattered evenly over each model, {cells} voxels along the longest side, shell of "
            f"{WIDTH} voxels (the paper's width is not at hand), {STEPS} steps, level of the volume. The paper's "
            "scans are not published."
        ),
        rows=tuple(rows),
        sentence=(
            f"{'All are closed' if closed else 'NOT all are closed'} and keep their volume, but {STEPS} steps move a "
            f"shell of {WIDTH} voxels: its distance from half the width is {', '.join(told)} voxels rms. {lost}; of "
            f"the voids and tunnels between sheets {voids} closed up."
        ),
        numbers=numbers,
    ).save(folder)


if __name__ == "__main__":
    run(main)
