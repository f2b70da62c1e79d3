"""Step 6: the nonconservative Ξ_i, by virtual work and by the box rule, with the reason for each."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Mapping

import sympy as sp

from lagrangian import bounded
from lagrangian.derive.algebra import Form
from lagrangian.derive.circuits import named_losses, nothing_acts, step_six, through
from lagrangian.derive.context import Context, big_xi, fit
from lagrangian.derive.coordinates import chain_of
from lagrangian.derive.derived import Step
from lagrangian.derive.ends import find_ends
from lagrangian.model import DEFLECTION, Action, Damper, Element, Friction, Model, Point, Words, time
from lagrangian.page.formula import (
    Check,
    Heading,
    Item,
    Left,
    Minus,
    Name,
    Partial,
    Product,
    Square,
    Table,
    Terms,
    Text,
    Variation,
    Verbatim,
    formula,
    text,
)
from lagrangian.records import dataclass


@dataclass(frozen=True, eq=False)
class Contribution:
    """The contribution of one element to one Ξ_i: by virtual work, by the box rule, and the reason in words.

    ``pieces`` is the virtual work of each action, before anything cancels.
    """

    element: Element
    index: int
    pieces: tuple[Form, ...]
    virtual: Form
    box: Form
    story: Text

    @property
    def resists(self) -> bool:
        """Whether it is damping, which the final equation has on the left."""
        return self.element.resists


def contributions(context: Context) -> tuple[Contribution, ...]:
    """The contribution of every element to every Ξ_i, computed in two ways."""
    model, algebra = context.model, context.algebra
    found: list[Contribution] = []
    for element in model.elements:
        if element.ledger != "Ξ":
            continue
        works = element.works(model)
        ends = find_ends(model, element)
        for i, c in enumerate(model.coordinates):
            pieces = tuple(algebra.form(_along((work,), c.rate)) for work in works)
            virtual, box = algebra.total(pieces), algebra.form(_along(ends, c.rate))
            found.append(Contribution(element, i, pieces, virtual, box, _story(context, element, ends, i, virtual)))
    return tuple(found)


def _along(actions: tuple[Action, ...], rate: sp.Expr) -> sp.Expr:
    """Σ effort · ∂rate/∂ξ̇_i."""
    return sp.Add(*[a.effort * bounded.diff(a.rate, rate) for a in actions])


def _story(context: Context, element: Element, ends: tuple[Action, ...], index: int, virtual: Form) -> Text:
    """The box rule in words: which ends are inside the box of everything that moves with ξ_i alone."""
    if (said := through(context.model, element, ends, index)) is not None:
        return said
    c = context.model.coordinates[index]
    inside: list[Words] = []
    outside: list[Words] = []
    for end in ends:
        words = inside if bounded.diff(end.rate, c.rate) != 0 else outside
        if end.on not in words:
            words.append(end.on)
    outside = [w for w in outside if w not in inside]
    listed, beyond = _and(inside), _and(outside or [(element.title,)])
    if not inside:
        if outside and outside[0] == DEFLECTION:
            return text(*beyond, " does not change with the box: it adds nothing")
        one = len(outside) <= 1
        inner = {(body.title,) for body in context.wiggle.moved[index]}
        if riding := [end for end in ends if end.on in inner]:
            how = "move along the force" if isinstance(riding[0].target, Point) else "turn"
            return text(
                *beyond, f" {'does' if one else 'do'} not {how} when only ", c.symbol, " moves: it adds nothing"
            )
        return text(*beyond, f" {'is' if one else 'are'} outside the box: it adds nothing")
    if virtual.is_zero:
        if len(inside) > 1:
            return text(*listed, " are inside the box and move together: the pair cancels")
        return text(*listed, " moves, but not along the force: no work")
    if outside:
        return text(*listed, " is inside the box, ", *beyond, " outside: it counts")
    if ends[0].on == DEFLECTION:
        return text("its deflection changes with the box: it counts")
    return text(*listed, f" {'is' if len(inside) == 1 else 'are'} inside the box: it counts")


def _and(words: list[Words]) -> Words:
    """Join several items with "and"."""
    return tuple(part for w in words for part in (*w, " and "))[:-1]


def forces(context: Context, found: tuple[Contribution, ...], relative: Mapping[sp.Expr, sp.Expr | None]) -> Step:
    """Every Ξ_i with its table, the dampers by Rayleigh's function and as fake springs, and the reasons.

    ``relative`` says what each coordinate is measured from, as determined in step 1.
    """
    model = context.model
    items: list[Item] = []
    acting = [e for e in model.elements if e.ledger == "Ξ"]
    if not acting:
        items.append(text(f"No {nothing_acts(model)} was described: nothing non-conservative acts."))
    for element in acting:
        items += _virtual_work(context, element)
    xi_of: dict[sp.Expr, sp.Expr] = {}
    reasons: list[Text] = []
    checks: list[Check] = []
    for i, c in enumerate(model.coordinates):
        mine = [f for f in found if f.index == i]
        total = context.algebra.total([f.virtual for f in mine])
        xi_of[c.symbol] = total.expr()
        items += _coordinate(context, i, mine, relative) if acting else []
        items.append(formula(big_xi(i), fit(xi_of[c.symbol]), brief=True))
        reasons.append(_reason(model, i, mine, xi_of[c.symbol]))
        difference = context.algebra.total([f.virtual - f.box for f in mine])
        if acting:
            checks.append(
                Check(
                    text(big_xi(i), " by virtual work equals ", big_xi(i), " by the box"), difference.is_zero, "exact"
                )
            )
    for friction in model.frictions:
        items += _two_regimes(context, friction)
    dampers = [e for e in acting if e.dissipation(model) is not None]
    if dampers:
        rayleigh, holds = _dampers(context, dampers, found)
        fake = ", the fake spring" if not model.branches or any(isinstance(e, Damper) for e in dampers) else ""
        items += rayleigh
        checks.append(
            Check(text(f"{named_losses(dampers)}: Rayleigh's function{fake} and virtual work agree"), holds, "exact")
        )
    what, why = step_six(model)
    return Step(
        6,
        "Non-conservative forces",
        what,
        why,
        tuple(items),
        {"Xi": xi_of},
        tuple(reasons),
        tuple(checks),
    )


def _virtual_work(context: Context, element: Element) -> list[Item]:
    """δW = F δ(displacement) = Σ F ∂(displacement)/∂ξ_i δξ_i."""
    model = context.model
    items: list[Item] = [Heading(text(element.title[:1].upper() + element.title[1:]))]
    works = element.works(model)
    work = Variation(Name("W", element.name))
    virtual: list[Left] = []
    expanded: list[Left] = []
    for action in works:
        effort = context.readable(action.effort)
        if action.displacement is not None:
            virtual.append(_product(effort, Variation(context.readable(action.displacement))))
    for c in model.coordinates:
        coefficient = context.algebra.form(_along(works, c.rate))
        if not coefficient.is_zero:
            expanded.append(_product(coefficient.expr(), Variation(c.symbol)))
    sides: list[Left] = [work]
    if virtual and len(virtual) == len(works) and len(virtual) <= 3:
        sides.append(Terms(tuple(virtual)))
    result: Left = Terms(tuple(expanded)) if expanded else sp.S.Zero
    if str(result) != str(sides[-1]):
        sides.append(result)
    items.append(formula(*sides))
    return items


def _two_regimes(context: Context, friction: Friction) -> list[Item]:
    """What a friction does while it slips, and the row that takes its place while it sticks."""
    model = context.model
    rate = friction.rate(model)
    lam = sp.Symbol("lambda")
    shown, limit = context.readable(rate), context.readable(friction.sticking_limit)
    items: list[Item] = [
        Heading(text(f"{friction.title[:1].upper()}{friction.title[1:]}: it slips or it sticks")),
        text("While it slips, ", fit(shown), " is not 0, and its effort on the deflection is"),
        text(fit(context.readable(friction.effort(model, rate)))),
        *_pressed(context, friction),
        text(
            "Where that rate reaches 0, it sticks if it can hold: the rate stays 0, which is a constraint, and the "
            "multiplier ",
            lam,
            " of this row takes the place of the effort:",
        ),
        formula(fit(shown), sp.S.Zero, note=text("while ", friction.title, " sticks"), brief=True),
    ]
    for i, c in enumerate(model.coordinates):
        slope = bounded.diff(rate, c.rate)
        if slope != 0:
            share = context.algebra.form(lam * slope).expr()
            items.append(text("It then adds ", fit(share), " to ", big_xi(i), "."))
    items.append(
        text(
            "This lasts as long as |",
            lam,
            "| is not above ",
            fit(limit),
            ". Beyond that it slips, in the direction opposite to ",
            lam,
            ".",
        )
    )
    return items


def _pressed(context: Context, friction: Friction) -> list[Item]:
    """What the normal force is, if it is a multiplier."""
    if not friction.pressing:
        return []
    kept = f"the constraint{'s' * (len(friction.pressing) > 1)} " + " and ".join(f"'{r}'" for r in friction.pressing)
    return [
        text(
            "Its normal force ",
            fit(context.readable(friction.normal_force)),
            f" is what keeps {kept}, and depends on the friction in its turn: the "
            "equations and the rows are solved for both together.",
        )
    ]


def _product(effort: sp.Expr, what: Left) -> Left:
    if effort == 1:
        return what
    if effort.could_extract_minus_sign():
        inner = -effort
        return Minus(what if inner == 1 else Product((fit(inner), what)))
    return Product((fit(effort), what))


def _coordinate(
    context: Context, index: int, mine: list[Contribution], relative: Mapping[sp.Expr, sp.Expr | None]
) -> list[Item]:
    """The box of ξ_i, and the table of what is inside it."""
    model = context.model
    c = model.coordinates[index]
    moved = context.wiggle.moved[index]
    children = chain_of(relative, c.symbol)
    listed = ", ".join(b.title for b in moved) if len(moved) <= 6 else f"{len(moved)} bodies"
    parts: list[str | Left] = ["Wiggle only ", c.symbol, f". In the box: {listed or 'what moves with it'}"]
    if children:
        ride = ["child", "rides"] if len(children) == 1 else ["children", "ride"]
        parts += [f" (with its {ride[0]} ", *[p for s in children for p in (s, ", ")][:-1], f", which {ride[1]} along)"]
    rows = tuple(
        (
            text(f.element.title),
            f.story,
            text(Terms(tuple(fit(p.expr()) for p in f.pieces if not p.is_zero))),
            text(fit(f.virtual.expr())),
        )
        for f in mine
    )
    header = (text("element"), text("the box"), text("virtual work"), text("adds"))
    return [
        Heading(text(big_xi(index), " for ", c.symbol)),
        text(*parts, "."),
        Table(header, rows),
    ]


def _reason(model: Model, index: int, mine: list[Contribution], value: sp.Expr) -> Text:
    if not mine:
        return text(big_xi(index), f" = 0: no {nothing_acts(model)} was described")
    counted = [f for f in mine if not f.virtual.is_zero] or mine
    parts: list[str | Left | Verbatim] = [big_xi(index), " = ", fit(value), ": "]
    for f in counted:
        parts += [f"{f.element.title}: ", *f.story.parts, "; "]
    return text(*parts[:-1])


def _dampers(context: Context, dampers: list[Element], found: tuple[Contribution, ...]) -> tuple[list[Item], bool]:
    """D = ½ b δ̇² with Ξ_i = −∂D/∂ξ̇_i, and each damper treated as a spring whose deflection becomes its rate."""
    model = context.model
    items: list[Item] = [Heading(text(_heading(dampers)))]
    holds = True
    for element in dampers:
        energy = element.dissipation(model)
        assert energy is not None
        form = context.form(energy)
        name = Name("D", element.name if element.name != "D" else "")
        if isinstance(element, Damper):
            squared = Square(element.b / 2, (context.readable(element.rate(model)),))
            items.append(formula(name, squared))
        else:
            items.append(formula(name, fit(form.expr())))
        for f in found:
            if f.element is not element:
                continue
            c = model.coordinates[f.index]
            rayleigh = -form.diff(c.rate)
            holds = holds and (rayleigh - f.virtual).is_zero
            if rayleigh.is_zero:
                continue
            items.append(formula(Minus(Partial(name, c.rate)), fit(rayleigh.expr())))
            if isinstance(element, Damper):
                spring, damped = _fake_spring(context, element, c.symbol)
                holds = holds and (context.form(damped) + f.virtual).is_zero
                items.append(
                    text(
                        "Fake spring: a spring in its place would put ",
                        fit(context.readable(spring)),
                        " on the left; its deflection becomes its rate: ",
                        fit(context.readable(damped)),
                    )
                )
    return items, holds


def _heading(dampers: list[Element]) -> str:
    words = named_losses(dampers)
    fake = " and as fake springs" if words != "resistors" else ""
    return f"{words[:1].upper()}{words[1:]}, by Rayleigh's function{fake}"


def _fake_spring(context: Context, damper: Damper, symbol: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """∂(½ b δ²)/∂ξ_i = b δ ∂δ/∂ξ_i, and the same with δ replaced by δ̇."""
    delta = damper.displacement(context.model)
    slope = bounded.diff(delta, symbol)
    return damper.b * delta * slope, damper.b * bounded.diff(delta, time) * slope
