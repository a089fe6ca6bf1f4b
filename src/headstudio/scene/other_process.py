"""A process that works out answers elsewhere, while this one goes on.

Python threads would not do: both sides are many small calls that hold its lock. Arrays of an answer come through memory
that both processes see; the rest of it, and all of a question, through a pipe.
"""

from __future__ import annotations

import contextlib
import multiprocessing
import pickle
import signal
import weakref
from collections.abc import Callable
from ctypes import Array, c_byte
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from typing import Any

# Arrays begin at multiples of this many bytes.
_ALIGNED = 64


class OtherProcess:
    """The other process, as it is seen from here. It ends with the object, or with this process."""

    def __init__(self, prepare: Callable[..., Callable[..., Any]], *given: object, room: int = 0) -> None:
        """Start it. There ``prepare(*given)`` is called, once, for the function that answers questions; all of these are
        pickled. room: for arrays of one answer in common memory, in bytes; what does not fit comes through the pipe."""
        spawning = multiprocessing.get_context("spawn")
        self._pipe, theirs = spawning.Pipe()
        self._memory = spawning.RawArray(c_byte, room) if room else None
        process = spawning.Process(target=_serve, args=(theirs, self._memory, prepare, given), daemon=True)
        process.start()
        theirs.close()
        self._ready = False
        weakref.finalize(self, _end, self._pipe, process)

    @property
    def ready(self) -> bool:
        """Whether it has started, and not ended."""
        return self._ready or (not self._pipe.closed and self._pipe.poll() and self.wait())

    def wait(self) -> bool:
        """Wait until it has started; False when it has ended."""
        if not self._ready and not self._pipe.closed:
            self._ready = self.answer() is not None
        return self._ready

    def ask(self, *question: object) -> bool:
        """Send the arguments of the function that answers; False when nobody is there any more."""
        try:
            self._pipe.send(question)
        except OSError:
            self._ready = False
        return self._ready

    def answer(self) -> Any | None:
        """Wait for the answer, which is not None; None when there will be none."""
        try:
            pickled, spans = self._pipe.recv()
        except (EOFError, OSError):
            self._ready = False
            self._pipe.close()
            return None
        # A copy, since the next answer will lie in the same place.
        end = max((start + size for start, size in spans), default=0)
        arrays = memoryview(bytearray(memoryview(self._memory).cast("B")[:end])) if self._memory and end else b""
        return pickle.loads(pickled, buffers=[arrays[start : start + size] for start, size in spans])


def _end(pipe: Connection, process: BaseProcess) -> None:
    pipe.close()
    process.join(1.0)
    process.terminate()


def _serve(
    pipe: Connection,
    memory: Array[c_byte] | None,
    prepare: Callable[..., Callable[..., Any]],
    given: tuple[object, ...],
) -> None:
    """What the other process does: answer until nobody asks any more."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # it ends with the process that asks
    answer = prepare(*given)
    with contextlib.suppress(EOFError, OSError):  # nobody asks any more
        pipe.send((pickle.dumps(True), []))
        while True:
            pipe.send(_packed(answer(*pipe.recv()), memory))


def _packed(answer: object, memory: Array[c_byte] | None) -> tuple[bytes, list[tuple[int, int]]]:
    """An answer without the arrays that are now in ``memory``, and the start and size of each there, in bytes."""
    spans: list[tuple[int, int]] = []
    room = memoryview(memory).cast("B") if memory is not None else memoryview(b"")

    def place(array: pickle.PickleBuffer) -> bool:
        """Whether it is to come through the pipe."""
        data = array.raw()
        start = -(-sum(spans[-1]) // _ALIGNED) * _ALIGNED if spans else 0
        if data.nbytes == 0 or start + data.nbytes > len(room):
            return True
        room[start : start + data.nbytes] = data
        spans.append((start, data.nbytes))
        return False

    return pickle.dumps(answer, protocol=5, buffer_callback=place), spans
