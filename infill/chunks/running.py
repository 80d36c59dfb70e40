"""Run tasks on Dask: on threads, on local processes, or on a cluster. Tasks, retries and the dashboard are Dask's."""

from __future__ import annotations

import contextlib
import dataclasses
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, ProcessPoolExecutor
from dataclasses import dataclass, field
from functools import partial
from importlib.util import find_spec
from multiprocessing import get_context
from typing import Any, TypeVar

import numpy as np

from infill.checks import check_whole_number
from infill.chunks.keeping import NOT_KEPT, ResultFolder
from infill.errors import InfillError, MemoryLimitError, ParameterError, UsageError
from infill.kernels.threads import run_interruptibly, thread_count
from infill.machine import return_large_blocks

Item = TypeVar("Item")
Done = TypeVar("Done")

EXTRA = "pip install dask distributed fsspec h5py zarr"
CONNECTING = 10  # s: how long a scheduler may take to answer
THREADS, PROCESSES = "threads", "processes"
LOST_WORKER = (
    "a worker ended before its chunk was done, often because memory ran out; give fewer --workers, or less "
    "--max-memory, which makes chunks smaller"
)
LOST = ("cancelled", "lost")  # states of a task whose worker or scheduler went away
LOST_CLUSTER = "the scheduler of the cluster does not answer; check that it runs, and give its address again"


def require_dask() -> None:
    """Raise ParameterError unless the packages of the extra `scale` are there."""
    if find_spec("dask") is None:
        raise ParameterError(f"a volume in chunks needs the extra scale: {EXTRA}")


@dataclass(frozen=True, kw_only=True, eq=False)
class Runner:
    """Runs one function on many items.

    Parameters
    ----------
    workers : int
        Tasks at once.
    where : str
        "threads", "processes", or "cluster".
    client : distributed.Client or None
    pool : ProcessPoolExecutor or None
    kept : ResultFolder or None
        Where the results of tasks are kept, and found by a later run.
    """

    workers: int
    where: str = THREADS
    client: Any = None
    pool: ProcessPoolExecutor | None = field(default=None, repr=False)
    kept: ResultFolder | None = None

    def memory_per_task(self) -> int | None:
        """Return the bytes that a task on a cluster may take, None on this machine."""
        if self.client is None:
            return None
        workers = self.client.scheduler_info(n_workers=-1)["workers"].values()
        shares = [worker["memory_limit"] / worker["nthreads"] for worker in workers if worker["memory_limit"]]
        return int(min(shares) / 2) if shares else None

    def run(
        self,
        function: Callable[..., Done],
        shared: Any,  # noqa: ANN401 - what all calls have in common
        items: Sequence[tuple[Any, ...]],
        progress: Callable[[float], None] | None = None,
        *,
        keep: bool = True,
    ) -> list[Done]:
        """Return `function(shared, *item)` for every item, in their order.

        Results that are kept in a folder are taken from there, and the others are kept there, each once it is done;
        not with `keep=False`, for large ones.

        Raises
        ------
        MemoryLimitError
            If a worker ends before its task does.
        """
        keys = self.kept.keys(function, shared, items) if self.kept is not None and keep else None
        if self.kept is None or keys is None:
            return self._run(function, shared, items, progress, lambda _number, _result: None)
        kept = self.kept
        results = [kept.find(key) for key in keys]
        missing = [number for number, result in enumerate(results) if result is NOT_KEPT]

        def tell(share: float) -> None:
            if progress is not None:
                progress(1 - (1 - share) * len(missing) / len(items))

        def put_by(number: int, result: Done) -> None:
            kept.keep(keys[missing[number]], result)

        done = self._run(function, shared, [items[number] for number in missing], tell, put_by)
        for number, result in zip(missing, done, strict=True):
            results[number] = result
        return results

    def _run(
        self,
        function: Callable[..., Done],
        shared: Any,  # noqa: ANN401
        items: Sequence[tuple[Any, ...]],
        progress: Callable[[float], None] | None,
        put_by: Callable[[int, Done], None],
    ) -> list[Done]:
        """Run all items; `put_by` is called with the number and the result of each, once it is done."""
        if not items:
            return []
        if self.client is not None:
            return self._run_on_cluster(function, shared, items, progress, put_by)
        return self._run_here(function, shared, items, progress, put_by)

    def _run_here(
        self,
        function: Callable[..., Done],
        shared: Any,  # noqa: ANN401
        items: Sequence[tuple[Any, ...]],
        progress: Callable[[float], None] | None,
        put_by: Callable[[int, Done], None],
    ) -> list[Done]:
        import dask
        from dask.callbacks import Callback
        from dask.delayed import delayed

        call = delayed(partial(_call, function, shared), pure=False)
        tasks = [call(*map(_Plain, item)) for item in items]
        numbers = {task.key: number for number, task in enumerate(tasks)}
        finished = 0

        def count(key: Any, result: Any, *_: object) -> None:  # noqa: ANN401 - of Dask
            nonlocal finished
            finished += 1
            if key in numbers:
                put_by(numbers[key], result)
            if progress is not None:
                progress(min(1.0, finished / len(items)))

        options: dict[str, Any] = {"scheduler": self.where, "num_workers": self.workers}
        if self.pool is not None:
            options = {"scheduler": PROCESSES, "pool": self.pool, "chunksize": 1}  # each result once it is there
        try:
            with Callback(posttask=count):  # type: ignore[no-untyped-call]
                compute = partial(dask.compute, *tasks, optimize_graph=False, **options)  # type: ignore[attr-defined]
                return list(run_interruptibly(compute))
        except BrokenExecutor as error:
            raise MemoryLimitError(LOST_WORKER) from error

    def _run_on_cluster(
        self,
        function: Callable[..., Done],
        shared: Any,  # noqa: ANN401
        items: Sequence[tuple[Any, ...]],
        progress: Callable[[float], None] | None,
        put_by: Callable[[int, Done], None],
    ) -> list[Done]:
        from distributed import KilledWorker, as_completed
        from distributed.comm.core import CommClosedError

        client = self.client
        futures: list[Any] = []
        try:
            scattered = client.scatter(shared, broadcast=True, hash=False)
            futures = [client.submit(_call_plain, function, scattered, item, pure=False) for item in items]
            numbers = {future.key: number for number, future in enumerate(futures)}
            results: dict[int, Done] = {}
            finished = as_completed(futures, loop=client.loop, with_results=True)  # type: ignore[no-untyped-call]
            for future, result in finished:
                _require_result(future)
                number = numbers[future.key]
                results[number] = result
                put_by(number, result)
                if progress is not None:
                    progress(len(results) / len(items))
            return [results[number] for number in range(len(items))]
        except KilledWorker as error:
            raise MemoryLimitError(LOST_WORKER) from error
        except (CommClosedError, TimeoutError, OSError) as error:
            if isinstance(error, InfillError):
                raise
            raise InfillError(LOST_CLUSTER) from error
        except Exception as error:
            if type(error).__name__ in ("FutureCancelledError", "CancelledError"):
                raise InfillError(LOST_CLUSTER) from error
            raise
        finally:
            with contextlib.suppress(Exception):
                client.cancel([future for future in futures if not future.done()])


def _require_result(future: Any) -> None:  # noqa: ANN401 - distributed.Future
    """Raise InfillError for a task whose result went away with its scheduler."""
    if future.status in LOST:
        raise InfillError(LOST_CLUSTER)


class _Plain:
    """An argument that Dask does not look into."""

    def __init__(self, value: Any) -> None:  # noqa: ANN401 - anything
        self.value = value


def _call(function: Callable[..., Done], shared: Any, *item: _Plain) -> Done:  # noqa: ANN401
    """Call a function of plain arguments."""
    return_large_blocks()
    result: Done = copy_views(function(shared, *(argument.value for argument in item)))
    return result


def copy_views(value: Any) -> Any:  # noqa: ANN401 - plain data
    """Return plain data in which no array is a view that keeps a larger array in memory.

    >>> large = np.zeros(1000)
    >>> copy_views((large[:2], 1))[0].base is None
    True
    """
    if isinstance(value, np.ndarray):
        return value.copy() if isinstance(value.base, np.ndarray) and value.base.nbytes > value.nbytes else value
    if type(value) in (tuple, list):
        return type(value)(copy_views(part) for part in value)
    if isinstance(value, dict):
        return {key: copy_views(part) for key, part in value.items()}
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        parts = {item.name: getattr(value, item.name) for item in dataclasses.fields(value) if item.init}
        copies = {name: copy_views(part) for name, part in parts.items()}
        changed = {name: copies[name] for name in parts if copies[name] is not parts[name]}
        return dataclasses.replace(value, **changed) if changed else value
    return value


def _call_plain(function: Callable[..., Done], shared: Any, item: tuple[Any, ...]) -> Done:  # noqa: ANN401
    """Call a function on a worker."""
    return_large_blocks()
    return function(shared, *item)


def check_runner(workers: int | None, scheduler: str | None) -> None:
    """Raise an error for a number of workers below 1, or a scheduler that is not an address."""
    if workers is not None:
        check_whole_number("workers", workers, 1)
    if scheduler not in (None, THREADS, PROCESSES) and "://" not in str(scheduler):
        raise UsageError.about(
            "scheduler", f"is {scheduler!r}; give {THREADS}, {PROCESSES} or an address such as tcp://host:8786"
        )


@contextlib.contextmanager
def open_runner(workers: int | None = None, scheduler: str | None = None) -> Iterator[Runner]:
    """Yield the runner for the tasks of a volume.

    Parameters
    ----------
    workers : int, optional
        Chunks at once, one per core by default; not for a cluster, which has its own.
    scheduler : str, optional
        "threads", "processes", or the address of a scheduler of Dask. By default the current client, else threads.

    Raises
    ------
    ParameterError
        If a package is missing, or the scheduler does not answer.
    """
    require_dask()
    check_runner(workers, scheduler)
    client = None if scheduler in (THREADS, PROCESSES) else current_client() if scheduler is None else None
    if scheduler not in (None, THREADS, PROCESSES) or client is not None:
        if workers is not None:
            raise UsageError.about("workers", "is for this machine alone, and a cluster has its own; leave it out")
        if client is not None:
            yield Runner(workers=max(1, len(client.nthreads())), where="cluster", client=client)
            return
        with _connect(str(scheduler)) as connected:
            yield Runner(workers=max(1, len(connected.nthreads())), where="cluster", client=connected)
        return
    count = thread_count(workers)
    if scheduler == PROCESSES:
        pool = ProcessPoolExecutor(count, mp_context=get_context("spawn"))
        try:
            yield Runner(workers=count, where=PROCESSES, pool=pool)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
        return
    yield Runner(workers=count)


def current_client() -> Any:  # noqa: ANN401 - distributed.Client
    """Return the client that this process has opened, None without one."""
    if "distributed" not in sys.modules:
        return None
    from distributed import get_client

    try:
        return get_client()
    except ValueError:
        return None


@contextlib.contextmanager
def _connect(address: str) -> Iterator[Any]:
    """Yield a client of a scheduler; raise ParameterError if it does not answer."""
    if find_spec("distributed") is None:
        raise ParameterError(f"a cluster needs the extra scale: {EXTRA}")
    from distributed import Client

    try:
        client = Client(address, timeout=CONNECTING, set_as_default=False)  # type: ignore[no-untyped-call]
    except (OSError, ValueError, TimeoutError) as error:
        raise UsageError.about(
            "scheduler", f"is {address!r}, and nothing answers there; give an address such as tcp://host:8786"
        ) from error
    try:
        yield client
    finally:
        with contextlib.suppress(Exception):
            client.close()  # type: ignore[no-untyped-call]
