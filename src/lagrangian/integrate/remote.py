"""Computes an ensemble on several machines: chunks are tasks of Dask's distributed scheduler.

Every worker compiles the study itself, once, for its own processor. A task contains its rows, so any worker can compute
it at any time: if a worker dies, another repeats what it was computing or had not yet delivered. Workers may join while
a sweep runs. When no chunk is left to send, idle workers get copies of those that are still computed elsewhere, and the
first result counts; copies have the same bits. The results return to this process, which alone writes them.
"""

from __future__ import annotations

import contextlib
import hashlib
import importlib.metadata
import pickle
import threading
import time
from collections import Counter, OrderedDict
from collections.abc import Iterable, Iterator
from concurrent.futures import CancelledError
from typing import Any

from lagrangian.advice import Advice, Argument
from lagrangian.errors import Error, MissingExtra, RunError
from lagrangian.integrate.chunks import Portions
from lagrangian.integrate.design import Design, Rows
from lagrangian.integrate.ensemble import solver_of
from lagrangian.integrate.observe import Study, Values
from lagrangian.integrate.store import RESUME

PATIENCE = 30.0
"""The time [s] to wait for the scheduler and a first worker."""

COUNTED = 1.0
"""The time [s] for which a number of workers is believed."""

DELIVERY = 60.0
"""The time [s] in which a worker must deliver a result that it has computed, before another computes it again.

Four times as long for a result that was computed again: if all workers are slow to deliver, one is waited for."""

AHEAD = 2
"""The number of scheduled tasks for each thread of the workers, so that none waits for this process."""

REMEMBERED = 4
"""The number of compiled studies that a worker caches."""

_known: OrderedDict[str, tuple[Study, Any]] = OrderedDict()
_lock = threading.Lock()


def work(key: str, packed: bytes, version: str, rows: Rows) -> Values:
    """Compute one chunk in a worker; the study in ``packed`` is compiled when its ``key`` is first seen."""
    if version != (own := _version()):
        raise RunError(
            f"a worker runs lagrangian {own}, but this process runs {version}",
            code="E506",
            fix="install the same version",
        )
    with _lock:
        if key not in _known:
            study: Study = pickle.loads(packed)
            _known[key] = study, solver_of(study, 1)
            while len(_known) > REMEMBERED:
                _known.popitem(last=False)
        study, solver = _known[key]
    return study.run(solver, rows, 1)


def _version() -> str:
    return importlib.metadata.version("lagrangian")


class Dask:
    """Computes chunks with the workers of a scheduler, given by its address, such as ``tcp://host:8786``, or a client.

    ``held`` is the number of chunks that a worker has in memory at a time, ``threads`` the number of threads of all
    workers. Raises `MissingExtra` if distributed is not installed, and `RunError` if the scheduler does not respond.
    """

    def __init__(self, scheduler: Any) -> None:
        try:
            import distributed
        except ImportError:
            raise MissingExtra("Dask's distributed is not installed", fix="pip install 'lagrangian[sweep]'") from None
        self._lib, self._own = distributed, isinstance(scheduler, str)
        self.client: Any
        if self._own:
            try:
                self.client = distributed.Client(scheduler, timeout=PATIENCE, set_as_default=False)
            except (OSError, ValueError) as trouble:
                raise RunError(
                    f"no scheduler answers at '{scheduler}': {trouble}",
                    code="E506",
                    fix="start one with `dask scheduler` and give the address it prints, such as tcp://host:8786",
                ) from None
        elif isinstance(scheduler, distributed.Client):
            self.client = scheduler
        else:
            raise RunError(
                f"a scheduler is an address or a distributed.Client (got {type(scheduler).__name__})", code="E506"
            )
        try:
            self.client.wait_for_workers(1, timeout=PATIENCE)
        except TimeoutError:
            self.close()
            raise RunError(
                "the scheduler has no workers", code="E506", fix="start some with `dask worker ADDRESS`"
            ) from None
        threads = self.client.nthreads().values()
        self.held, self.threads, self._counted = max(threads), sum(threads), time.monotonic()
        self._hanging: set[str] = set()

    def close(self) -> None:
        """Disconnect from the scheduler; a client that the user passed stays open."""
        if self._own:
            self.client.close()

    def __call__(self, study: Study, design: Design, portions: Portions, todo: Iterable[int]) -> Iterator[Any]:
        """Yield pairs (chunk, values), as they arrive."""
        packed = pickle.dumps(study)
        head = (hashlib.blake2b(packed, digest_size=16).hexdigest(), packed, _version())
        waiting, done = iter(todo), self._lib.as_completed(loop=self.client.loop)
        running: dict[Any, int] = {}
        finished: set[int] = set()
        copied: Counter[int] = Counter()

        def send(index: int, **where: Any) -> None:
            future = self.client.submit(work, *head, design.rows(*portions.range(index)), pure=False, **where)
            running[future] = index
            done.add(future)

        def feed() -> None:
            self._count()
            while len(running) < AHEAD * max(1, self.threads):
                if (index := next(waiting, None)) is None:
                    late = [k for k in running.values() if k not in copied]
                    idle = [worker for worker, tasks in self._delivering().items() if not tasks] if late else []
                    for index in late if idle else ():  # a slow or hanging worker does not hold up the others' end
                        copied[index] += 1
                        send(index, workers=idle, allow_other_workers=True)
                    return
                send(index)

        try:
            feed()
            for future in done:
                index = running.pop(future, None)
                if index is None or index in finished:  # cancelled, because its copy was faster
                    continue
                try:
                    values = self._result(future, DELIVERY * 4 ** copied[index])
                except TimeoutError:  # finished, but its worker hangs before it delivers: another computes it again
                    self._note_hanging(future)
                    self.client.cancel([future])
                    copied[index] += 1
                    send(index, workers=list(self._delivering()) or None, allow_other_workers=True)
                    continue
                finished.add(index)
                copies = [other for other, k in running.items() if k == index]
                for other in copies:
                    del running[other]
                self.client.cancel(copies)
                yield index, values
                feed()
        finally:
            with contextlib.suppress(Exception):  # the scheduler may be lost: then there is nothing to cancel
                self.client.cancel(list(running))
            self.close()

    def _count(self) -> None:
        """Count the threads of the workers again, as workers come and go; asked at most once a second."""
        if time.monotonic() - self._counted > COUNTED:
            with contextlib.suppress(OSError):  # a lost scheduler is reported by the next result
                self.threads = sum(self.client.nthreads().values()) or self.threads
            self._counted = time.monotonic()

    def _delivering(self) -> dict[str, Any]:
        """What the workers compute, by their addresses, without those that did not deliver."""
        try:
            return {worker: tasks for worker, tasks in self.client.processing().items() if worker not in self._hanging}
        except OSError:
            return {}

    def _note_hanging(self, future: Any) -> None:
        """Remember the workers that have a result and do not deliver it."""
        with contextlib.suppress(OSError):
            for holders in self.client.who_has([future]).values():
                self._hanging.update(holders)

    def _result(self, future: Any, within: float) -> Values:
        """The result from a worker; if no worker could compute it, the error.

        Raises TimeoutError if the worker does not deliver what it has computed ``within`` seconds.
        """
        try:
            return future.result(timeout=within)
        except (Error, TimeoutError):
            raise
        except self._lib.KilledWorker as trouble:
            raise RunError(
                "every worker that computed one of the chunks died",
                code="E506",
                fix=Advice(
                    "look at the workers' memory: a smaller ",
                    Argument("memory"),
                    " makes smaller chunks; then go on with ",
                    RESUME,
                ),
            ) from trouble
        except ModuleNotFoundError as trouble:
            raise RunError(f"a worker lacks a package: {trouble}", code="E506", fix="pip install lagrangian") from None
        except (CancelledError, OSError) as trouble:
            raise RunError(
                f"the scheduler was lost: {trouble}", code="E506", fix=Advice("start it, then go on with ", RESUME)
            ) from trouble
