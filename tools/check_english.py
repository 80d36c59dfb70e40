"""Find turns of phrase that readers stumble over in pages, docstrings and messages: `make lint` runs it.

python tools/check_english.py [files]
"""

from __future__ import annotations

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# What stands in the way, and what to write instead.
TURNS = {
    r"(?<!not\s)\bours\b": "name it: a built-in pattern, `infill fill`",
    r"\banew\b": "again",
    r"(?<!there\s)\b(?:is|are|was|were) no (?!more\b|longer\b|less\b|fewer\b|\w+er\b)": "is not a, has no",
    r"\bbut for\b": "except for",
    r"\bevery so[ -]many": "sampling stride",
    r"\bso that not\b": "so that ... does not",
    r"\bthan which\b": "turn the sentence round",
    r"\bby turns\b": "alternately",
    r"\bwhat (?:was|is) (?:asked for|there)\b": "requested, actual",
    r"\b(?:is|are|was|were|be) told\b|\btells? of\b": "is reported, states",
    r"\bmend(?:s|ed|ing)?\b": "repair, fix",
    r"\bdoes not take\b": "rejects",
    r"\w\((?:s|es|ies)\)": "infill.plain_numbers.count_noun",
}
# Formats that write 1,940 as 1.94e+03, in f-strings, str.format and logging.
EXPONENT = re.compile(r"[gGeE]$")
TEMPLATE = re.compile(r"%[-+ #0\d.]*[geGE](?![a-z])|\{[^{}\s]*:[-+ #,\d.]*[gGeE]\}")
# Modules that write numbers for machines, or that the formatting itself is made of.
FOR_MACHINES = {
    "infill/formats/obj.py",
    "infill/formats/stl.py",
    "infill/formats/threemf.py",
    "infill/gcode/dialect.py",
    "infill/imaging/nrrd.py",
    "infill/plain_numbers.py",
    "infill/samples/plate_print.py",
    "patterns/declared.py",
}
# Pages that programs write: their words come from those programs.
WRITTEN = {"commands.md", "paper.md", "slicer-report.md", "smooth-report.md"}
FENCED = re.compile(r"^( *)(```|~~~).*?^\1\2 *$", re.MULTILINE | re.DOTALL)


def find_exponents(path: Path) -> list[str]:
    """Return a line for each format in a module that may write a number with an exponent."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    docstrings = {id(node.value) for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    rounded = {
        id(part)
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "float"
        for argument in node.args
        for part in ast.walk(argument)
    }  # float(f"{size:.3g}") is no text
    found = []
    for node in ast.walk(tree):
        if id(node) in rounded:
            continue
        if isinstance(node, ast.FormattedValue) and isinstance(node.format_spec, ast.JoinedStr):
            specs = [part.value for part in node.format_spec.values if isinstance(part, ast.Constant)]
            found += [(node.lineno, spec) for spec in specs if EXPONENT.search(spec)]
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docstrings:
            found += [(node.lineno, match[0]) for match in TEMPLATE.finditer(node.value)]
    return [f"{path}:{line}: '{text}'; write: infill.plain_numbers.plain_number" for line, text in found]


def texts(path: Path) -> Iterator[tuple[int, str]]:
    """Yield every text for readers in a file with its line: a page without its code, or the sentences of a module."""
    source = path.read_text(encoding="utf-8")
    if path.suffix != ".py":
        yield 1, FENCED.sub(lambda found: "\n" * found[0].count("\n"), source)
        return
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value:
            yield node.lineno, node.value


def find_turns(path: Path) -> list[str]:
    """Return a line for each turn in a file: the place, the words and what to write."""
    found = []
    for line, text in texts(path):
        for turn, remedy in TURNS.items():
            for match in re.finditer(turn.replace(" ", r"\s+"), text, re.IGNORECASE):
                place = line + text.count("\n", 0, match.start())
                found.append(f"{path}:{place}: '{' '.join(match[0].split())}'; write: {remedy}")
    return found


def readers_files() -> list[Path]:
    """Return the pages of the repository and the modules of both packages."""
    pages = [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]
    pages = [page for page in pages if page.name not in WRITTEN]
    return sorted([*pages, *ROOT.glob("infill/**/*.py"), *ROOT.glob("patterns/**/*.py")])


if __name__ == "__main__":
    files = [Path(name) for name in sys.argv[1:]] or readers_files()
    complaints = [line for path in files for line in find_turns(path)]
    for path in files:
        if path.suffix == ".py" and path.resolve().as_posix().removeprefix(f"{ROOT.as_posix()}/") not in FOR_MACHINES:
            complaints += find_exponents(path)
    print("\n".join(complaints), file=sys.stderr, end="\n" if complaints else "")
    sys.exit(bool(complaints))
