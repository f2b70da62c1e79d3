"""Events of a run: ``lagrangian.event(theta, terminal=True)``, or of the force in a constraint: ``event("rod")``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

import sympy as sp

from lagrangian.errors import ModelError, RunError
from lagrangian.model import Model, as_expr, check_name
from lagrangian.page.plain import plain
from lagrangian.records import dataclass, field
from lagrangian.simulate.quantities import quantity


@dataclass(frozen=True, eq=False)
class Event:
    """An expression of state and time that may cross zero, and what happens then; made by `event`.

    ``text``: the expression as it was given, if that was text. A model gives it its meaning (`of`).
    """

    expression: sp.Expr
    direction: int = 0
    terminal: bool = False
    reset: Mapping[Any, sp.Expr] = field(default_factory=dict)
    name: str = ""
    text: str = ""

    @property
    def title(self) -> str:
        """Its name, or its expression if it has no name."""
        return self.name or self.text or plain(self.expression)

    def of(self, model: Model) -> Event:
        """The event with its text read as an expression of a model. Raises `ModelError` if it is none."""
        if not self.text:
            return self
        what = f"the expression of the event '{self.title}'"
        return replace(self, expression=_changing(quantity(model, self.text, what), what))


def event(
    expression: Any,
    direction: int = 0,
    terminal: bool = False,
    reset: Mapping[Any, Any] | None = None,
    name: str = "",
) -> Event:
    """Return an event that occurs where ``expression``, of coordinates, rates, inputs, parameters and t, crosses zero.

    Text is read like a quantity of a run: ``"x - 0.5*l"``, or a constraint's row for its multiplier, as in
    ``event("rod", direction=1)``, where a rod begins to push and a rope goes slack.
    ``direction``: +1 if it rises, −1 if it falls, 0 for both. ``terminal`` ends the run there. ``reset`` maps states to
    their values after the event, as expressions of the state before: ``reset={y.diff(): -e*y.diff()}`` is an impact.

    >>> from sympy.physics.mechanics import dynamicsymbols
    >>> y = dynamicsymbols("y")
    >>> event(y, direction=-1, reset={y.diff(): -0.9*y.diff()}, name="bounce").title
    'bounce'
    """
    if direction not in (-1, 0, 1) or isinstance(direction, bool):
        raise ModelError(
            f"the direction of an event is -1, 0 or 1 (got {direction!r:.20})",
            fix="use 1 for a rising expression, -1 for a falling one, 0 for both",
            code="E406",
        )
    if name:
        check_name(name, "event")
    text = expression.strip() if isinstance(expression, str) else ""
    if isinstance(expression, str) and not text:
        raise ModelError("the text of an event is empty", fix='lagrangian.event("x - 0.5")', code="E406")
    made = sp.Symbol(text) if text else _changing(expression, "the expression of an event")
    if reset is not None and not isinstance(reset, Mapping):
        raise ModelError(
            "reset must be a mapping from states to values", fix="reset={y.diff(): -0.9*y.diff()}", code="E406"
        )
    after = {state: as_expr(value, f"the value of {state} after an event") for state, value in (reset or {}).items()}
    return Event(made, int(direction), bool(terminal), after, name, text)


def _changing(expression: Any, what: str) -> sp.Expr:
    made = as_expr(expression, what)
    if made.is_number:
        raise ModelError(
            f"the event's expression {made} never changes", fix="give an expression of the state", code="E416"
        )
    return made


def events_of(model: Model, given: Any) -> tuple[Event, ...]:
    """Return one event or several as a tuple, their texts read as expressions of a model; see `listed_events`."""
    return tuple(event.of(model) for event in listed_events(given))


def listed_events(given: Any) -> tuple[Event, ...]:
    """Return one event or several as a tuple. Raises `RunError` for other objects, and for two events of the same
    name."""
    listed = tuple(given) if isinstance(given, Iterable) else (given,)
    for e in listed:
        if not isinstance(e, Event):
            raise RunError(
                f"an event is made with lagrangian.event(…) (got {type(e).__name__})",
                fix="events=[lagrangian.event(theta, terminal=True)]",
                code="E501",
            )
    titles = [e.title for e in listed]
    for title in titles:
        if titles.count(title) > 1:
            raise RunError(f"two events are called '{title}'", fix="give them names", code="E404")
    return listed
