"""While a question is answered, Python looks for circular garbage less often.

It would go through every expression that is kept, again and again, and expressions have no circles.
"""

from __future__ import annotations

import gc
import threading
from collections.abc import Iterator
from contextlib import contextmanager

YOUNG = 100_000
"""The number of new objects after which Python looks for garbage among them while a question is answered."""

_lock = threading.Lock()
_inside = 0
_before: tuple[int, int, int] = gc.get_threshold()


@contextmanager
def rarely_collected() -> Iterator[None]:
    """Within it, garbage is looked for after `YOUNG` new objects; the last to leave, in any thread, sets what was set.

    Who looks for it even less often, or never, goes on as before.
    """
    global _inside, _before
    with _lock:
        if _inside == 0:
            _before = gc.get_threshold()
            if 0 < _before[0] < YOUNG:
                gc.set_threshold(YOUNG, *_before[1:])
        _inside += 1
    try:
        yield
    finally:
        with _lock:
            _inside -= 1
            if _inside == 0 and gc.get_threshold() == (YOUNG, *_before[1:]):
                gc.set_threshold(*_before)
