"""Sentences that say what a picture shows, for those who cannot see it: what holds what, what ties what together."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from lagrangian.errors import listed
from lagrangian.look.board import Board
from lagrangian.look.cast import FLAT, BodyGlyph, Player, direction
from lagrangian.look.circuit_words import circuits
from lagrangian.look.couplers import couplers
from lagrangian.look.gears import ArmGear
from lagrangian.look.hoists import Hoist
from lagrangian.look.holds import Hold, HoldKind
from lagrangian.look.phrases import capital, cut, said, short
from lagrangian.look.round_bodies import unwinds
from lagrangian.look.space_supports import hooped
from lagrangian.look.strings import PulleyString
from lagrangian.look.ties import Tie
from lagrangian.look.turning import Turn
from lagrangian.model import CircuitBranch, Element, Frame, Point, Rolling, Rope, Transducer
from lagrangian.page.plain import plain

GROUND = "the ground"

PLAIN = re.compile(r"[^\W\d_]{3,}([ -][^\W\d_]+)*\Z")
"""A name that is an ordinary word or several: ``pole``, ``upper arm``, but not ``m1`` or ``K2``."""

WORDS = {
    BodyGlyph.BALL: "mass", BodyGlyph.SHAFT: "disc", BodyGlyph.BEAM: "beam", BodyGlyph.NONE: "body",
}  # fmt: skip
"""What a glyph is called in a sentence, where that is not its own word."""


def description(
    board: Board,
    parts: list[Player],
    ties: Sequence[Tie],
    turns: Sequence[Turn],
    strings: Sequence[PulleyString | Hoist | ArmGear] = (),
) -> str:
    """The bodies and what holds them; what ties them together; what acts on them; the coordinates."""
    words = _Sentences(board, parts, list(ties), list(turns))
    sentences = ["; ".join(cut(list(words.bodies()), "more bodies"))]
    sentences.append("; ".join(cut(list(words.ties_between()), "more")))
    sentences.append("; ".join(cut([words.string(x) for x in strings] + words.rods(), "more strings and rods")))
    sentences.append("; ".join(cut(list(words.constraints()), "more constraints")))
    sentences.append("; ".join(cut(list(words.actions()), "more")))
    sentences.append("; ".join(circuits(board)))
    coordinates = [_coordinate(c.name, c.description) for c in board.stage.model.coordinates]
    text = " ".join(f"{capital(s)}." for s in sentences if s)
    return f"{text} Coordinates: {'; '.join(cut(coordinates, 'more'))}."


def _coordinate(name: str, words: str) -> str:
    return f"{short(name)}: {short(words, 120)}" if words else short(name)


def _chain(frame: Frame | None) -> Iterator[Frame]:
    """A frame, and those that carry it."""
    while frame is not None:
        yield frame
        frame = frame.parent


class _Sentences:
    """The phrases of one picture."""

    def __init__(self, board: Board, parts: list[Player], ties: list[Tie], turns: list[Turn]) -> None:
        self.turns = turns
        self.board, self.motions, self.stage = board, board.motions, board.stage
        self.parts = [p for p in parts if p.name not in board.hidden]
        self.ties = [t for t in ties if t.element.name not in board.hidden]
        self.space = self.stage.dimension == 3

    # -- names --------------------------------------------------------------------------------------------------

    def body(self, part: Player) -> str:
        """A body as it is mentioned again: ``the pole``, ``mass m1``, ``cart 1``."""
        word = WORDS.get(part.glyph, part.glyph.value)
        name = short(part.name)
        if PLAIN.match(name):
            return f"the {name}"
        return name if any(len(w) > 2 and w.isalpha() for w in name.split()) else f"{word} {name}"

    def first(self, part: Player) -> str:
        """A body as it is first mentioned: ``a pole``."""
        text = self.body(part)
        if not text.startswith("the "):
            return text
        if text.endswith("s") and not text.endswith("ss"):  # several, such as wheels
            return text[4:]
        return f"{'an' if text[4] in 'aeiouAEIOU' else 'a'} {text[4:]}"

    def owner(self, k: int, but: Player | None = None) -> str:
        """What a point belongs to: a body, the ground, or what holds it."""
        for part in self.parts:
            if part is not but and k == part.point:
                return self.body(part)
        if self.motions.still(k):
            return GROUND
        for part in reversed(self.parts):
            if part is not but and k in part.points:
                return self.body(part)
        if not self.motions.coordinates(k):
            return "a driven point"
        hold = self.motions.holds[k] if k < len(self.motions.holds) else None
        if hold is not None and hold.holder != k and hold.how is HoldKind.FIRMLY:
            return self.owner(hold.holder, but)
        name = self.stage.points[k].name
        return f"point {short(name)}" if name else "a point that moves"

    def of_point(self, point: Point) -> str:
        return self.owner(self.stage.index(point))

    def of_turn(self, turn: Turn | int | None) -> str:
        """What turns: its body."""
        if not isinstance(turn, Turn):
            return GROUND
        part = next((p for p in self.parts if p.name == turn.name), None) or self._first_after(turn.frame)
        if part is None:
            return "what turns"
        return self.body(part) if turn.frame is not None else f"the rod of {self.body(part)}"

    def _first_after(self, frame: int | None) -> Player | None:
        """The body that a frame without a body of its own carries, across the fewest frames."""
        found: list[tuple[int, Player]] = []
        for part in self.parts if frame is not None else ():
            chain = list(_chain(part.body.axes))
            if self.stage.frames[frame or 0] in chain:
                found.append((chain.index(self.stage.frames[frame or 0]), part))
        return min(found, key=lambda pair: pair[0])[1] if found else None

    def carrier(self, frame: Frame) -> str:
        """The body on which a frame turns in space, past frames without a body; else the ground."""
        owned = (p for x in _chain(frame.parent) for p in self.parts if p.body.axes is x)
        part = next(owned, None)
        return GROUND if part is None else self.body(part)

    def of_axes(self, thing: Any) -> str | None:
        """The body that turns with a frame, or whose angle an expression is."""
        if isinstance(thing, Frame):
            part = next((p for p in self.parts if p.body.axes is thing), None)
            return self.body(part) if part is not None else f"frame {short(thing.name)}" if thing.name else None
        words = self.stage.model.angle_words(thing)
        found = next((p for p in self.parts if words == (p.body.title,)), None)
        if found is not None:
            return self.body(found)
        turn = self._turn_of(thing)
        return None if turn is None else self.of_turn(turn)

    def _turn_of(self, angle: Any) -> Turn | None:
        """What turns by an angle."""
        slopes = np.abs(self.stage.slopes(angle, self.board.q, self.board.p))
        return next((t for t in self.turns if np.allclose(np.abs(t.slopes), slopes, atol=1e-9)), None)

    # -- bodies -------------------------------------------------------------------------------------------------

    def bodies(self) -> Iterator[str]:
        for part in self.parts:
            yield f"{self.first(part)} {self.held(part)}"

    def held(self, part: Player) -> str:
        """How a body is held."""
        hold = self.motions.holds[part.point]
        special = self._round(part)
        if special:
            return special
        if part.frame is not None and part.points and hold.holder in part.points:
            return self._jointed(part, hold.holder)
        if hold.how is HoldKind.FIRMLY:
            return self._resting(part, hold)
        return self._moving(part, hold)

    def _jointed(self, part: Player, joint: int) -> str:
        """How a body with a joint besides its centre is held there."""
        on, turns = self._beyond(part, joint) or self.owner(joint, part), self.motions.turns(part.frame)
        if on.startswith("point ") and self.motions.holds[joint].how is HoldKind.FREE:
            return self._free
        if self.space and part.body.axes is not None and on.startswith(("point ", "a point ")):
            carrier = self.carrier(part.body.axes)
            on = on if carrier == GROUND else carrier
        if on == GROUND and len(turns) > 1 and self.space:
            return "turning about a fixed point"
        welded = next((x for x in self.parts if x.frame == part.frame and self.body(x) == on), None)
        if not turns or (welded is not None and self.parts.index(welded) < self.parts.index(part)):
            return f"fixed to {on}"
        axes = part.body.axes
        if welded is not None:  # that one is fixed to this one, which turns on what carries the joint
            on = (self.of_axes(axes.parent) if axes is not None and axes.parent is not None else None) or "what moves"
        ball = axes is not None and axes.floating is not None and self.stage.index(axes.origin) == joint
        return f"{'on a ball joint on' if ball else 'hinged on'} {on}"

    def _beyond(self, part: Player, joint: int) -> str:
        """A body at a moving joint that does not turn with this one, as what is welded to it does."""
        if self.motions.still(joint):
            return ""
        others = [x for x in self.parts if x.frame != part.frame and joint in (x.point, *x.points)]
        if not others:
            return ""
        found = next((x for x in others if x.point == joint), others[-1])
        return self.body(next(x for x in others if x.frame == found.frame))  # not what is only fixed to it

    @property
    def _free(self) -> str:
        return f"free to move in {'space' if self.space else 'the plane'}"

    def _round(self, part: Player) -> str:
        hold = self.motions.holds[part.point]
        if part.glyph is BodyGlyph.WHEEL and hold.how is HoldKind.TRACK:
            return f"rolling along {self._frame_owner(hold, part)}"
        if part.glyph is BodyGlyph.SHAFT:
            return "on a common shaft"
        if part.glyph is BodyGlyph.PULLEY:
            return "on a fixed axle" if self.motions.still(part.point) else "hanging on a string"
        if unwinds(self.motions, part):
            return "unwinding from a string"
        if part.glyph is BodyGlyph.WHEEL and part.direction is not None and not self.space:
            return f"rolling on {self._line(part.direction)}"
        if any(isinstance(e, Rolling) and e.body is part.body for e in self.stage.model.elements):
            return f"rolling on {GROUND}"
        return ""

    def _resting(self, part: Player, hold: Hold) -> str:
        on = self.owner(hold.holder, part)
        if part.frame is not None and self.motions.turns(part.frame):
            return "turning about a fixed point" if on == GROUND else f"turning about its centre, on {on}"
        if self.motions.coordinates(part.point):
            return f"moved against {on} as a function of time"
        return f"fixed to {on}"

    def _moving(self, part: Player, hold: Hold) -> str:
        k, on = part.point, self.owner(hold.holder, part)
        from_where = "a fixed point" if on == GROUND else on
        match hold.how:
            case HoldKind.SLIDE:
                whole = self.motions.relation(k, 0)
                if whole.how is HoldKind.SLIDE:
                    e = direction(self.motions.views.J[0, k])
                    return f"on {self._line(e)}" if not self.space else "sliding along a fixed line"
                e = direction(self.motions.views.J[0, k] - self.motions.views.J[0, hold.holder])
                on = "a moving line" if on.startswith("a point") else on
                return f"sliding along {on}"
            case HoldKind.TRACK:
                return f"moving along {self._frame_owner(hold, part)}"
            case HoldKind.ROD:
                if self.space and hooped(self.board, k) is not None:
                    return "on a hoop that is turned as a function of time"
                return f"on a rod from {from_where}"
            case HoldKind.TELESCOPE:
                spring = any(t.way == "telescope" and t.b == k and t.element.kind == "spring" for t in self.ties)
                return f"on {'a spring' if spring else 'a line of changing length'} from {from_where}"
            case HoldKind.WIRE:
                return "moving on a curve"
            case _:
                return self._free

    def _frame_owner(self, hold: Hold, part: Player) -> str:
        for other in self.parts:
            if other is not part and other.frame is not None and other.frame == hold.frame:
                return self.body(other)
        return "a line that turns"

    def _line(self, e: np.ndarray[Any, Any]) -> str:
        """A straight line by its direction in the plane."""
        if abs(e[1]) < FLAT:
            return "a horizontal track"
        return "a vertical line" if abs(e[0]) < FLAT else "a slope"

    # -- elements -----------------------------------------------------------------------------------------------

    def ties_between(self) -> Iterator[str]:
        """Springs, dampers and forces along a deflection."""
        for tie in self.ties:
            a, b = self._ends(tie)
            what = said(tie.element)
            if a is None or b is None:
                yield what
            elif a == b:
                yield f"{what} at {a}"
            else:
                a, b = (b, a) if a == GROUND else (a, b)
                yield f"{what} between {a} and {b}"

    def _ends(self, tie: Tie) -> tuple[str | None, str | None]:
        match tie.way:
            case "points" | "slides":
                return self._end(tie.a), self._end(tie.b)
            case "telescope":
                return (self._end(tie.a), self._end(tie.b)) if isinstance(tie.b, int) else (None, None)
            case "joint" | "arm":
                if self.space and tie.a is None and isinstance(tie.b, Turn) and tie.b.frame is not None:
                    return self.carrier(self.stage.frames[tie.b.frame]), self.of_turn(tie.b)
                return (self._bearer(tie.b) if tie.a is None else self.of_turn(tie.a)), self.of_turn(tie.b)
            case _:
                return None, None

    def _end(self, k: int | Turn | None) -> str:
        return GROUND if k is None else self.of_turn(k) if isinstance(k, Turn) else self.owner(k)

    def _bearer(self, turn: object) -> str:
        """What bears the joint of a turn, as long as it does not turn itself; else the ground."""
        if self.space or not isinstance(turn, Turn) or self.motions.still(turn.joint):
            return GROUND
        found = next((p for p in self.parts if p.point == turn.joint and p.name != turn.name), None)
        steady = found is not None and (found.frame is None or not self.motions.turns(found.frame))
        return self.body(found) if found is not None and steady else GROUND

    def rods(self) -> list[str]:
        """The rods between bodies that are held by something else."""
        pairs = couplers(self.motions, self.parts)
        return [f"a rod between {self.owner(a)} and {self.owner(b)}" for a, b in pairs]

    def string(self, string: PulleyString | Hoist | ArmGear) -> str:
        """What a string or a gear joins, and over what."""
        if isinstance(string, ArmGear):
            return f"a gear between {self.body(string.wheel)} and the rod of {self.owner(string.tip)}"
        if isinstance(string, Hoist):
            return f"a string from {self.body(string.load)} to the rim of {self.body(string.wheel)}"
        moving = self.owner(string.holder)
        over = (
            "a hole"
            if self.space
            else "a fixed pulley"
            if not string.holder
            else moving
            if "pulley" in moving
            else f"the pulley at {moving}"
        )
        first, second = (self.owner(end.point) for end in string.ends)
        way, loop = "through" if self.space else "over", ", which hangs in a loop" if string.fold == 2 else ""
        return f"a string from {first} {way} {over} to {second}{loop}"

    def constraints(self) -> Iterator[str]:
        for element in self.stage.model.constraints:
            if element.name in self.board.hidden:
                continue
            between: Any = getattr(element, "between", None)
            if isinstance(element, Rope):
                through = list(dict.fromkeys(self.of_point(p) for p in element.through))
                yield f"{said(element)} through {listed(through)}"
            elif isinstance(element, Rolling):
                continue  # said of its body
            elif between:
                ends = [self._beside(p, i, between) for i, p in enumerate(between)]
                yield f"{said(element)} joins {listed(list(dict.fromkeys(ends)))}"
            else:
                yield said(element)

    def _beside(self, point: Point, i: int, between: Sequence[Point]) -> str:
        """What a point of a joint belongs to, as long as that is another body than at the joint's other end."""
        other = self.stage.index(between[1 - i])
        known = next((p for p in self.parts if i and other in (p.point, *p.points)), None)
        return self.owner(self.stage.index(point), known)

    def actions(self) -> Iterator[str]:
        """Forces at points, torques, gravity."""
        tied = {t.element.name for t in self.ties}
        for element in self.stage.model.elements:
            if element.name in tied | set(self.board.hidden) or element.ledger in ("T*", "λ"):
                continue
            if isinstance(element, CircuitBranch):
                if isinstance(element, Transducer):
                    drives = f"drives {short(plain(element.on))}"
                    yield f"{said(element)} {self._turned(element) if isinstance(element.on, Frame) else drives}"
                continue
            at, on = getattr(element, "at", None), getattr(element, "on", None)
            if element.kind == "gravity":
                yield "gravity acts"
            elif isinstance(at, Point):
                reaction = getattr(element, "reaction", None)
                pair = f", its opposite on {self.of_point(reaction)}" if isinstance(reaction, Point) else ""
                yield f"{said(element)} acts on {self.of_point(at)}{pair}"
            elif on is not None:
                yield f"{said(element)} {self._turned(element)}"
            else:
                yield f"{said(element)} acts"

    def _turned(self, element: Element) -> str:
        on, reaction = getattr(element, "on"), getattr(element, "reaction", None)  # noqa: B009
        what, against = self.of_axes(on), self.of_axes(reaction) if reaction is not None else None
        if what is None:
            return "acts"
        if self.space and reaction is None and not isinstance(on, Frame) and (turn := self._turn_of(on)) is not None:
            carrier = self.carrier(self.stage.frames[turn.frame]) if turn.frame is not None else GROUND
            against = None if carrier == GROUND else carrier
        return f"turns {what}, its opposite {against}" if against else f"turns {what}"
