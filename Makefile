# Two commands on a fresh machine: `make demo` and `make test`. Python 3.11 or newer and a POSIX shell
# are all they need.
# Both make .venv once and are silent about what is already done.

PYTHON ?= python3
OLDEST_PYTHON ?= python3.11
DEMO ?= demo
DESIGNS = concentric-heart zigzag honeycomb

BIN = .venv/bin
HOSTS = slicer-core PySide6-Essentials pre-commit
HOST_PIP = .venv-hosts/bin/python -m pip --quiet --disable-pip-version-check
HOST_TESTS = installed.py pyvista.py napari.py 3d_slicer.py print_hosts.py orca_plugin.py repository_checks.py
BESIDE_THE_PACKAGE = tests examples docs pyproject.toml .pre-commit-hooks.yaml .github action.yml
NO_PLUGINS = -p no:napari -p no:napari-plugin-engine -p no:npe2
ISSUE_FORMS = $(filter-out %/config.yml,$(wildcard .github/ISSUE_TEMPLATE/*.yml))
SOURCES = $(shell find infill patterns -name '*.py')
WHEEL_SOURCES = $(shell find infill patterns -type f ! -name '*.pyc') examples/cura/InfillRefill.py README.md

## make demo      the three designs of the paper as STL, with a picture of each (the default)
## make test      the suite without its longest cases, in 5 minutes
## make longest   the cases that make test leaves out
## make coverage  the whole suite at once, with the share of lines that it reaches
## make quick     the suite without what is slow
## make oldest    the suite on the oldest dependencies that are allowed
## make hosts     the wheel in an environment of its own, with each program that it works in or with
## make fuzz      mutated files of every format, for an hour; FUZZ="--minutes 300 --only meshes" says how
## make lint      ruff, the words, the schemas of workflows, issue forms and CITATION.cff, and page/ where npm is
## make types     mypy --strict
## make docs      the site, in build/docs
## make check     what CI runs: lint, types, docs, test, longest
## make wheel     sdist and wheel in dist/, and the wheel tried alone
## make slicers   PrusaSlicer and CuraEngine, on Debian, for the tests that slice
## make browsers  chromium, on Debian, for the tests of the pages
## make page      the pages that the package brings, bundled anew from page/ (needs node and npm)
## make data      real meshes and scans for the tests, in data/
## make bench     the promised speeds
## make slicer-report  refill against the slicers, hours of slicing, and docs/slicer-report.md
## make smooth-report  what smooth does with real files, beside its peers, and docs/smooth-report.md
## make paper     the paper's figures and tables, and docs/paper.md
## make pictures  the pictures of README and docs
## make host-pictures  the pictures of the pages on PyVista and napari
## make gallery   the patterns that fill parts, and docs/gallery.md
## make clean     removes what these made

.DELETE_ON_ERROR:
FUZZ ?= --minutes 60
.PHONY: demo test longest coverage quick fuzz oldest hosts host-pictures lint types docs wheel check slicers browsers page data bench slicer-report smooth-report paper pictures gallery help clean

# Real meshes and scans for the tests: what `make data` fetched, unless a folder is named.
ifneq ($(wildcard data),)
export INFILL_DATA ?= $(CURDIR)/data
endif

demo: $(DESIGNS:%=$(DEMO)/%.stl) $(DESIGNS:%=$(DEMO)/%.png)
	@echo "The paper's three designs, with a picture of each:"
	@for design in $(DESIGNS); do echo "  $(CURDIR)/$(DEMO)/$$design.stl  $(CURDIR)/$(DEMO)/$$design.png"; done

# Both come from one run.
$(DEMO)/%.stl $(DEMO)/%.png: .venv/demo $(SOURCES)
	@mkdir -p $(DEMO)
	@$(BIN)/infill make $* -o $(DEMO)/$*.stl --preview $(DEMO)/$*.png --force

# Without the longest cases (see tests/conftest.py).
test: .venv/test
	@$(BIN)/python -m pytest -q -n 2 --dist worksteal -m "not left_out" -p no:cov

longest: .venv/test
	@$(BIN)/python -m pytest -q -n 2 --dist worksteal -m "left_out" -p no:cov

# Everything, counting the lines that it reaches, which takes twice as long.
coverage: .venv/test
	@$(BIN)/python -m pytest -q -n 2 --cov --cov-report=term:skip-covered --cov-fail-under=97

# What a change needs while it is being made: no coverage, no slicers, nothing slow (see tests/conftest.py).
quick: .venv/test
	@$(BIN)/python -m pytest -q -n auto -m "not slow" -p no:cov tests infill patterns

# Mutated files for every reader, in processes with limits; files that fail are kept in build/fuzz.
fuzz: .venv/test
	@$(BIN)/python -m tests.fuzzing $(FUZZ)

# The suite on the oldest dependencies that pyproject.toml allows; what they compile is not for other versions.
oldest: .venv-oldest/test
	@.venv-oldest/bin/python -m pip check
	@NUMBA_CACHE_DIR=$(CURDIR)/.venv-oldest/numba .venv-oldest/bin/python -m pytest -q -n 2

# In an environment of their own: they take 600 MB and more, and napari brings plug-ins of pytest. The tests run in a copy
# of the checkout that lacks the packages, so that what they import and start is the wheel.
hosts: export INFILL_DATA ?= $(abspath $(firstword $(wildcard data ../shared/data) data))
hosts: .venv-hosts/test
	@rm -rf build/hosts
	@mkdir -p build/hosts
	@cp -R $(BESIDE_THE_PACKAGE) build/hosts
	@cd build/hosts && $(CURDIR)/.venv-hosts/bin/python -m pytest -q -rs -n 2 --dist worksteal $(NO_PLUGINS) \
		$(HOST_TESTS:%=tests/test_%)

host-pictures: .venv-hosts/test
	@.venv-hosts/bin/python docs/host_pictures.py

lint: .venv/lint
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/codespell
	@$(BIN)/hadolint Dockerfile
	@$(BIN)/python tools/check_english.py
	@$(BIN)/check-jsonschema --quiet --builtin-schema vendor.github-workflows .github/workflows/*.yml
	@$(BIN)/check-jsonschema --quiet --builtin-schema vendor.github-workflows examples/github/models.yml
	@$(BIN)/check-jsonschema --quiet --builtin-schema vendor.github-actions action.yml
	@$(BIN)/check-jsonschema --quiet --builtin-schema vendor.dependabot .github/dependabot.yml
	@$(BIN)/check-jsonschema --quiet --builtin-schema vendor.github-issue-config .github/ISSUE_TEMPLATE/config.yml
	@$(BIN)/check-jsonschema --quiet --builtin-schema vendor.github-issue-forms $(ISSUE_FORMS)
	@$(BIN)/check-jsonschema --quiet --builtin-schema vendor.readthedocs .readthedocs.yaml
	@$(BIN)/check-jsonschema --quiet --builtin-schema vendor.citation-file-format CITATION.cff
	@$(MAKE) --no-print-directory lint-page

types: .venv/lint .venv/test
	@$(BIN)/mypy

# The site, in build/docs: pages, commands and the reference. A warning is an error.
docs: .venv/docs
	@$(BIN)/python -m sphinx -q -E -W --keep-going -b html docs build/docs
	@echo "$(CURDIR)/build/docs/index.html"

# What a release consists of, in dist, and whether the wheel works where there is nothing else.
wheel: .venv/release
	@$(BIN)/python tools/build_release.py dist
	@$(BIN)/twine check --strict dist/*
	@$(BIN)/python tools/try_wheel.py dist/*.whl

# What CI runs.
check: lint types docs test longest

# Real meshes and scans that tests and figures take, in data/ or $INFILL_DATA, each by its hash.
data: .venv/test
	@$(BIN)/python tools/fetch_data.py

bench: .venv/test
	@$(BIN)/python -m benchmarks.make
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[bench]'
	@$(BIN)/python -m benchmarks.smooth_speed
	@$(BIN)/python -m benchmarks.smooth_quality
	@$(BIN)/python -m benchmarks.smooth_files
	@$(BIN)/python -m benchmarks.simplify
	@$(BIN)/python -m benchmarks.smooth_points
	@$(BIN)/python -m benchmarks.fill_parts

# Refill in the real slicers, and docs/slicer-report.md: a night; what was run before is kept in build/slicer-report.json,
# and `ONLY=--stale` runs again what older code made. `ONLY=--quick` takes a quarter of an hour, `ONLY=--page` writes the
# page of what is there, and `ONLY='--deli PYTHON'` adds PrusaSlicer 2.9.
slicer-report: .venv/test
	@$(BIN)/python -m benchmarks.slicer_report $(ONLY)

# Smooth on real files, judged by others, and docs/smooth-report.md: a quarter of an hour. Results are kept in
# build/smooth-report.json; `make smooth-report ONLY="--only bunny"` makes some of them again,
# `ONLY="--command /path/to/infill"` those of another infill.
smooth-report: .venv/test
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[bench]'
	@$(BIN)/python -m benchmarks.smooth_data $(ONLY)
	@$(BIN)/python -m benchmarks.smooth_scans $(ONLY)
	@$(BIN)/python -m benchmarks.smooth_meshes $(ONLY)

# Every figure and table of the paper, and docs/paper.md: some minutes. Models are taken from $INFILL_DATA.
paper: .venv/test
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[bench]'
	@$(BIN)/python -m examples.paper

# The pictures of README and docs, made by the program itself.
pictures: .venv/test
	@$(BIN)/python docs/pictures.py

# The patterns that fill parts, with their stiffness.
gallery: .venv/test
	@$(BIN)/python docs/gallery.py

help:
	@sed -n 's/^## //p' Makefile

clean:
	@rm -rf .venv .venv-oldest .venv-hosts build dist $(DEMO) .slicers .coverage .pytest_cache .mypy_cache .ruff_cache .hypothesis page/node_modules

include tools/slicers.mk
include tools/page.mk

.venv/pip:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' \
		|| { echo "error: $(PYTHON) is too old; give Python 3.11 or newer: make PYTHON=python3.12 $(MAKECMDGOALS)" >&2; exit 1; }
	@$(PYTHON) -m venv .venv
	@touch $@

.venv/demo: .venv/pip pyproject.toml
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable .
	@touch $@

.venv/test: .venv/pip pyproject.toml
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[test]'
	@touch $@ .venv/demo

.venv/docs: .venv/pip pyproject.toml
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[docs]'
	@touch $@ .venv/demo

.venv/release: .venv/pip pyproject.toml
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[release]'
	@touch $@ .venv/demo

.venv-oldest/test: constraints/oldest.txt pyproject.toml
	@$(OLDEST_PYTHON) -m venv --clear .venv-oldest
	@.venv-oldest/bin/python -m pip install --quiet --disable-pip-version-check \
		--constraint constraints/oldest.txt --editable '.[test]'
	@touch $@

.venv-hosts/pip: pyproject.toml
	@$(PYTHON) -m venv --clear .venv-hosts
	@touch $@

# The wheel with the extras of those programs, what its users have beside it, and what tests need. A version that is
# installed already would be kept: hence the last line.
.venv-hosts/test: .venv-hosts/pip $(WHEEL_SOURCES)
	@rm -rf build/wheel
	@$(HOST_PIP) wheel --no-deps --wheel-dir build/wheel .
	@$(HOST_PIP) install "$$(echo build/wheel/*.whl)[mcp,napari,pyvista]" $(HOSTS) pytest pytest-xdist hypothesis PyYAML
	@$(HOST_PIP) install --no-deps --force-reinstall build/wheel/*.whl
	@touch $@

.venv/lint: .venv/pip pyproject.toml
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[lint]'
	@touch $@
