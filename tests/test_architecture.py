"""Rooms and arrows: who may import whom. The checker reads files below any root, so that tests can break a copy."""

from __future__ import annotations

import ast
import dataclasses
import importlib
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[1]
LARGEST = 2**20  # bytes of a tracked file

# From the ground up. A module imports from lower rows and from its own room; rooms of one row never meet.
ROWS: tuple[tuple[str, ...], ...] = (
    ("patterns", "hall"),
    ("files", "kernels", "reports"),
    ("phasefield",),
    ("meshes", "contours", "paths"),
    ("isosurfaces", "partition", "imaging", "drawings"),
    ("formats", "voxels", "gcode"),
    ("planner", "inspection", "interior", "lazy", "chunks"),
    ("pictures", "options", "drains", "viewer"),
    ("result",),
    ("smoothing", "lattices", "refilling", "projects", "slicer_profiles", "samples", "timing", "verifying"),
    ("making",),
    ("studio", "tool_server"),
    ("cli", "hosts"),
)
FLOOR = {room: floor for floor, rooms in enumerate(ROWS) for room in rooms}
HALL = {
    "version",
    "errors",
    "plain_numbers",
    "arrays",
    "checks",
    "machine",
    "ragged",
    "graph",
    "pixels",
    "grid",
    "volume",
    "surface",
    "drawing",
}
MOST_FLOORS = 13

# Packages of others that only some may import: a room, or one module.
KEPT = {
    "numba": "infill.kernels",
    "llvmlite": "infill.kernels",
    "SimpleITK": "infill.imaging.medical",
    "DracoPy": "infill.formats.gltf_reader",
    "pydicom": "infill.imaging.dicom",
    "typer": "infill.cli",
    "zarr": "infill.lazy",
    "h5py": "infill.lazy",
    "distributed": "infill.chunks",
    "dask": "infill.chunks",
    "starlette": "infill.studio",
    "uvicorn": "infill.studio",
    "mcp": "infill.tool_server",
    "mcp_types": "infill.tool_server",
    "anyio": "infill.tool_server",
    "rich": "infill.cli",
    "pyvista": "infill.hosts",
    "napari": "infill.hosts",
    "magicgui": "infill.hosts",
}
PATTERNS_TAKE = {"numpy", "shapely"}
ANNOUNCED: set[str] = set()  # public functions that are to come
# Of os, of named tuples and of notebooks: documented, so public.
UNDERSCORED = {"_exit", "_replace", "_asdict", "_fields", "_make", "_repr_png_", "_repr_html_"}
HEAVY = {"trimesh", "skimage", "scipy", "manifold3d", "numba", "PIL", "shapely", "numpy", "rich.progress"}


# --- reading ---------------------------------------------------------------------------------------------


@dataclass(frozen=True, kw_only=True)
class Import:
    """One name that a module imports, wherever it stands: at the top, in a function, under TYPE_CHECKING."""

    module: str
    name: str | None = None  # None for `import module`

    @property
    def package(self) -> str:
        return self.module.split(".")[0]

    @property
    def ours(self) -> bool:
        return self.package in ("infill", "patterns")


@dataclass(frozen=True, kw_only=True)
class Module:
    """One file: `infill/formats/stl.py` is called infill.formats.stl, and a room by its folder."""

    name: str
    nodes: tuple[ast.AST, ...]

    @cached_property
    def imports(self) -> tuple[Import, ...]:
        found = []
        for node in self.nodes:
            if isinstance(node, ast.Import):
                found += [Import(module=alias.name) for alias in node.names]
            elif isinstance(node, ast.ImportFrom):
                module = "." * node.level + (node.module or "")
                found += [Import(module=module, name=alias.name) for alias in node.names]
        return tuple(found)


@cache
def nodes_of(text: str) -> tuple[ast.AST, ...]:
    return tuple(ast.walk(ast.parse(text)))


@cache
def module_of(name: str, text: str) -> Module:
    return Module(name=name, nodes=nodes_of(text))


def read(path: Path, name: str) -> Module:
    return module_of(name, path.read_text(encoding="utf-8"))


def modules(root: Path) -> dict[str, Module]:
    """Return every module of both packages below a root, by name."""
    found = {}
    for package in ("infill", "patterns"):
        for path in sorted((root / package).rglob("*.py")):
            parts = path.relative_to(root).with_suffix("").parts
            name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
            found[name] = read(path, name)
    return found


def room_of(name: str) -> str | None:
    """Return the room of a module, "front" for `infill` itself, and None where there is no such room."""
    package, *rest = name.split(".")
    if package == "patterns":
        return "patterns"
    if not rest or rest == ["__main__"]:
        return "front"
    if len(rest) == 1 and rest[0] in HALL:
        return "hall"
    return rest[0] if rest[0] in FLOOR and rest[0] not in ("hall", "patterns") else None


def targets(module: Module, known: dict[str, Module]) -> set[str]:
    """Return the modules of ours that a module imports; `from infill.kernels import sparse` imports a module."""
    found = set()
    for each in module.imports:
        if each.ours:
            inner = f"{each.module}.{each.name}"
            found.add(inner if inner in known else each.module)
    return found


# --- the rules: each returns what breaks it, as "file -> what" --------------------------------------------


def strangers(root: Path) -> set[str]:
    """Modules in no room, and imports of what is not there."""
    known = modules(root)
    found = {f"{name}: in no room" for name in known if room_of(name) is None}
    for name, module in known.items():
        found |= {f"{name} -> {target}: no such module" for target in targets(module, known) - set(known)}
        found |= {f"{name} -> {each.module}: relative" for each in module.imports if each.module.startswith(".")}
    return found


def arrows_up_or_across(root: Path) -> set[str]:
    """Imports from a higher row, from another room of the same row, and through the front door."""
    known = modules(root)
    found = set()
    for name, module in known.items():
        room = room_of(name)
        if room in (None, "front"):
            continue
        for target in targets(module, known):
            other = room_of(target)
            if other == "front":
                found.add(f"{name} -> infill: through the front door")
            elif other not in (None, room) and FLOOR[other] > FLOOR[room]:
                found.add(f"{name} -> {target}: up, from {room} to {other}")
            elif other not in (None, room) and FLOOR[other] == FLOOR[room]:
                found.add(f"{name} -> {target}: across, from {room} to {other}")
    return found


def circles(root: Path) -> set[str]:
    """Modules of a room that come back to themselves, each circle named once; beyond a room it takes an arrow up."""
    known = modules(root)
    graph = {
        name: {target for target in targets(module, known) & set(known) if room_of(target) == room_of(name)}
        for name, module in known.items()
    }
    reached = {name: reachable(name, graph) for name in graph}
    rings = {frozenset(other for other in reached[name] if name in reached[other]) for name in graph}
    return {f"circle: {' -> '.join(sorted(ring))}" for ring in rings if ring}


def reachable(start: str, graph: dict[str, set[str]]) -> set[str]:
    """Return what can be reached along one arrow or more."""
    found: set[str] = set()
    left = list(graph[start])
    while left:
        name = left.pop()
        if name not in found:
            found.add(name)
            left.extend(graph[name])
    return found


def packages_outside_their_room(root: Path) -> set[str]:
    found = set()
    for name, module in modules(root).items():
        for each in module.imports:
            home = KEPT.get(each.package)
            if home and not f"{name}.".startswith(f"{home}."):
                found.add(f"{name} -> {each.package}: only {home} imports it")
            known = each.ours or each.package in sys.stdlib_module_names | PATTERNS_TAKE
            if room_of(name) == "patterns" and not known:
                found.add(f"{name} -> {each.package}: patterns take numpy, shapely and the standard library")
    return found


def is_private(name: str) -> bool:
    return name.startswith("_") and not name.endswith("__") and name not in UNDERSCORED


def private_names(module: Module) -> set[str]:
    """Private names that a file takes from another: imported, or asked of something that is not its own."""
    own, asked, found = set(), set(), set()
    for node in module.nodes:
        if isinstance(node, ast.ImportFrom):
            names = [*(node.module or "").split("."), *(alias.name for alias in node.names)]
            found |= {name for name in names if is_private(name)}
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            own.add(node.name)
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            own.add(node.id)
        elif isinstance(node, ast.Attribute):
            (asked if isinstance(node.ctx, ast.Load) else own).add(node.attr)
    found |= {name for name in asked - own if is_private(name)}
    return {f"{module.name} -> {name}: private" for name in found}


def private_names_that_travel(root: Path) -> set[str]:
    return {each for module in modules(root).values() for each in private_names(module)}


def public_names(root: Path) -> set[str]:
    """Return `__all__` of both packages, and what is announced."""
    found = set(ANNOUNCED)
    for package in ("infill", "patterns"):
        for node in modules(root)[package].nodes:
            if isinstance(node, ast.Assign) and [ast.unparse(target) for target in node.targets] == ["__all__"]:
                found |= set(ast.literal_eval(node.value))
    return found


def shadows(root: Path) -> set[str]:
    """Rooms and modules with the name of something public: once imported, `infill.smooth` would be the module."""
    public = public_names(root)
    return {f"{name}: has the name of a public function" for name in modules(root) if name.split(".")[-1] in public}


RULES = (
    strangers,
    arrows_up_or_across,
    circles,
    packages_outside_their_room,
    private_names_that_travel,
    shadows,
)


def rooms(root: Path) -> dict[str, set[str]]:
    """Return the rooms that each room imports from; the front door left out."""
    known = modules(root)
    found: dict[str, set[str]] = {}
    for name, module in known.items():
        room = room_of(name)
        if room not in (None, "front"):
            others = {room_of(target) for target in targets(module, known)} - {room, None, "front"}
            found.setdefault(room, set()).update(others)
    return found


def floors(graph: dict[str, set[str]]) -> int:
    """Return how many rooms stand on one another: the longest path, counted in rooms; raise ValueError for a circle."""
    in_circles = sorted(room for room in graph if room in reachable(room, graph))
    if in_circles:
        raise ValueError(f"rooms that import from each other stand on no floor: {', '.join(in_circles)}")

    @cache
    def height(room: str) -> int:
        return 1 + max((height(other) for other in graph[room]), default=0)

    return max(height(room) for room in graph)


# --- the house as it stands --------------------------------------------------------------------------------


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.__name__)
def test_the_house_keeps_the_rule(rule: object) -> None:
    assert rule(ROOT) == set(), (
        "docs/architecture.md has the rows of rooms; move the code down, or pass it what it needs"
    )


@pytest.mark.longest
def test_the_house_is_low(capsys: pytest.CaptureFixture[str]) -> None:
    graph = rooms(ROOT)
    with capsys.disabled():
        arrows = sum(len(others) for others in graph.values())
        print(f"\n{len(graph)} rooms on {floors(graph)} floors, {arrows} arrows")
    assert floors(graph) <= len(ROWS) <= MOST_FLOORS


def large_files(root: Path) -> list[str]:
    """Name the tracked files of a repository that are larger than `LARGEST`."""
    names = subprocess.run(["git", "ls-files", "-z"], cwd=root, capture_output=True, check=True, text=True).stdout
    paths = [root / name for name in names.split("\0") if name]
    assert paths
    return [path.name for path in paths if path.is_file() and path.stat().st_size > LARGEST]


def test_no_large_file_is_tracked(tmp_path: Path) -> None:
    """Results of a run, such as arrays, are no sources; what is planted is found."""
    if not (ROOT / ".git").exists():
        pytest.skip("this is no clone")
    assert large_files(ROOT) == []
    subprocess.run(["git", "init", "-q"], cwd=tmp_path, check=True)
    (tmp_path / "result.npz").write_bytes(bytes(LARGEST + 1))
    subprocess.run(["git", "add", "."], cwd=tmp_path, check=True)
    assert large_files(tmp_path) == ["result.npz"]


@pytest.mark.parametrize("folder", ["tests", "benchmarks", "examples"])
def test_no_private_name_comes_into_a_test(folder: str) -> None:
    paths = sorted((ROOT / folder).rglob("*.py"))
    assert paths
    found = {each for path in paths for each in private_names(read(path, path.stem))}
    assert found == set()


# --- one import put the wrong way ----------------------------------------------------------------------------

WRONG = {
    "up": (
        "infill/surface.py",
        "from infill.meshes.merging import surface_of",
        "infill.surface -> infill.meshes.merging: up, from hall to meshes",
    ),
    "a module of a room above": (
        "infill/phasefield/inplace.py",
        "from infill.isosurfaces import marching",
        "infill.phasefield.inplace -> infill.isosurfaces.marching: up, from phasefield to isosurfaces",
    ),
    "lazily": (
        "infill/formats/stl.py",
        "def f():\n    import infill.cli.words",
        "infill.formats.stl -> infill.cli.words: up, from formats to cli",
    ),
    "for types only": (
        "infill/result.py",
        "if TYPE_CHECKING:\n    from infill.making.request import Block",
        "infill.result -> infill.making.request: up, from result to making",
    ),
    "across": (
        "infill/voxels/from_mesh.py",
        "from infill.formats.stl import read_stl",
        "infill.voxels.from_mesh -> infill.formats.stl: across, from voxels to formats",
    ),
    "patterns to the hall": (
        "patterns/linework.py",
        "from infill.errors import InfillError",
        "patterns.linework -> infill.errors: across, from patterns to hall",
    ),
    "the hall to patterns": (
        "infill/grid.py",
        "from patterns.protocol import Pattern",
        "infill.grid -> patterns.protocol: across, from hall to patterns",
    ),
    "through the front door": (
        "infill/making/block.py",
        "from infill import save",
        "infill.making.block -> infill: through the front door",
    ),
    "relatively": (
        "infill/formats/obj.py",
        "from .rows import write_rows",
        "infill.formats.obj -> .rows: relative",
    ),
    "in a circle": (
        "infill/meshes/merging.py",
        "def f():\n    from infill.meshes.split_components import split",
        "circle: infill.meshes.merging -> infill.meshes.split_components",
    ),
    "numba": (
        "infill/phasefield/dense.py",
        "def f():\n    from numba.core import event",
        "infill.phasefield.dense -> numba: only infill.kernels imports it",
    ),
    "SimpleITK": (
        "infill/imaging/volume_files.py",
        "import SimpleITK",
        "infill.imaging.volume_files -> SimpleITK: only infill.imaging.medical imports it",
    ),
    "a terminal": (
        "infill/making/settings.py",
        "import rich.console",
        "infill.making.settings -> rich: only infill.cli imports it",
    ),
    "scipy for patterns": (
        "patterns/zigzag.py",
        "def f():\n    import scipy.spatial",
        "patterns.zigzag -> scipy: patterns take numpy, shapely and the standard library",
    ),
    "a private name": (
        "infill/pictures/picture_files.py",
        "from infill.pictures.render import _shade",
        "infill.pictures.picture_files -> _shade: private",
    ),
    "a private name of a module": (
        "infill/pictures/picture_files.py",
        "import infill.pictures.render as r\nr._shade()",
        "infill.pictures.picture_files -> _shade: private",
    ),
    "a module smooth": (
        "infill/phasefield/smooth.py",
        "",
        "infill.phasefield.smooth: has the name of a public function",
    ),
    "a module fill": (
        "infill/making/fill.py",
        "",
        "infill.making.fill: has the name of a public function",
    ),
    "a module in no room": ("infill/helpers.py", "", "infill.helpers: in no room"),
    "an unknown room": ("infill/utils/strings.py", "", "infill.utils.strings: in no room"),
    "from nowhere": (
        "infill/checks.py",
        "from infill.limits import LARGEST",
        "infill.checks -> infill.limits: no such module",
    ),
}


def broken(root: Path) -> set[str]:
    return {each for rule in RULES for each in rule(root)}


@pytest.fixture(scope="module")
def beforehand() -> set[str]:
    return broken(ROOT)


@pytest.fixture(scope="module")
def house(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = tmp_path_factory.mktemp("house")
    for package in ("infill", "patterns"):
        shutil.copytree(ROOT / package, root / package, ignore=shutil.ignore_patterns("__pycache__"))
    return root


@pytest.mark.longest
@pytest.mark.parametrize("kind", WRONG)
def test_one_wrong_import_is_named(kind: str, house: Path, beforehand: set[str]) -> None:
    """The file and the arrow, and nothing else."""
    where, text, says = WRONG[kind]
    path = house / where
    before = path.read_text(encoding="utf-8") if path.exists() else None
    path.parent.mkdir(exist_ok=True)
    try:
        path.write_text(f"{before or ''}\n{text}\n", encoding="utf-8")
        assert broken(house) - beforehand == {says}
    finally:
        path.unlink() if before is None else path.write_text(before, encoding="utf-8")


def test_floors_are_counted_along_the_longest_way() -> None:
    assert floors({"a": set()}) == 1
    assert floors({"a": {"b", "c"}, "b": {"c"}, "c": {"d"}, "d": set()}) == 4
    with pytest.raises(ValueError, match="each other stand on no floor: b, c$"):
        floors({"a": {"b"}, "b": {"c"}, "c": {"b"}})


# --- heavy imports wait, public names are found --------------------------------------------------------------


def modules_after(code: str) -> set[str]:
    done = subprocess.run(
        [sys.executable, "-c", f"{code}\nimport sys; print(*sys.modules)"],
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    return set(done.stdout.split())


@pytest.mark.slow
def test_help_loads_nothing_heavy() -> None:
    assert not HEAVY & modules_after("import infill.cli.app; infill.cli.app.build_app()")


@pytest.mark.slow
def test_the_help_of_make_loads_no_pattern() -> None:
    """However many there are."""
    code = "import sys; sys.argv = ['infill', 'make', '--help']; import infill.cli; infill.cli.main()"
    loaded = modules_after(code)
    assert "patterns.errors" in loaded
    assert not {"patterns.catalogue", "patterns.honeycomb", "numpy", "shapely"} & loaded


@pytest.mark.slow
def test_make_needs_neither_a_compiler_nor_trimesh(tmp_path: Path) -> None:
    code = f"from infill import make; make('honeycomb', size=20, height=2).save({str(tmp_path / 'x.stl')!r})"
    assert not {"numba", "llvmlite", "trimesh", "manifold3d", "PIL"} & modules_after(code)


@pytest.mark.slow
def test_smoothing_without_a_choice_loads_no_compiler() -> None:
    code = "import numpy as np; from infill import smooth; smooth(np.ones((9, 9))); smooth(np.ones((5, 5, 5)))"
    assert not {"numba", "llvmlite", "scipy"} & modules_after(code)


@pytest.mark.longest
def test_the_command_smooths_without_linear_algebra_and_leaves_it_to_others(tmp_path: Path) -> None:
    """Kernels multiply no matrices; whoever asks for SciPy's linear algebra afterwards finds it."""
    source, target = tmp_path / "box.npy", tmp_path / "box.stl"
    np.save(source, np.pad(np.ones((20, 20, 20), dtype=bool), 4))
    words = ["infill", "smooth", str(source), "-o", str(target), "--force", "--smooth", "plain", "--tolerance", "0"]
    code = (
        f"import sys, contextlib; sys.argv = {words!r}\nimport infill.cli\n"
        "with contextlib.suppress(SystemExit), contextlib.redirect_stdout(sys.stderr): infill.cli.program()"
    )
    brought = modules_after(
        "import scipy.ndimage"
    )  # which looks for far places; of SciPy 1.18, it loads linear algebra
    assert "scipy.linalg" not in modules_after(code) - brought
    assert "scipy.linalg.cython_blas" in modules_after(f"{code}\nimport scipy.linalg.cython_blas")


@pytest.mark.longest
def test_a_library_leaves_numba_as_it_is() -> None:
    """Somebody else's compiled functions may multiply matrices."""
    product = "import infill.kernels.sparse, numba, numpy as np; numba.njit(lambda a: a @ a)(np.eye(2))"
    called = (
        "import sys, contextlib, infill.cli; sys.argv = ['infill', '--version']\nwith contextlib.suppress(SystemExit), "
    )
    for code in (product, f"{called}contextlib.redirect_stdout(sys.stderr): infill.cli.main()\n{product}"):
        assert "scipy.linalg.cython_blas" in modules_after(code)


def test_every_public_name_is_found() -> None:
    import infill
    import patterns

    for package in (infill, patterns):
        for name in package.__all__:
            assert getattr(package, name) is not None
    assert set(infill.__all__) <= set(dir(infill))
    with pytest.raises(AttributeError, match="nonsense"):
        _ = infill.nonsense


# Lists of numbers for the report, which nothing changes.
LISTS = {"SolidMeasures"}


def mutable_fields(module: ModuleType) -> list[str]:
    """Return the fields of frozen dataclasses of a module that hold lists, dicts or sets, which can change."""
    return [
        f"{kind.__name__}.{field.name}"
        for kind in vars(module).values()
        if dataclasses.is_dataclass(kind)
        and kind.__module__ == module.__name__
        and kind.__dataclass_params__.frozen
        and kind.__name__ not in LISTS
        for field in dataclasses.fields(kind)
        if re.search(r"\b(list|dict|set|defaultdict)\b", str(field.type).split("Option(")[0])
    ]


@pytest.mark.parametrize("name", sorted(path.stem for path in (ROOT / "infill" / "lattices").glob("[a-z]*.py")))
def test_no_frozen_value_of_fill_can_change(name: str) -> None:
    """What is drawn in a space belongs to the one who draws it, not to the description of the pattern."""
    assert not mutable_fields(importlib.import_module(f"infill.lattices.{name}"))


def test_a_field_that_can_change_is_named() -> None:
    module = ModuleType("some")

    @dataclass(frozen=True)
    class Cache:
        known: dict[int, float] = dataclasses.field(default_factory=dict)

    Cache.__module__ = "some"
    module.Cache = Cache  # type: ignore[attr-defined]
    assert mutable_fields(module) == ["Cache.known"]


def test_the_walks_lead_through_functions_that_exist() -> None:
    """`python tools/walk.py` writes the page again."""
    page = (ROOT / "docs" / "design" / "walks.md").read_text(encoding="utf-8")
    steps = re.findall(r"`((?:infill|patterns)/[\w/]+)\.(?:\w+\.)?(\w+)`", page)
    assert len(steps) > 100
    names = {
        file: set(re.findall(r"def (\w+)", (ROOT / f"{file}.py").read_text(encoding="utf-8"))) for file, _ in steps
    }
    assert [f"{file}.{name}" for file, name in steps if name not in names[file]] == []
