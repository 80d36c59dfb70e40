"""The file of a sliced print: text, binary G-code with text inside, or an archive with a text for each plate."""

from __future__ import annotations

import contextlib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import BinaryIO, Literal

from infill.errors import FormatError, OutputError, ParameterError
from infill.files.broken import missing_file
from infill.files.suffixes import MESHES, PRINTS
from infill.files.whole_files import scratch_file

HEAD = 4  # bytes that identify the form
LINE_END_SAMPLE = 1 << 18  # bytes in which line ends are checked
Form = Literal["text", "binary", "archive"]
# By the form of a print: suffixes that promise it, and its name in words.
FORMS: dict[Form, tuple[tuple[str, ...], str]] = {
    "text": ((".gcode", ".gco"), "G-code as text"),
    "binary": ((".bgcode",), "binary G-code"),
    "archive": ((".3mf",), "a project with sliced plates"),
}


@dataclass(frozen=True, kw_only=True)
class SlicedText:
    """One print.

    Parameters
    ----------
    text : binary file
        Its G-code as text; it can be read from any place.
    settings : mapping
        Of the slicer, if they stand outside the text.
    metadata : tuple of (name, value)
        Of the print, likewise.
    slicer : str
        Its name and version, if they stand outside the text.
    """

    text: BinaryIO
    settings: Mapping[str, str] = field(default_factory=dict)
    metadata: tuple[tuple[bytes, bytes], ...] = ()
    slicer: str = ""


@dataclass(frozen=True, kw_only=True)
class SlicedFile:
    """A file of a slicer that is open.

    Parameters
    ----------
    name : str
    file : binary file
    form : {"text", "binary", "archive"}
    plates : tuple of int
        Of an archive: those that have G-code.
    parts : tuple of int or None
        Prints in the file: the plates of an archive, or None for its only one.
    """

    name: str
    file: BinaryIO
    form: Form
    plates: tuple[int, ...] = ()
    parts: tuple[int | None, ...] = (None,)

    def part_of_plate(self, plate: int | None) -> int | None:
        """Return the entry of `parts` for a plate; without a plate, the first.

        Raises
        ------
        ParameterError
            The file does not have this plate.
        """
        if plate is None:
            return self.parts[0]
        if plate not in self.plates:
            available = (
                f"it has {', '.join(map(str, self.plates))}" if self.plates else "it has no plates; leave it out"
            )
            raise ParameterError.about("plate", f"is {plate}, which is not in {self.name}; {available}")
        return plate

    @contextlib.contextmanager
    def text(self, part: int | None, folder: Path | None = None) -> Iterator[SlicedText]:
        """Open one of `parts`; unpack packed text to a nameless file in `folder`.

        Raises
        ------
        FormatError
            If it cannot be unpacked, or has no lines.
        """
        self.file.seek(0)
        opening: contextlib.AbstractContextManager[SlicedText]
        if part is not None:
            opening = self._plate(part, folder)
        elif self.form == "binary":
            opening = self._binary(folder)
        else:
            opening = contextlib.nullcontext(SlicedText(text=self.file))
        with opening as sliced_text:
            _check_line_ends(sliced_text.text)
            yield sliced_text

    def rewrite(
        self, target: BinaryIO, texts: Mapping[int | None, Iterable[bytes]], metadata: Mapping[str, str]
    ) -> None:
        """Write the file with new text, in its own form.

        Parameters
        ----------
        target : binary file
        texts : mapping from part to iterable of bytes
            The new text of each part that changes, in pieces.
        metadata : mapping
            New values of the metadata outside the text of binary G-code.
        """
        self.file.seek(0)
        if self.form == "archive":
            from infill.gcode.bambu_archive import rewrite_archive

            rewrite_archive(self.file, target, {plate: text for plate, text in texts.items() if plate is not None})
        elif self.form == "binary":
            from infill.gcode.binary import rewrite_binary

            rewrite_binary(self.file, target, texts[None], metadata)
        else:
            target.writelines(texts[None])

    @contextlib.contextmanager
    def _binary(self, folder: Path | None) -> Iterator[SlicedText]:
        """Yield the text of a binary file, with the settings and values of its metadata."""
        from infill.gcode.binary import Kind, read_blocks, read_metadata, read_text_pieces

        with _unpack_to_file(read_text_pieces(self.file), folder) as text:
            self.file.seek(0)
            settings: dict[str, str] = {}
            values: dict[str, str] = {}
            slicer = ""
            for block in read_blocks(self.file):
                if block.kind == Kind.SLICER_METADATA:
                    settings.update(read_metadata(block))
                elif block.kind in (Kind.PRINT_METADATA, Kind.PRINTER_METADATA):
                    values.update(read_metadata(block))
                elif block.kind == Kind.FILE_METADATA:
                    slicer = read_metadata(block).get("Producer", "")
            pairs = tuple((_encode_text(name), _encode_text(value)) for name, value in values.items())
            yield SlicedText(text=text, settings=settings, metadata=pairs, slicer=slicer)

    @contextlib.contextmanager
    def _plate(self, plate: int, folder: Path | None) -> Iterator[SlicedText]:
        """Yield the text of a plate of an archive."""
        from infill.gcode.bambu_archive import read_plate

        try:
            with _unpack_to_file(read_plate(self.file, plate), folder) as text:
                yield SlicedText(text=text)
        except FormatError as error:
            raise FormatError(f"plate {plate}: {error}") from error


@contextlib.contextmanager
def open_sliced(source: Path) -> Iterator[SlicedFile]:
    """Open the file of a sliced print, whatever its name.

    Raises
    ------
    FormatError
        If it cannot be read. Errors raised while it is open get the name of the file.
    """
    try:
        file = source.open("rb")
    except FileNotFoundError as error:
        raise FormatError(missing_file(source)) from error
    except OSError as error:
        reason = error.strerror or str(error)
        raise FormatError(f"cannot read {source}: {reason[:1].lower()}{reason[1:]}") from error
    form: Form = "text"
    try:
        with file:
            form = _detect_form(file.read(HEAD))
            numbers: tuple[int, ...] = ()
            if form == "archive":
                from infill.gcode.bambu_archive import list_plates

                numbers = list_plates(file)
            yield SlicedFile(name=source.name, file=file, form=form, plates=numbers, parts=numbers or (None,))
    except FormatError as error:
        if form == "text" and source.suffix.lower() in MESHES:
            raise FormatError(
                f"{source} is named like a mesh, and is not a sliced print; slice it first, or infill fill fills it, "
                "and infill check says whether it is printable"
            ) from error
        raise FormatError(f"{source}: {error}") from error


def check_output_name(output: Path | None, sliced: SlicedFile) -> None:
    """Raise OutputError for a name that promises another form of file than that of the print, which is kept."""
    if output is None:
        return
    suffix = output.suffix.lower()
    own, words = FORMS[sliced.form]
    if suffix in {*MESHES, *PRINTS} - set(own):
        better = output.with_suffix(own[0]).name
        raise OutputError(f"{output} is not a name for {words}, which a refilled {sliced.name} is; give {better}")


def _check_line_ends(text: BinaryIO) -> None:
    """Raise FormatError for a text whose lines end with CR alone; the text is left at its beginning."""
    text.seek(0)
    head = text.read(LINE_END_SAMPLE)
    text.seek(0)
    if b"\r" in head and b"\n" not in head:
        raise FormatError(
            "its lines end with CR alone, as on old Macs; end them with LF: tr '\\r' '\\n' < old.gcode > new.gcode"
        )


def _detect_form(head: bytes) -> Form:
    """Return the form of a file from its first bytes; the reader of a form is imported only for it."""
    if head.startswith(b"PK"):
        from infill.gcode.bambu_archive import is_archive

        return "archive" if is_archive(head) else "text"
    if head.startswith(b"GCDE"):
        return "binary"
    return "text"


@contextlib.contextmanager
def _unpack_to_file(pieces: Iterable[bytes], folder: Path | None) -> Iterator[BinaryIO]:
    """Write pieces of text to a scratch file and yield it, rewound."""
    with scratch_file(folder) as text:
        text.writelines(pieces)
        text.seek(0)
        yield text


def _encode_text(text: str) -> bytes:
    """Return text as bytes; bytes that were not text come back as they were."""
    return text.encode("utf-8", "surrogateescape")
