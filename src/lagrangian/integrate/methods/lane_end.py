"""The end of a step in every lane: the next step, or the service, and for what reason."""

from __future__ import annotations

from typing import Protocol

from lagrangian.codegen.ir import Function
from lagrangian.integrate.status import RunStatus

from . import events
from . import memory_layout as at
from .events import EventDetector
from .memory_layout import Lanes
from .printer import Printer


class Attended(Protocol):
    """What this part needs from the loop around it; see `loop.Loop`."""

    p: Printer
    f: Function
    lanes: Lanes
    watch: EventDetector | None
    max_steps: str


def attend(loop: Attended, running: str, arrived: str, broken: str, code: str) -> None:
    """Continue with the next step, or with the service if a lane arrived at a stop point or cannot continue."""
    p, f, lanes, watch = loop.p, loop.f, loop.lanes, loop.watch
    tried = f.put(f"add {f.whole} {p.load_whole(lanes.steps)}, {p.load_whole(lanes.rejected)}")
    spent = f.put(f"icmp sge {f.whole} {tried}, {f.whole_broadcast(loop.max_steps)}")
    spent = f.logic("and", f.logic("and", running, spent), f.opposite(arrived))
    over = f.logic("or", broken, spent)
    any_flag = f.logic("or", arrived, over)
    cut = ""
    if watch is not None:
        cut = f.opposite(p.whole_is(p.load_whole(watch.cut), 0))
        any_flag = f.logic("or", any_flag, cut)
    f.do(f"br i1 {p.any(any_flag)}, label %mark, label %head")
    f.label("mark")
    state, codes = p.load_whole(lanes.state), p.load_whole(lanes.code)
    code = p.whole_select(broken, code, f.integer(RunStatus.TOO_MANY))
    changes = [(arrived, at.STOPPED, ""), (over, at.ENDED, code)]
    if watch is not None:
        held = p.load_whole(watch.cut)
        for why, becomes, how in (
            (events.RESET, at.AT_EVENT, ""),
            (events.ENDS, at.ENDED, f.integer(RunStatus.TERMINAL)),
            (events.ACCUMULATING, at.ENDED, f.integer(RunStatus.ZENO)),
            (events.CROWDS, at.ENDED, f.integer(RunStatus.CROWDED)),
            (events.BLIND, at.ENDED, f.integer(RunStatus.BLIND)),
        ):
            changes.append((p.whole_is(held, why), becomes, how))
    for flag, becomes, how in changes:
        state = p.whole_select(flag, f.integer(becomes), state)
        codes = p.whole_select(flag, how, codes) if how else codes
    p.store_whole(state, lanes.state)
    p.store_whole(codes, lanes.code)
    f.do("br label %service")
