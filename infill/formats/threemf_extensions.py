"""Extensions of 3MF: those that are read, those that do not affect the shape, and names of the others."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from infill.errors import FormatError
from infill.files.excerpts import excerpt
from infill.formats.threemf_package import Model

SEPARATE = re.compile(r"[\s,]+")
# Namespaces of any year that do not change a shape, or whose relevant content is read.
HARMLESS = re.compile(
    r"http://schemas\.(?:microsoft\.com|3mf\.io)/3dmanufacturing/(?:core|production|materials?|trianglesets)/\d[\d/]*"
    r"|http://schemas\.slic3r\.org/.*|http://schemas\.bambulab\.com/.*|http://software\.ultimaker\.com/.*"
    r"|http://schemas\.(?:orcaslicer|prusa3d)\.com/.*|http://www\.w3\.org/.*"
)
SHAPES = {
    "beamlattice": "beam lattices",
    "balls": "beam lattices",
    "boolean": "boolean shapes",
    "displacement": "displaced surfaces",
    "implicit": "implicit functions",
    "volumetric": "volumetric data",
    "slice": "stacks of slices",
    "securecontent": "secure content, which is encrypted",
    "alternatives": "alternative shapes of lower resolution",
    "mirror": "mirrored meshes",
}


@dataclass(frozen=True, kw_only=True)
class Extension:
    """An extension that a model requires.

    Parameters
    ----------
    prefix : str
        As in the file.
    namespace : str
        Empty if the file does not declare the prefix.
    """

    prefix: str
    namespace: str

    @property
    def known(self) -> bool:
        """True if it is read, or does not affect the shape."""
        return is_harmless(self.namespace)

    def __str__(self) -> str:
        """Return the name of the extension in messages."""
        words = name_of(self.namespace) if self.namespace else "which it does not declare"
        return f"'{excerpt(self.prefix)}' ({words})"


def is_harmless(namespace: str) -> bool:
    """Tell whether an extension does not affect the shape, or is read.

    >>> is_harmless("http://schemas.microsoft.com/3dmanufacturing/production/2015/06")
    True
    """
    return HARMLESS.fullmatch(namespace) is not None


def name_of(namespace: str) -> str:
    """Return a description of an extension, or its namespace.

    >>> name_of("http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02")
    'beam lattices'
    """
    lower = namespace.lower()
    return next((words for key, words in SHAPES.items() if key in lower), excerpt(namespace, 80))


def required_extensions(model: Model) -> Iterator[Extension]:
    """Yield the extensions that a model requires."""
    for prefix in dict.fromkeys(SEPARATE.split(model.root.get("requiredextensions", "").strip())):
        if prefix:
            yield Extension(prefix=prefix, namespace=namespace_of(prefix, model.spaces))


def namespace_of(prefix: str, spaces: Mapping[str, str]) -> str:
    """Return the namespace of a prefix; some programs write the namespace instead of the prefix."""
    return spaces.get(prefix, prefix if prefix.startswith("http") else "")


def check_required(model: Model, name: str) -> None:
    """Raise FormatError, as the specification demands, if a required extension is not read.

    Parameters
    ----------
    name : str
        Name of the file, for the message.
    """
    unknown = [extension for extension in required_extensions(model) if not extension.known]
    if unknown:
        names = " and ".join(map(str, unknown))
        extension = f"extension {names}, which is" if len(unknown) == 1 else f"extensions {names}, which are"
        raise FormatError(
            f"{name} requires the 3MF {extension} not read; export the part as a mesh of triangles, such as an STL"
        )
