# Two commands on a fresh machine: `make demo` and `make test`. Python 3.11 or newer and a POSIX shell
# are all they need.
# Both make .venv once and are silent about what is already done.

PYTHON ?= python3
DEMO ?= demo
DESIGNS = concentric-heart zigzag honeycomb

BIN = .venv/bin
SOURCES = $(shell find infill patterns -name '*.py')

.DELETE_ON_ERROR:
.PHONY: demo test lint types check slicers bench paper pictures clean

demo: $(DESIGNS:%=$(DEMO)/%.stl) $(DESIGNS:%=$(DEMO)/%.png)
	@echo "The paper's three designs, with a picture of each:"
	@for design in $(DESIGNS); do echo "  $(CURDIR)/$(DEMO)/$$design.stl  $(CURDIR)/$(DEMO)/$$design.png"; done

# Both come from one run.
$(DEMO)/%.stl $(DEMO)/%.png: .venv/demo $(SOURCES)
	@mkdir -p $(DEMO)
	@$(BIN)/infill make $* -o $(DEMO)/$*.stl --preview $(DEMO)/$*.png --force

test: .venv/test
	@$(BIN)/python -m pytest -q -n 2 --cov --cov-report=term:skip-covered --cov-fail-under=95

lint: .venv/lint
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .

types: .venv/lint .venv/test
	@$(BIN)/mypy

# What CI runs.
check: lint types test

bench: .venv/test
	@$(BIN)/python -m benchmarks.make
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[bench]'
	@$(BIN)/python -m benchmarks.smooth_speed
	@$(BIN)/python -m benchmarks.smooth_quality
	@$(BIN)/python -m benchmarks.smooth_files

# Every figure and table of the paper, and docs/paper.md: some minutes. Models are taken from $INFILL_DATA.
paper: .venv/test
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[bench]'
	@$(BIN)/python -m examples.paper

# The pictures of README and docs, made by the program itself.
pictures: .venv/test
	@$(BIN)/python docs/pictures.py

clean:
	@rm -rf .venv $(DEMO) .slicers .coverage .pytest_cache .mypy_cache .ruff_cache .hypothesis

include tools/slicers.mk

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

.venv/lint: .venv/pip pyproject.toml
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable '.[lint]'
	@touch $@
