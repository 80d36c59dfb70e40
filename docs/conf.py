"""The site: `make docs` builds it into build/docs, without a network and without a warning.

The reference follows `infill.__all__` and `patterns.__all__`, so it needs no line here when a name or a module moves.
"""

from __future__ import annotations

import datetime
import importlib
import inspect
import re
import sys
from pathlib import Path
from types import ModuleType
from typing import Any

from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.util.docutils import SphinxDirective
from sphinx.util.logging import getLogger

ROOT = Path(__file__).resolve().parents[1]
REPOSITORY = "https://github.com/phasefill/phasefill"
sys.path.insert(0, str(ROOT))

from infill import __version__  # noqa: E402 - the package beside this folder, not an installed one

project = "phasefill"
author = "The phasefill developers"
copyright = f"{datetime.datetime.now(tz=datetime.UTC).year}, {author}"  # noqa: A001 - Sphinx's name for it
release = version = __version__

extensions = ["sphinx.ext.autodoc", "sphinx.ext.mathjax", "numpydoc", "myst_parser"]
smartquotes = False  # "--size" is an option, not a dash
html_theme = "furo"
html_title = "phasefill"
html_theme_options = {
    "source_repository": REPOSITORY,
    "source_branch": "main",
    "source_directory": "docs/",
}

# Markdown as the forge shows it: ```math blocks, anchors of headings.
myst_fence_as_directive = ["math"]
myst_heading_anchors = 4

# Parameters are described in the docstrings, with shapes and units; the signature keeps the types short.
numpydoc_show_class_members = False
autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
autodoc_type_aliases = {"ArrayLike": "ArrayLike", "DTypeLike": "DTypeLike"}
python_maximum_signature_line_length = 88
default_role = "code"  # single backquotes in docstrings are names of arguments as often as of functions

# What public functions take or return and the packages do not export.
NOT_EXPORTED = ("FeatureMotion", "HasName", "Progress", "SmoothOptions", "StampMethod", "SurfaceMethod", "Told")
NOT_EXPORTED += ("LayerTimes", "LimitNote", "WrittenTimes")
NOT_EXPORTED += (r"\w*Report", r"\w*Stages")  # typed dictionaries and parts of results, each in a module of its own
NOT_EXPORTED += ("PrintedVolume", "Edges", "Floats", "Modifier", "Picturable", "Spiral", "Straight", "Viewable")
NOT_EXPORTED += ("WholeMesh",)
# Every other name of ours must resolve. Those of other projects lead nowhere, as the build needs no network.
OTHERS = ("Image", "collections", "dataclasses", "datetime", "importlib", "manifold3d", "np", "numpy", "os", "pathlib")
OTHERS += ("shapely", "trimesh", "typing")
SHORT = (
    "Any",
    "ArrayLike",
    "Callable",
    "DTypeLike",
    "EntryPoint",
    "Literal",
    "MultiLineString",
    "MultiPolygon",
    "NDArray",
)
SHORT += ("Path", "Polygon")
nitpicky = True
nitpick_ignore_regex = [
    ("py:.*", rf"({'|'.join(OTHERS)})\..*"),
    ("py:.*", rf"({'|'.join(SHORT)})"),
    ("py:.*", rf"((infill|patterns)\..*)?({'|'.join(NOT_EXPORTED)})"),
]


logger = getLogger(__name__)


class PublicNames(SphinxDirective):
    """Describe all that a package exports, functions first, then classes, then errors, then constants.

    A heading stands before each kind; names are those that are imported, wherever the code lives.
    """

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Return a section of every kind."""
        package = importlib.import_module(self.arguments[0])
        kinds: dict[str, list[str]] = {"Functions": [], "Classes": [], "Errors and warnings": [], "Constants": []}
        for name in package.__all__:
            thing = getattr(package, name)
            if inspect.isclass(thing):
                kind = "Errors and warnings" if issubclass(thing, Exception) else "Classes"
            else:
                kind = "Functions" if inspect.isroutine(thing) else "Constants"
            kinds[kind].append(name)
        found: list[nodes.Node] = []
        for kind, names in kinds.items():
            if names:
                section = nodes.section(ids=[f"{package.__name__}-{kind.split()[0].lower()}"])
                section += nodes.title(text=kind)
                for name in names:
                    section += self.parse_text_to_nodes(directive(package, name))
                found.append(section)
        return found


def directive(package: ModuleType, name: str) -> str:
    """Return the MyST source that describes one public name."""
    thing = getattr(package, name)
    where = f"{package.__name__}.{name}"
    if inspect.isclass(thing):
        lines = [f".. autoclass:: {where}", "   :show-inheritance:", "   :members:"]
    elif inspect.isroutine(thing):
        lines = [f".. autofunction:: {where}"]
    else:
        kind = type(thing).__name__
        lines = [f".. py:data:: {where}", f"   :type: {kind}", "", f"   The {kind} that the command line reads."]
    return "\n".join(["```{eval-rst}", *lines, "```"])


class CommandLine(SphinxDirective):
    """Describe every command and option, from the program itself."""

    def run(self) -> list[nodes.Node]:
        """Return a section of every command."""
        import typer
        from typer.cli import get_docs_for_click

        from infill.cli.app import build_app

        command = typer.main.get_command(build_app())
        context = command.make_context("infill", [], resilient_parsing=True)
        text = get_docs_for_click(obj=command, ctx=context, name="infill")
        # The page has its own title, and a list of the commands beside it.
        text = re.sub(r"\A# .*\n", "", text)
        return self.parse_text_to_nodes(re.sub(r"^##", "#", text, flags=re.M), allow_section_headings=True)


def beyond_the_site(_: Sphinx, name: str, content: list[str]) -> None:
    """Let links out of docs/ lead to the repository: the pages are read there as well, where they are relative."""
    up = re.escape("../" * (name.count("/") + 1))
    content[0] = re.sub(rf"\]\({up}([^)\s]+)\)", rf"]({REPOSITORY}/blob/main/\1)", content[0])


WRITTEN_OUT = {
    r"(?:~?numpy\.)?ndarray\[tuple\[.*?\.\.\.\], (?:~?numpy\.)?dtype\[(.*?)\]\]": r"NDArray[\1]",
    r"<factory>": "...",
    r"TypeAliasForwardRef\('(.*?)'\)": r"\1",
}


def short_types(*event: Any) -> tuple[str | None, ...]:
    """Write types as the source does: NDArray[float64], not ndarray[tuple[Any, ...], dtype[float64]]."""
    found = []
    for text in event[-2:]:  # the signature, and what is returned
        for written_out, short in WRITTEN_OUT.items():
            text = text and re.sub(written_out, short, text)
        found.append(text)
    return tuple(found)


def by_public_name(
    app: Sphinx, env: BuildEnvironment, node: pending_xref, contnode: nodes.Element
) -> nodes.Element | None:
    """Resolve a name of ours by where it is exported: annotations tell the module that it lives in."""
    target = str(node.get("reftarget", ""))
    name = target.rpartition(".")[2]
    for package in ("infill", "patterns"):
        if name in importlib.import_module(package).__all__:
            public = f"{package}.{name}"
            return env.domains["py"].resolve_xref(env, node["refdoc"], app.builder, "obj", public, node, contnode)
    return None


def complete(app: Sphinx, failure: Exception | None) -> None:
    """Warn of every public name that the reference lacks."""
    if failure is None:
        described = set(app.env.domains["py"].objects)
        for package in ("infill", "patterns"):
            for name in importlib.import_module(package).__all__:
                if f"{package}.{name}" not in described:
                    logger.warning("%s.%s is public and not in the reference", package, name)


def setup(app: Sphinx) -> None:
    """Add the directives of the reference."""
    app.add_directive("public-names", PublicNames)
    app.add_directive("command-line", CommandLine)
    app.connect("source-read", beyond_the_site)
    app.connect("autodoc-process-signature", short_types)
    app.connect("build-finished", complete)
    app.connect("missing-reference", by_public_name)
