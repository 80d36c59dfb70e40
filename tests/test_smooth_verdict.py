"""The verdict on hard inputs, its words, and the advice in messages, which is run and works.

The shapes have the traits of scans on which verdicts were too weak: vessels of one to three voxels, noise, thin plates
with holes, spikes thinner than a voxel.
"""

from __future__ import annotations

import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import trimesh
from made_shapes import box, speckled, spiked, together, turned, union, vessels, wing
from numpy.typing import NDArray

from infill import GeometryError, Smoothing, Surface, smooth_mesh, smooth_volume
from infill.inspection.deviation import ChangedPatch, Deviation, SurfaceGap
from infill.pictures.before_and_after import MarkedSurface, describe_areas
from infill.smoothing import meshes
from infill.voxels import from_mesh

pytestmark = pytest.mark.usefixtures("compiled", "silent_compiler")

NOTHING = SurfaceGap(mean=0.0, rms=0.0, p95=0.0, max=0.0, at=(0.0, 0.0, 0.0))


def surface_of(mesh: Any) -> Surface:
    return Surface(vertices=np.asarray(mesh.vertices, dtype=np.float64), faces=np.asarray(mesh.faces))


def deviation(areas: list[float], *, whole: float, cell: float = 1.0, far: float = 3.0) -> Deviation:
    """A deviation of which these areas are missing, as far away as that."""
    lost = tuple(ChangedPatch(at=(1.0, 2.0, 3.0), area=area, distance=far) for area in areas)
    back = SurfaceGap(mean=0.1, rms=0.2, p95=0.3, max=far, at=(1.0, 2.0, 3.0))
    return Deviation(
        there=NOTHING,
        back=back,
        added=(),
        lost=lost,
        thin=(),
        thin_distance=0.0,
        sheet=0.0,
        hidden=0.0,
        given_area=whole,
        result_area=whole,
        cell=cell,
    )


# --- verdicts --------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("areas", "whole", "word"),
    [
        ([4.0], 1e6, "lost"),  # a face of two cells by two, in one place
        ([3.9], 1e6, "changed a little"),
        ([3.0] * 6, 359, "lost"),  # a twentieth of the surface, in small places
        ([3.0] * 6, 361, "changed a little"),
        ([3.0] * 5, 60, "changed a little"),  # a quarter of a tiny surface, and less than 16 cells²
    ],
)
@pytest.mark.parametrize("cell", [1.0, 0.1])
def test_what_is_lost_is_a_size_and_a_share(areas: list[float], whole: float, word: str, cell: float) -> None:
    scaled = [area * cell**2 for area in areas]
    assert deviation(scaled, whole=whole * cell**2, cell=cell, far=3 * cell).word == word


def test_specks_that_make_up_the_volume_are_lost_and_the_advice_works(rng: np.random.Generator) -> None:
    """Vessels of one to three voxels among specks of one: a fifth of the volume is not "changed a little"."""
    solid = speckled(vessels(36, rng) < 0, 0.006, rng)
    with pytest.raises(
        GeometryError, match=r"the volume is \d+\.\d% too small.*walls or gaps one voxel thick"
    ) as caught:
        smooth_volume(solid, tolerance=None)
    advice = re.search(
        r"give --despeckle (\S+), which takes out (\d+) specks, or give --allow-broken", str(caught.value)
    )
    assert advice
    assert "finer" not in str(caught.value)
    report = smooth_volume(solid, despeckle=float(advice[1]), tolerance=None).report
    assert report["verdict"]["word"] != "lost"
    assert report["input"]["despeckled"] == int(advice[2])
    assert any(change.startswith(f"{advice[2]} specks of up to 27 mm³") for change in report["verdict"]["changes"])
    assert smooth_volume(solid, allow_broken=True, tolerance=None).report["verdict"]["word"] == "lost"


def test_noise_is_no_loss_and_is_called_noise(rng: np.random.Generator) -> None:
    solid = ((np.indices((44, 44, 44)) - 21.5) ** 2).sum(axis=0) < 15**2
    verdict = smooth_volume(speckled(solid, 0.08, rng), tolerance=None).report["verdict"]
    assert verdict["word"] == "changed a little"
    (noise,) = [change for change in verdict["changes"] if change.startswith("noise")]
    assert re.fullmatch(r"noise, up to 3 voxels thick, is gone, [\d,]+ mm² \(\d+%\) of the surface of the input", noise)
    assert "one voxel thick" not in "; ".join(verdict["changes"])


@pytest.mark.slow
def test_a_plate_that_becomes_a_sieve_is_lost_and_the_advice_works() -> None:
    """Eight holes that become many, and with finer voxels eight again."""
    plate = surface_of(turned(wing(0.9), np.random.default_rng(2)))
    with pytest.raises(GeometryError, match=r"\d+ pinholes broke through walls, beside 8 holes") as caught:
        smooth_mesh(plate, voxel=1.0, tolerance=None)
    assert str(caught.value).count("holes") == 2  # one sentence says it
    advice = re.search(r"give --voxel (\S+), or give --allow-broken", str(caught.value))
    assert advice
    report = smooth_mesh(plate, voxel=float(advice[1]), tolerance=None).report
    assert report["topology"]["result"]["tunnels"] == 8
    assert report["verdict"]["word"] != "lost"


@pytest.mark.longest
def test_a_plate_that_would_become_a_sieve_gets_finer_voxels(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (meshes, from_mesh):
        monkeypatch.setattr(module, "RESOLUTION", 50)
    report = smooth_mesh(surface_of(turned(wing(0.9), np.random.default_rng(2))), tolerance=None).report
    assert report["verdict"]["tried"][0] == "refine"
    assert report["verdict"]["taken"] in ("75 voxels", "100 voxels", "150 voxels")
    assert report["topology"]["result"]["tunnels"] == 8


# --- words -----------------------------------------------------------------------------------------------


def test_one_sentence_says_how_much_is_missing_and_how_far() -> None:
    few, many, tip = (deviation(areas, whole=400.0, far=4.1) for areas in ([5.884], [5.0, 0.9], [0.0]))
    assert few.phrases == ("5.88 mm² of the input (1.5%) is missing, up to 4.1 mm away, at (1, 2, 3)",)
    assert many.phrases == ("5.9 mm² of the input (1.5%) is missing in 2 places, up to 4.1 mm away, at (1, 2, 3)",)
    assert tip.phrases == ("a tip of the input is missing, up to 4.1 mm away, at (1, 2, 3)",)
    near = deviation([], whole=400.0, far=1.6)
    assert near.phrases == ("the surface moved by up to 1.6 mm, at (1, 2, 3)",)
    tiny = deviation([177e-6], whole=0.4, far=0.000991, cell=0.0001)  # beside a place in mm
    assert tiny.phrases == ("0.000177 mm² of the input (under 0.1%) is missing, up to 0.000991 mm away, at (1, 2, 3)",)
    thin = replace(near, thin=many.lost, thin_distance=4.1)
    assert thin.phrases == ("the rest of the surface moved by up to 1.6 mm, at (1, 2, 3)",)


def test_large_and_small_numbers_have_no_exponent() -> None:
    for size in (1e5, 1e-4):
        areas, whole = [4321.0 * size**2] * 3, 9e6 * size**2
        (phrase,) = deviation(areas, whole=whole, cell=size, far=5012.0 * size).phrases
        assert not re.search(r"\de[+-]?\d", phrase)


def test_the_picture_has_the_areas_of_the_verdict(rng: np.random.Generator) -> None:
    solid = speckled(vessels(36, rng) < 0, 0.006, rng)
    result = smooth_volume(solid, allow_broken=True, tolerance=None)
    verdict = result.report["verdict"]
    data, far = result.stages.staircase(), verdict["far"]
    assert far == 2.0
    lost, added = (
        MarkedSurface(surface=one, other=other, far=far, colour=(0, 0, 0))
        for one, other in ((data, result.surface), (result.surface, data))
    )
    assert lost.area == pytest.approx(verdict["missing"] + verdict["thin"], rel=0.02)
    caption, _ = describe_areas(lost, added, verdict)
    numbers = re.findall(r"[\d.,]*\d", caption)
    assert len(numbers) == 2
    assert all(f"{number} mm²" in "; ".join(verdict["changes"]) for number in numbers)
    assert describe_areas(lost, added, {"word": "lost"})[0].endswith(" mm²")  # of components: as it is drawn


# --- advice ----------------------------------------------------------------------------------------------


def slab() -> NDArray[np.bool_]:
    """A plate one voxel thick between two blocks."""
    solid = np.zeros((60, 30, 30), dtype=bool)
    solid[4:16, 6:24, 6:24] = solid[44:56, 6:24, 6:24] = solid[16:44, 6:24, 14] = True
    return solid


def test_more_fidelity_is_advised_where_it_helps() -> None:
    with pytest.raises(GeometryError, match=r"give --fidelity 1, or give --allow-broken to have it anyway$"):
        smooth_volume(slab(), method="plain", smoothing=Smoothing(steps=60), tolerance=None)
    held = smooth_volume(slab(), method="plain", smoothing=Smoothing(steps=60, fidelity=1.0), tolerance=None).report
    assert held["verdict"]["word"] != "lost"


def test_nothing_is_advised_that_does_not_help() -> None:
    """A fin of a fiftieth of a voxel: three times as many voxels lose it, too."""
    fin = union(box(30, 12, 8), box(0.02, 12, 12, (0, 0, 8)))
    with pytest.raises(GeometryError, match=r"is missing, up to [\d.]+ mm away, at \([^()]*\); give --allow-broken to"):
        smooth_mesh(surface_of(turned(fin, np.random.default_rng(2))), voxel=1.0, tolerance=None)


def test_strict_is_advised_against() -> None:
    with pytest.raises(GeometryError, match="leave out --strict, so that other ways are tried, or give --allow-broken"):
        smooth_volume(slab(), method="plain", smoothing=Smoothing(steps=60), strict=True, tolerance=None)
    assert smooth_volume(slab(), smoothing=Smoothing(steps=60), tolerance=None).report["verdict"]["word"] != "lost"


# --- crumbs ----------------------------------------------------------------------------------------------


def test_spikes_leave_no_crumbs_beside_a_small_body() -> None:
    """A body of some voxels in the file does not keep what broke off the spikes of another."""
    mesh = together(turned(spiked(), np.random.default_rng(2)), box(2, 2, 2, (60, 3, 2)))
    result = smooth_mesh(surface_of(mesh), voxel=1.0, allow_broken=True, tolerance=None)
    assert sorted(np.abs([piece.volume for piece in result.mesh.split()]) > 3) == [True, True]
    assert result.report["verdict"]["crumbs"]["removed"] > 10
    kept = smooth_mesh(surface_of(mesh), voxel=1.0, allow_broken=True, crumbs=0.0, tolerance=None)
    assert len(kept.mesh.split(only_watertight=False)) > 10


def test_a_noisy_scan_of_vessels_leaves_no_dust() -> None:
    """No piece, and no cavity, of an eighth of a voxel."""
    rng = np.random.default_rng(0)
    grey = 200 * np.clip(0.5 - vessels(28, rng), 0, 1) + rng.normal(0, 34, (28,) * 3)
    options: dict[str, Any] = {"threshold": "otsu", "allow_broken": True, "tolerance": None}
    result, whole = smooth_volume(grey, **options), smooth_volume(grey, crumbs=0.0, **options)
    volumes, all_volumes = (
        np.array([piece.volume for piece in each.mesh.split(only_watertight=False)]) for each in (result, whole)
    )
    assert (np.abs(all_volumes) <= 1 / 8).sum() > 5
    assert not (np.abs(volumes) <= 1 / 8).any()
    assert result.report["verdict"]["crumbs"]["removed"] == len(all_volumes) - len(volumes)


def test_what_is_left_of_a_vanished_speck_is_a_crumb_and_a_small_part_that_stays_is_none() -> None:
    solid = np.zeros((48, 30, 30), dtype=bool)
    solid[4:16, 6:24, 6:24] = True
    line, cube = solid.copy(), solid.copy()
    line[30, 14, 10:17] = cube[30:32, 14:16, 14:16] = True
    steps = Smoothing(steps=4)
    kept = smooth_volume(line, smoothing=steps, crumbs=0.0, tolerance=None).report
    assert (kept["components"], kept["verdict"]["crumbs"]["removed"]) == (2, 0)
    cleaned = smooth_volume(line, smoothing=steps, tolerance=None).report
    assert (cleaned["components"], cleaned["verdict"]["crumbs"]["removed"]) == (1, 1)
    assert "1 crumb of up to 8 voxels taken out" in cleaned["verdict"]["changes"]
    small = smooth_volume(cube, smoothing=steps, tolerance=None).report
    assert (small["components"], small["verdict"]["word"]) == (2, "kept")


def test_bodies_that_become_one_get_the_hint_that_keeps_them_apart() -> None:
    """Two boxes that neither touch nor overlap, nearer to one another than a voxel."""
    pair = surface_of(together(box(8, 8, 8), box(8, 8, 8, (8.3, 0, 0))))
    (change,) = [
        c for c in smooth_mesh(pair, voxel=1.0, tolerance=None).report["verdict"]["changes"] if "components" in c
    ]
    assert change == "the mesh has 2 components, the result 1; --by-component keeps them apart"
    assert len(smooth_mesh(pair, voxel=1.0, by_component=True, tolerance=None).surfaces) == 2


@pytest.mark.longest
def test_larger_voxels_are_recommended_for_a_noisy_mask_if_they_help() -> None:
    """One voxel in a hundred is wrong: too little for a noisy scan, and too much to be kept."""
    ball = ((np.indices((60, 60, 60)) - 29.5) ** 2).sum(axis=0) < 20**2
    mask = ball ^ (np.random.default_rng(0).random(ball.shape) < 0.01)
    with pytest.raises(GeometryError, match="; give --voxel 2, or give --allow-broken to have it anyway"):
        smooth_volume(mask)
    report = smooth_volume(mask, voxel=2.0).report
    assert report["verdict"]["word"] != "lost"
    assert report["volume"] == pytest.approx(ball.sum(), rel=0.05)


def test_bodies_that_become_one_are_named_first() -> None:
    """Balls that run together while they are smoothed: before what else changed, such as crumbs and slits."""
    balls = together(*(trimesh.creation.icosphere(3, 5.0).apply_translation((10.1 * k, 0, 0)) for k in range(3)))
    report = smooth_mesh(surface_of(balls), voxel=1.0, tolerance=None).report
    changes = report["verdict"]["changes"]
    assert report["changes"]["fused"]
    assert len(changes) > 1
    assert changes[0] == "the mesh has 3 components, the result 1; --by-component keeps them apart"


def test_strict_refuses_a_scan_whose_tunnels_close() -> None:
    plate = np.zeros((40, 40, 16), dtype=bool)
    plate[6:34, 6:34, 5:11] = True
    plate[19:21, 19:21] = plate[10:12, 10:12] = False
    with pytest.raises(GeometryError, match="2 of 2 tunnels are gone; leave out --strict"):
        smooth_volume(plate, strict=True)
    assert "2 of 2 tunnels are gone" in smooth_volume(plate).report["verdict"]["changes"]
