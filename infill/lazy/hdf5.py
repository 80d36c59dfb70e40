"""A dataset of an HDF5 file: ``file.h5:/path``, [x, y, z]."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from infill.errors import FormatError, ParameterError
from infill.files.broken import missing_file
from infill.lazy.names import HDF5
from infill.lazy.volume import EXTRA, LazyVolume, read_error, require_volume
from infill.volume import AXES

MOST_NAMED = 8


@dataclass(frozen=True)
class Hdf5Array:
    """A dataset with three axes.

    Parameters
    ----------
    path, dataset : str
    shape : (nx, ny, nz)
    kind : str
        Type of the cells.
    """

    path: str
    dataset: str
    shape: tuple[int, ...]
    kind: str

    @property
    def dtype(self) -> np.dtype[Any]:
        """Type of the cells."""
        return np.dtype(self.kind)

    @property
    def grain(self) -> tuple[int, ...]:
        """Cells of a chunk along each axis; of a layer without chunks."""
        import h5py

        with h5py.File(self.path, "r") as file:
            return file[self.dataset].chunks or (1, *self.shape[1:])

    def read(self, box: tuple[slice, ...]) -> NDArray[Any]:
        """Read the cells of a box."""
        import h5py

        try:
            with h5py.File(self.path, "r") as file:
                return np.ascontiguousarray(file[self.dataset][box], dtype=self.dtype)
        except Exception as error:
            raise read_error(f"{self.path}:{self.dataset}", box, error) from error


def open_hdf5(name: str, array: str | None = None) -> LazyVolume:
    """Open a dataset, or the only one with three axes."""
    match = HDF5.fullmatch(name)
    assert match is not None
    path, dataset = match["file"], match["dataset"] or array
    if find_spec("h5py") is None:
        raise ParameterError(f"reading {path} needs the package h5py: {EXTRA}")
    if not Path(path).is_file():
        raise FormatError(missing_file(path))
    import h5py

    try:
        with h5py.File(path, "r") as file:
            dataset = dataset or _only_dataset(path, file)
            if dataset not in file or not isinstance(file[dataset], h5py.Dataset):
                raise FormatError(
                    f"{path} holds no dataset {dataset!r}; it holds {', '.join(_datasets(file)) or 'none'}"
                )
            shape, kind = tuple(map(int, file[dataset].shape)), np.dtype(file[dataset].dtype)
    except OSError as error:
        text = " ".join(str(error).split())[:200]
        raise FormatError(f"{path} is broken or not HDF5 ({text}); copy or save it again") from error
    full_name = f"{path}:{dataset}"
    require_volume(full_name, shape, kind)
    return LazyVolume(array=Hdf5Array(path, dataset, shape, kind.newbyteorder("=").str), name=full_name)


def _datasets(file: Any) -> list[str]:  # noqa: ANN401 - h5py.File
    """List the datasets with three axes."""
    import h5py

    names: list[str] = []
    file.visititems(
        lambda name, item: names.append(f"/{name}") if isinstance(item, h5py.Dataset) and item.ndim == AXES else None
    )
    return names[:MOST_NAMED]


def _only_dataset(path: str, file: Any) -> str:  # noqa: ANN401 - h5py.File
    """Return the only dataset with three axes."""
    names = _datasets(file)
    if len(names) != 1:
        content = f"{len(names)} datasets ({', '.join(names)})" if names else "no dataset with three axes"
        advice = f"give one: {path}:{names[0]}" if names else "give another file"
        raise FormatError(f"{path} holds {content}; {advice}")
    return names[0]
