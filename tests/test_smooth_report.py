"""The report on smoothing: its judge finds planted losses and no others, and its page holds together."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import numpy as np
import pytest
import trimesh

from benchmarks.smooth_page import marked
from benchmarks.smooth_runs import COMMAND, ROOT, command_of, environment, smoothed

PAGE = Path(__file__).parents[1] / "docs" / "smooth-report.md"
VOXEL = np.array([0.5, 0.5, 0.5])  # mm
SAMPLES = 20_000
FLAT = 0.02  # voxels: an icosphere of 20,480 faces lies so near to its sphere


def sphere(radius: float = 10.0, at: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> trimesh.Trimesh:
    mesh = trimesh.creation.icosphere(subdivisions=5, radius=radius)
    mesh.apply_translation(at)
    return mesh


def together(*meshes: trimesh.Trimesh) -> trimesh.Trimesh:
    return trimesh.util.concatenate(meshes)


def knobbed(length: float) -> trimesh.Trimesh:
    """A ball from which a knob of 2 mm across stands out by so much, as one surface."""
    knob = trimesh.creation.cylinder(radius=1.0, segment=[[0, 0, 8], [0, 0, 10 + length]])
    return trimesh.boolean.union([sphere(), knob], engine="manifold")


def cube(side: float, at: tuple[float, float, float] = (0.0, 0.0, 0.0)) -> trimesh.Trimesh:
    mesh = trimesh.creation.box(extents=(side, side, side))
    mesh.apply_translation(at)
    return mesh


class TestTheJudge:
    """Laws of the judge, on losses that are planted."""

    @pytest.fixture(autouse=True)
    def _vtk(self) -> None:
        pytest.importorskip("vtk", reason="VTK is not here: pip install 'phasefill[bench]'")

    def judge(self, given: trimesh.Trimesh, result: trimesh.Trimesh, voxel: np.ndarray = VOXEL):
        from benchmarks.smooth_judge import judge

        return judge(given, result, voxel, samples=SAMPLES)

    def test_of_what_is_kept_nothing_is_lost(self) -> None:
        found = self.judge(knobbed(3), knobbed(3))
        assert not found.lost
        assert found.input_to_result.largest == pytest.approx(0, abs=1e-6)
        assert found.result_to_input.largest == pytest.approx(0, abs=1e-6)
        assert found.volume == pytest.approx(0, abs=1e-9)
        assert (found.hidden, found.capped, found.patches) == (0, 0, ())
        assert found.closed == found.manifold == (True, True)
        assert (found.shells, found.tunnels) == ((1, 1), (0, 0))

    def test_a_knob_that_is_gone_is_found_where_it_was(self) -> None:
        found = self.judge(knobbed(3), sphere())
        assert found.lost
        assert found.patches[0].depth == pytest.approx(
            3 / 0.5, abs=0.2
        )  # the rim of its end is farther than the middle
        assert found.patches[0].at[2] == pytest.approx(13)
        assert found.result_to_input.largest < 1 / 0.5 + FLAT  # where it stood: no farther than its own radius

    def test_a_knob_smaller_than_one_part_in_a_thousand_is_found(self) -> None:
        """The percentile does not see it; the piece does."""
        needle = trimesh.creation.cylinder(radius=0.1, segment=[[0, 0, 9], [0, 0, 12]])
        found = self.judge(trimesh.boolean.union([sphere(), needle], engine="manifold"), sphere())
        assert found.input_to_result.p999 < 1.5
        assert found.lost

    def test_an_edge_that_is_rounded_by_less_than_is_counted_is_no_loss(self) -> None:
        found = self.judge(knobbed(0.5), sphere())  # 1 voxel high
        assert not found.lost
        assert found.input_to_result.largest > 0.9

    def test_a_surface_moved_by_two_voxels_is_found(self) -> None:
        found = self.judge(sphere(), sphere(11.0))
        assert found.lost
        assert found.input_to_result.mean == pytest.approx(2, abs=FLAT)
        assert found.result_to_input.mean == pytest.approx(2, abs=FLAT)
        assert found.volume == pytest.approx(1.1**3 - 1, rel=1e-6)

    def test_distances_are_in_voxels_along_each_axis(self) -> None:
        moved = sphere(at=(0.0, 0.0, 1.0))
        found = self.judge(sphere(), moved, np.array([0.5, 0.5, 2.0]))
        assert found.input_to_result.largest == pytest.approx(0.5, abs=FLAT)

    def test_a_body_inside_another_is_no_loss(self) -> None:
        given = together(sphere(), sphere(3.0))
        found = self.judge(given, sphere())
        assert not found.lost
        assert found.hidden == pytest.approx(9 / 109, abs=0.01)
        assert found.volume == pytest.approx(0, abs=2e-3)  # one point in each of 160³ cells

    def test_a_body_that_overlaps_counts_where_it_stands_out(self) -> None:
        given = together(sphere(), cube(8.0, (10.0, 0.0, 0.0)))
        united = trimesh.boolean.union([sphere(), cube(8.0, (10.0, 0.0, 0.0))], engine="manifold")
        kept, lost = self.judge(given, united), self.judge(given, sphere())
        assert not kept.lost
        assert kept.hidden > 0.05
        assert kept.volume == pytest.approx(0, abs=2e-3)
        assert lost.lost
        assert lost.volume < -0.05

    def test_a_cavity_is_no_body_inside_another(self) -> None:
        hole = sphere(3.0)
        hole.invert()
        given = together(sphere(), hole)
        assert self.judge(given, given).hidden == 0
        found = self.judge(given, sphere())
        assert found.lost
        assert found.patches[0].depth == pytest.approx(7 / 0.5, abs=0.5)

    def test_a_cap_over_an_open_border_is_told_apart(self) -> None:
        ball = sphere()
        given = trimesh.Trimesh(ball.vertices, ball.faces[ball.triangles_center[:, 2] < 6.0])
        found = self.judge(given, trimesh.intersections.slice_mesh_plane(ball, [0, 0, -1], [0, 0, 6], cap=True))
        assert found.capped == pytest.approx(8**2 / (2 * 10 * 16 + 8**2), abs=0.06)  # but for what is near the border
        assert found.result_to_input.largest < 1.6
        assert not found.lost
        assert found.volume is None
        assert found.closed == (False, True)

    def test_what_fuses_is_seen_in_the_topology(self) -> None:
        ring = trimesh.creation.torus(8.0, 2.0)
        found = self.judge(together(ring, sphere(1.0, (30.0, 0.0, 0.0))), ring)
        assert (found.shells, found.tunnels) == ((2, 1), (1, 1))
        assert found.lost

    def test_two_cubes_that_share_an_edge_are_no_manifold(self) -> None:
        from benchmarks.smooth_geometry import Topology

        given = together(cube(1.0), cube(1.0, (1.0, 1.0, 0.0)))
        given.merge_vertices()
        corner = together(cube(1.0), cube(1.0, (1.0, 1.0, 1.0)))
        corner.merge_vertices()
        assert not Topology(given).manifold
        assert Topology(corner).closed  # every edge has its two faces
        assert not Topology(corner).manifold  # and one vertex two fans
        assert Topology(cube(1.0)).manifold

    def test_what_is_compared_with_itself_is_at_no_distance(self) -> None:
        """The tables of scans and of noisy meshes, on a ball and on one that is moved."""
        from benchmarks.smooth_meshes import measured, roughened

        pair = roughened("ball", sphere(50.0), 0.0)
        still = measured(pair, pair.noisy)
        assert (still["mean"], still["angle"], still["volume"]) == pytest.approx((0, 0, 0), abs=1e-6)
        larger = pair.truth.copy()
        larger.apply_scale(1 + 2 * pair.edge / 50)
        away = measured(pair, larger)
        assert away["mean"] == pytest.approx(2, abs=0.01)
        assert away["angle"] < 0.5

    def test_our_peers_draw_a_ball_where_it_is(self) -> None:
        from benchmarks.peers.meshers import slicer, surface_nets
        from benchmarks.smooth_scans import Case, in_mm, measured
        from benchmarks.smooth_scenes import Image, isosurface

        spacing = np.array([1.5, 1.0, 0.8])  # mm, in z, y and x
        z, y, x = np.indices((21, 31, 39)) * spacing[:, None, None, None]
        ball = Image(1000 - 100 * np.sqrt((x - 15) ** 2 + (y - 15) ** 2 + (z - 15) ** 2), spacing)  # of 10 mm at 0
        case = Case("ball", ball, 0.0, ball, 0.0)
        truth = isosurface(ball, 0.0)
        exact = measured(case, truth, truth)
        assert exact["to_truth"] == exact["from_truth"] == pytest.approx([0, 0], abs=1e-6)
        assert exact["angle"] < 3  # of triangles of a millimetre and slopes of the same
        for mesher, limit in ((slicer, 0.1), (surface_nets, 0.35)):  # mm; surface nets shrink
            mesh = in_mm(mesher(np.where(case.solid.T, 1.0, -1.0)), ball)
            found = measured(case, truth, mesh)
            np.testing.assert_allclose(mesh.center_mass, 15, atol=0.05)
            assert max(found["to_truth"][0], found["from_truth"][0]) < limit
            assert exact["angle"] < found["angle"] < 10
            moved = trimesh.Trimesh(mesh.vertices + np.array([3, 0, 0]), mesh.faces)
            assert measured(case, truth, moved)["to_truth"][0] > 1

    def test_points_are_judged_from_the_points(self) -> None:
        from benchmarks.smooth_judge import judge_points

        points = sphere().vertices
        assert not judge_points(points, sphere(), VOXEL, samples=SAMPLES).lost
        outlier = np.vstack([points, sphere(0.3, (0.0, 0.0, 14.0)).vertices])
        assert judge_points(outlier, sphere(), VOXEL, samples=SAMPLES).lost


@pytest.mark.slow
def test_a_surface_winds_once_around_what_is_inside_it() -> None:
    from benchmarks.smooth_geometry import winding

    rng = np.random.default_rng(5)
    places = rng.uniform(-12, 12, size=(20_000, 3))
    places = places[np.abs(np.linalg.norm(places, axis=1) - 10) > 0.05]
    count = winding(sphere(), places)
    np.testing.assert_array_equal(count, np.linalg.norm(places, axis=1) < 10)
    np.testing.assert_array_equal(winding(together(sphere(), sphere()), places), 2 * count)
    turned = sphere()
    turned.invert()
    np.testing.assert_array_equal(winding(turned, places), -count)


def test_an_isosurface_lies_where_the_grey_values_say_and_ends_with_the_cells() -> None:
    from benchmarks.smooth_scenes import Image, isosurface

    spacing = np.array([2.0, 1.0, 0.5])  # z, y, x
    z, y, x = np.indices((11, 21, 41)) * spacing[:, None, None, None]
    radius = np.sqrt((x - 10) ** 2 + (y - 10) ** 2 + (z - 10) ** 2)
    ball = isosurface(Image(10 - radius, spacing), 4.0)  # of 6 mm
    assert ball.is_watertight
    assert ball.volume == pytest.approx(4 / 3 * np.pi * 6**3, rel=0.04)  # flat faces of cells of 2 mm
    np.testing.assert_allclose(np.linalg.norm(ball.vertices - 10, axis=1), 6, atol=0.15)
    full = isosurface(Image(np.full((3, 4, 5), 7), spacing), 3.0)
    np.testing.assert_allclose(full.bounds, [[-0.25, -0.5, -1.0], [2.25, 3.5, 5.0]])


def test_the_surface_of_a_mask_is_closed(rng: np.random.Generator) -> None:
    """Cells that touch at edges and corners only, in every way there is."""
    from benchmarks.smooth_geometry import Topology
    from benchmarks.smooth_scenes import Image, Scan, isosurface

    mask = Image(rng.integers(0, 2, size=(12, 13, 14)), np.ones(3))
    assert Topology(isosurface(mask, Scan("", "", None).level)).closed
    grey = Image(rng.integers(0, 4, size=(12, 13, 14)), np.ones(3))
    assert Topology(isosurface(grey, Scan("", "", 2).level)).closed


def test_noise_is_as_large_as_it_says() -> None:
    from benchmarks.smooth_meshes import SIZE, roughened

    pair = roughened("ball", sphere(3.0), 0.2)
    assert pair.truth.extents.max() == pytest.approx(SIZE)
    height = np.linalg.norm(pair.noisy.vertices, axis=1) - SIZE / 2
    assert height.std() == pytest.approx(0.2 * pair.edge, rel=0.03)  # of 10,242 vertices
    assert abs(height.mean()) < 0.01 * pair.edge


def test_wins_are_counted_where_all_can_be_compared() -> None:
    from benchmarks.smooth_scans import section

    def found(to: float, angle: float | None, volume: float) -> dict:
        return {"to_truth": [to, to], "from_truth": [to, to], "angle": angle, "volume": volume, "manifold": True}

    others = {"3D Slicer": found(1.0, 10.0, 0.1), "surface nets": found(2.0, 9.0, -0.01)}
    near, far = {"ours": found(0.5, 9.5, -0.05)}, {"ours": found(1.5, None, 0.001)}
    text = section({"one": near | others, "two": far | others}, "nothing")
    assert "(mean of both ways) in 1 of 2; best normals in 0 of 1; best volume in 1 of 2" in text


@pytest.mark.slow
def test_the_peak_of_a_process_is_not_that_of_the_one_that_starts_it(tmp_path: Path) -> None:
    """What was allocated here does not count for a command that takes next to nothing."""
    large = np.ones(2**26)  # 512 MiB, each page touched
    nothing = [sys.executable, "-S", "-c", "print('{}')"]
    done = smoothed(nothing, tmp_path / "in.stl", tmp_path / "out.stl")
    assert (done.status, done.message, done.report) == (0, "", {})
    assert 2**20 < done.memory < 2**27 < large.nbytes
    assert done.seconds < 30


def test_another_infill_is_not_mistaken_for_the_one_beside_the_report(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Neither the folder nor the path that this process has leads the command to the code here."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    telling = "import json, os, sys; print(json.dumps([os.getcwd(), os.environ.get('PYTHONPATH')]))"
    done = smoothed([sys.executable, "-S", "-c", telling], tmp_path / "in.stl", tmp_path / "out.stl")
    assert done.report == [str(tmp_path), None]
    assert environment(command_of(COMMAND))["PYTHONPATH"] == str(ROOT)
    assert command_of("bin/infill --x 'a b'") == [str(Path("bin/infill").absolute()), "--x", "a b"]
    assert command_of("infill")[0] == "infill"


def test_an_error_is_told_without_folders(tmp_path: Path) -> None:
    failing = [sys.executable, "-S", "-c", "import sys; sys.exit(f'error: {sys.argv[2]} is empty; give more')"]
    done = smoothed(failing, tmp_path / "in.stl", tmp_path / "out.stl")
    assert (done.status, done.message) == (1, "error: in.stl is empty; give more")
    assert os.sep not in done.message


def test_losses_that_are_not_told_are_counted() -> None:
    from benchmarks.smooth_data import unreported

    lost, kept = {"judged": {"lost": True}}, {"judged": {"lost": False}}
    assert unreported(lost | {"word": None})
    assert unreported(lost | {"word": "kept"})
    assert not unreported(lost | {"word": "lost"})
    assert not unreported(lost | {"word": "changed a little"})
    assert not unreported(kept | {"word": "kept"})
    assert not unreported({"status": 1})


def test_a_change_of_topology_is_counted_where_it_is_known() -> None:
    from benchmarks.smooth_data import retied

    def row(shells: list, tunnels: list, hidden: float = 0.0) -> dict:
        return {"judged": {"shells": shells, "tunnels": tunnels, "hidden": hidden}}

    assert retied(row([2, 1], [0, 0]))
    assert retied(row([1, 1], [3, 1]))
    assert not retied(row([1, 1], [3, 3]))
    assert not retied(row([2, 1], [0, 0], hidden=0.1))  # one body inside another
    assert not retied(row([None, 1], [None, 0]))
    assert not retied({"status": 1})


def test_sections_are_put_between_their_markers_and_nowhere_else() -> None:
    page = "head\n<!-- a: begin -->\nold\n<!-- a: end -->\n<!-- b: begin -->\n<!-- b: end -->\ntail\n"
    once = marked(page, "a", "new")
    assert once == marked(once, "a", "new")
    assert "old" not in once
    assert once.startswith("head\n")
    assert once.endswith("<!-- b: begin -->\n<!-- b: end -->\ntail\n")
    with pytest.raises(ValueError, match="once each"):
        marked(page, "c", "new")
    with pytest.raises(ValueError, match="once each"):
        marked(page + page, "a", "new")


def test_the_page_has_every_table() -> None:
    page = PAGE.read_text(encoding="utf-8")
    for name in ("data", "scans", "meshes"):
        assert marked(page, name, "x")
        section = page.partition(f"<!-- {name}: begin -->")[2].partition(f"<!-- {name}: end -->")[0]
        rows = [line for line in section.splitlines() if line.startswith("|")]
        assert len(rows) > 8
        assert "Made with" in section
    assert "/tmp" not in page
    assert "/work" not in page
