"""What the files around the package promise agrees: versions, floors, workflows, citation, forms."""

from __future__ import annotations

import datetime
import doctest
import importlib.metadata
import importlib.util
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml

import infill
from patterns import linework

ROOT = Path(__file__).resolve().parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
REPOSITORY = "https://github.com/phasefill/phasefill"
# What a run needs no floor for: it is newest wherever it is installed.
TOOLS = ("bench", "docs", "lint", "release")


def text(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def workflow(path: Path) -> dict[str, Any]:
    """Return a workflow; YAML 1.1 takes its key `on` for a truth."""
    found = yaml.safe_load(path.read_text(encoding="utf-8"))
    return {"on" if key is True else key: value for key, value in found.items()}


def floors(*extras: str) -> dict[str, str]:
    """Return the lowest version of every dependency, and of those of some extras."""
    project = PROJECT["project"]
    found: dict[str, str] = {}
    for line in project["dependencies"] + [line for name in extras for line in project["optional-dependencies"][name]]:
        name, floor = re.fullmatch(r"([\w.-]+)>=([\w.]+)", line).groups()  # None, if there is no floor
        assert found.setdefault(name, floor) == floor, f"{name} has two floors"
    return found


# --- dependencies ----------------------------------------------------------------------------------------


def test_every_dependency_has_a_floor() -> None:
    assert len(floors(*PROJECT["project"]["optional-dependencies"])) > 20


def test_the_oldest_dependencies_are_the_floors() -> None:
    lines = [line for line in text("constraints/oldest.txt").splitlines() if line and not line.startswith("#")]
    pinned = dict(line.split("==") for line in lines)
    extras = [name for name in PROJECT["project"]["optional-dependencies"] if name not in TOOLS]
    assert pinned == floors(*extras)
    assert list(pinned) == sorted(pinned, key=str.lower)


# --- workflows -------------------------------------------------------------------------------------------


def test_every_python_that_is_promised_is_tested() -> None:
    classifiers = PROJECT["project"]["classifiers"]
    promised = {found[1] for line in classifiers if (found := re.fullmatch(r".*Python :: (3\.\d+)", line))}
    jobs = workflow(ROOT / ".github" / "workflows" / "test.yml")["jobs"]
    matrix = jobs["test"]["strategy"]["matrix"]
    tested = {str(version) for version in matrix["python"]}
    assert promised
    assert promised <= tested
    lowest = min(tested, key=lambda version: int(version.split(".")[1]))
    assert PROJECT["project"]["requires-python"] == f">={lowest}"
    assert PROJECT["tool"]["ruff"]["target-version"] == f"py{lowest.replace('.', '')}"
    assert {system["os"].split("-")[0] for system in matrix["include"]} == {"macos", "windows"}
    assert jobs["oldest"]["steps"][1]["with"]["python-version"] == lowest


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_workflow_may_no_more_than_it_must(path: Path) -> None:
    found = workflow(path)
    assert found["permissions"] in ({}, {"contents": "read"})
    for name, job in found["jobs"].items():
        assert job["timeout-minutes"] <= 60, name
        allowed = {"publish": {"id-token"}, "build": {"id-token", "attestations"}}.get(name, set())
        assert {scope for scope, level in job.get("permissions", {}).items() if level == "write"} <= allowed, name
        for step in job["steps"]:
            assert "uses" not in step or re.search(r"@[0-9a-f]{40}$", step["uses"]), step
            if step.get("uses", "").startswith("actions/checkout"):
                assert step["with"]["persist-credentials"] is False
            assert "github.event" not in step.get("run", ""), "what strangers write must not reach a shell"


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.stem)
def test_a_pinned_commit_says_its_version(path: Path) -> None:
    pins = re.findall(r"uses: \S+@[0-9a-f]{40}(.*)", path.read_text(encoding="utf-8"))
    assert len(pins) >= 5
    assert all(re.fullmatch(r" # v\d+\.\d+\.\d+", comment) for comment in pins)


def test_workflows_run_what_there_is() -> None:
    targets = set(re.findall(r"^([a-z]+):", text("Makefile") + text("tools/slicers.mk") + text("tools/page.mk"), re.M))
    for path in WORKFLOWS:
        for job in workflow(path)["jobs"].values():
            for step in job["steps"]:
                run = step.get("run", "")
                assert set(run.split()[1:]) <= targets or not run.startswith("make "), run
                for script in re.findall(r"tools/\w+\.py", run):
                    assert (ROOT / script).is_file()


def test_only_a_tag_publishes() -> None:
    release = workflow(ROOT / ".github" / "workflows" / "release.yml")
    assert release["on"] == {"push": {"tags": ["v*"]}}
    publish = release["jobs"]["publish"]
    assert publish["environment"] == "release"
    assert publish["permissions"] == {"id-token": "write"}
    assert publish["needs"] == "build"


@pytest.mark.slow
def test_the_schemas_hold() -> None:
    """`make lint` does the same; here it is shown that it can fail."""
    pytest.importorskip("check_jsonschema")
    command = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", "vendor.github-workflows"]
    assert subprocess.run([*command, *WORKFLOWS], capture_output=True).returncode == 0
    wrong = subprocess.run([*command, ROOT / ".github" / "dependabot.yml"], capture_output=True)
    assert wrong.returncode == 1


# --- what is said of the project -------------------------------------------------------------------------


def test_the_version_is_one() -> None:
    assert importlib.metadata.version("phasefill") == infill.__version__
    assert yaml.safe_load(text("CITATION.cff"))["version"] == infill.__version__


def test_the_changelog_tells_of_the_version_or_that_it_is_not_released() -> None:
    heads = re.findall(r"^## (.*)$", text("CHANGELOG.md"), re.M)
    assert heads[0] == "[Unreleased]"
    released = [re.fullmatch(r"\[(\d+\.\d+\.\d+)\] - (\d{4}-\d\d-\d\d)", head).groups() for head in heads[1:]]
    dates = [datetime.date.fromisoformat(date) for _, date in released]
    assert dates == sorted(dates, reverse=True)
    if infill.__version__ not in dict(released):
        entry = text("CHANGELOG.md").split("## [Unreleased]")[1].split("\n## ")[0]
        assert f"{infill.__version__} will be" in entry, "say under Unreleased which version is being made"


def test_the_citation_is_of_the_project() -> None:
    citation = yaml.safe_load(text("CITATION.cff"))
    project = PROJECT["project"]
    assert citation["license"] == project["license"]
    assert citation["repository-code"] == project["urls"]["Source"] == REPOSITORY
    assert citation["url"] == project["urls"]["Documentation"]
    assert [author["name"] for author in citation["authors"]] == [author["name"] for author in project["authors"]]
    (paper,) = citation["references"]
    assert paper["title"].replace("-", "–") in " ".join(text("README.md").split())
    readme = " ".join(text("README.md").split())
    assert "Wang, Li, Choi, Lee and Kim" in readme
    assert [author["family-names"] for author in paper["authors"]] == ["Wang", "Li", "Choi", "Lee", "Kim"]
    assert f"{paper['journal']} {paper['volume']}, {paper['year']}" in readme


def test_the_owner_is_one() -> None:
    """Nobody is sent to another repository by a line that was forgotten."""
    pages = [*ROOT.glob("*.md"), *ROOT.glob("*.toml"), *ROOT.glob("docs/*.py"), *ROOT.glob(".github/**/*.*")]
    assert len(pages) > 10
    owners = {
        owner for page in pages for owner in re.findall(r"github\.com/([\w-]+/phasefill)\b", page.read_text("utf-8"))
    }
    assert owners == {"phasefill/phasefill"}


def test_what_a_newcomer_looks_for_is_there() -> None:
    for name in ("README.md", "LICENSE", "CONTRIBUTING.md", "SECURITY.md", "CODE_OF_CONDUCT.md", "CITATION.cff"):
        assert text(name)
    forms = list((ROOT / ".github" / "ISSUE_TEMPLATE").glob("*.yml"))
    assert len(forms) >= 2
    for form in forms:
        assert yaml.safe_load(form.read_text(encoding="utf-8"))


def test_the_readme_is_whole_away_from_the_repository() -> None:
    """What is done to the README for a package index leaves no relative picture or link."""
    shown = text("README.md")
    for rule in PROJECT["tool"]["hatch"]["metadata"]["hooks"]["fancy-pypi-readme"]["substitutions"]:
        shown = re.sub(rule["pattern"], rule["replacement"], shown)
    targets = re.findall(r"\]\(([^)\s]+)\)", shown)
    assert len([target for target in targets if target.endswith(".png")]) >= 5
    assert [target for target in targets if not target.startswith(("https://", "#"))] == []


def test_the_readme_warns_of_names_that_others_hold() -> None:
    assert "pip install phasefill" in text("README.md")
    assert re.search(r"`infill` and `patterns`.*not ours", " ".join(text("README.md").split()))


# --- the work on it --------------------------------------------------------------------------------------


def test_make_help_names_every_target() -> None:
    makefile = text("Makefile")
    (targets,) = re.findall(r"^\.PHONY: (.*)$", makefile, re.M)
    named = set(re.findall(r"^## make ([\w-]+)", makefile, re.M))
    assert named == set(targets.split()) - {"help"}


def test_the_tool_that_marks_slow_tests_does_what_it_says() -> None:
    spec = importlib.util.spec_from_file_location("mark_slow_tests", ROOT / "tools" / "mark_slow_tests.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    assert doctest.testmod(module) == (0, 3)


@pytest.mark.longest
def test_make_test_runs_one_case_of_each_long_test(pytester: pytest.Pytester) -> None:
    pytester.makeconftest((ROOT / "tests" / "conftest.py").read_text(encoding="utf-8"))
    pytester.makepyfile(
        """
        import pytest

        @pytest.mark.long
        @pytest.mark.parametrize("b", "xy")
        @pytest.mark.parametrize("a", [1, 2])
        def test_cases(a, b): ...

        @pytest.mark.longest
        def test_alone(): ...

        @pytest.mark.slow
        def test_slow(): ...

        def test_quick(): ...
        """
    )
    markers = ["-o", "markers=slow\nlong\nlongest\nleft_out", "-p", "no:cacheprovider", "-p", "no:randomly"]
    for chosen, count in (("not left_out", 3), ("not slow", 1), ("slow or not slow", 7)):
        result = pytester.runpytest_subprocess("-q", "-m", chosen, *markers)
        result.assert_outcomes(passed=count, deselected=7 - count)


def test_the_functions_of_the_exercise_exist() -> None:
    names = re.findall(r"`linework\.(\w+)", text("CONTRIBUTING.md"))
    assert len(names) >= 3
    assert [name for name in names if not hasattr(linework, name)] == []
