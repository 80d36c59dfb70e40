"""Write the recipe of conda-forge for a release: `python tools/write_conda_recipe.py dist/phasefill-0.1.0.tar.gz`.

The recipe is printed, in conda-forge's format of version 1. Requirements are those of pyproject.toml, so that nobody
keeps two lists; the hash is that of the source archive.
"""

from __future__ import annotations

import hashlib
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
RECIPE = """\
schema_version: 1

context:
  version: "{version}"
  python_min: "{python}"

package:
  name: {name}
  version: ${{{{ version }}}}

source:
  url: https://pypi.org/packages/source/{initial}/{name}/{name}-${{{{ version }}}}.tar.gz
  sha256: {digest}

build:
  number: 0
  noarch: python
  script: ${{{{ PYTHON }}}} -m pip install . -vv --no-deps --no-build-isolation
  python:
    entry_points:
{scripts}

requirements:
  host:
    - python ${{{{ python_min }}}}.*
    - pip
{build}
  run:
    - python >=${{{{ python_min }}}}
{run}

tests:
  - python:
      imports:
        - infill
        - patterns
      pip_check: true
      python_version:
        - ${{{{ python_min }}}}.*
        - "*"
  - script:
      - infill --version
      - infill make honeycomb --size 20x20 --height 2 -o honeycomb.stl

about:
  summary: {summary}
  license: {license}
  license_file: LICENSE
  homepage: {homepage}
  documentation: {documentation}
  repository: {repository}

extra:
  recipe-maintainers:
    - phasefill
"""


def listed(lines: list[str]) -> str:
    """Return requirements as items of a list, with a space before the version, as conda has them."""
    return "\n".join(f"    - {line.replace('>=', ' >=')}" for line in lines)


def conda_recipe(version: str, digest: str) -> str:
    """Return the recipe of a version, whose source archive has a SHA-256."""
    with (ROOT / "pyproject.toml").open("rb") as file:
        settings = tomllib.load(file)
    project = settings["project"]
    return RECIPE.format(
        version=version,
        name=project["name"],
        initial=project["name"][0],
        digest=digest,
        python=project["requires-python"].removeprefix(">="),
        scripts="\n".join(f"      - {name} = {target}" for name, target in project["scripts"].items()),
        build=listed(settings["build-system"]["requires"]),
        run=listed(project["dependencies"]),
        summary=project["description"],
        license=project["license"],
        homepage=project["urls"]["Homepage"],
        documentation=project["urls"]["Documentation"],
        repository=project["urls"]["Source"],
    )


def main() -> None:
    """Print the recipe for the source archive that is named."""
    if len(sys.argv) != 2 or not sys.argv[1].endswith(".tar.gz"):
        sys.exit("error: the source archive is needed: python tools/write_conda_recipe.py dist/phasefill-0.1.0.tar.gz")
    archive = Path(sys.argv[1])
    version = archive.name.removesuffix(".tar.gz").partition("-")[2]
    print(conda_recipe(version, hashlib.sha256(archive.read_bytes()).hexdigest()), end="")


if __name__ == "__main__":
    main()
