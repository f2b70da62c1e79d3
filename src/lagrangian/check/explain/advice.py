"""What is advised, as it fits the answer and the place: forces and moments to who wrote no energy, the product rule for
a term with rates that is missing, a mass or a moment of inertia for what stands before an acceleration.

Mistakes say why something is wrong by their kind; here it is chosen by what was written.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.candidates import ingredients_of
from lagrangian.check.explain.misconceptions import (
    effort_term_forgotten,
    force_component,
    prescribed_sign,
    product_rule,
    reaction_forgotten,
    reaction_sign,
)
from lagrangian.check.explain.misconceptions.base import put
from lagrangian.check.explain.own_terms import WHY_FORCE
from lagrangian.check.explain.ratios import WHY as WHY_RATIO
from lagrangian.check.explain.say import ANGLES, LETTERS, UNITS, WAY, WHY_PART
from lagrangian.check.explain.without_energies import WHY_EQUATION, silent_energies
from lagrangian.check.reference import Reference
from lagrangian.check.verdict import DERIVED, AnsweredLine, Mistake, Verdict
from lagrangian.model import Damper, Spring
from lagrangian.page.formula import Text, text
from lagrangian.values.dimensions import NONE

GENERAL = (WHY_PART[5], str(WHY_EQUATION))
"""What is advised where nothing is known of a term but that it is wrong."""
NUMBERS = ("number", "factor_of", "factor_missing", "foreign_factor", "divided_by", "divisor", "twice", "half")
MISSING = ("forgotten", "left_out")
"""What was done to a term, by parts of the names of mistakes."""
IN_A_CIRCLE = "What goes in a circle is accelerated towards its centre"
OF_CORIOLIS = "The Coriolis acceleration is twice the angular velocity times the velocity relative to what turns."
OF_TWO_RATES = text(
    "Such a term comes from d/dt of a product, as of s² θ̇: the derivative of the square is 2 s ṡ. In a balance of "
    "forces or moments it is the Coriolis acceleration, with the same factor 2."
)
OF_SQUARED_RATE = text(
    "The square of one rate comes from ∂T*/∂ξ of a factor that depends on a position, with the ½ of T*, or from d/dt "
    "of a rate times such a factor. In a balance of forces or moments it is the centripetal acceleration, ω² times "
    "the distance."
)
OF_A_SQUARE = text("The derivative of a square is twice what is squared: of c ξ̇² it is 2 c ξ̇.")
OF_TWICE = text(
    "Is a factor 2 counted twice? A square brings it once when it is differentiated, and the sine of a double angle "
    "contains it: 2 sin a cos a = sin 2a."
)
OF_INERTIA = text(
    "What stands before an acceleration is a mass or a moment of inertia: m a² for a mass at the distance a from the "
    "axis, and for a body that turns also J about its centre of mass."
)
OF_COUPLING = text(
    "Such a factor couples two coordinates: a mass times how far each of them moves it, as far as both move it in the "
    "same direction, and a moment of inertia where both turn the body."
)
OF_MOVED = text("Every body that this coordinate moves counts here: its mass, and if it turns its moment of inertia.")
OF_MOTION = text(
    f"{IN_A_CIRCLE}, what moves along something that turns has a Coriolis acceleration, and what is carried has the "
    "acceleration of what carries it."
)
OF_PLACES = text(
    "Change this coordinate alone: which weights rise or sink, which springs change their length, and which forces do "
    "work?"
)
WHOLE_FORCE = text(
    "In which direction does the force act, and in which does its point move? Where both agree, it counts whole."
)
OF_RESISTANCE = text(
    "Each damper and each friction counts once: how many act along this coordinate, and how fast does each one's "
    "deflection grow with it?"
)
AS_ABOVE = text("The generalized force is right: it stands in the equation as it is, with all its factors.")
OTHER_SIDE = text("The generalized force is right: what is moved to the other side of an equation changes its sign.")
WHOLE_VELOCITY = text(
    "It feels the whole velocity of the point on which it acts, against what it rubs on: what carries the body counts."
)
OF_WHOLE_VELOCITY = text(f"A resistance feels {str(WHOLE_VELOCITY).removeprefix('It feels ')}")
OF_BODIES = text("Every mass and every moment of inertia that moves counts: go through the sketch, body by body.")
TERM_BY_TERM = text("Go through this equation once more, term by term.")
_INERTIA = text(
    "J is the moment of inertia about the centre of mass; about another axis, m a² is added, with its distance a."
)
_FORCES = text(
    "A force stands in the equation of a coordinate only if it does work when this coordinate alone changes."
)
_CIRCLE = text(f"{IN_A_CIRCLE}: in which direction does this term push?")
_MOTION = text(f"{IN_A_CIRCLE}, and what moves along something that turns has a Coriolis acceleration.")
_SPRING = text("The force of a spring is its stiffness times its deflection, and it pulls back.")
BALANCES: Mapping[str, Text] = {
    "coriolis_half": text(OF_CORIOLIS),
    "gradient_sign": _CIRCLE,
    "gradient_forgotten": _MOTION,
    "velocity_terms_forgotten": _MOTION,
    "product_rule": text(
        "An acceleration is d/dt of a velocity: what multiplies a rate in it changes in time as well."
    ),
    "coupling_forgotten": text("A body is accelerated by every coordinate that moves it."),
    "inertia_left_out": text("Mass times acceleration, and moment of inertia times angular acceleration, count whole."),
    "element_forgotten": text("Go through the sketch: which springs, dampers, weights and forces act here?"),
    "element_twice": text("Go through the sketch: every spring, damper, weight and force acts once."),
    "force_arm": text(
        "The moment of a force is the force times its arm; through a gear, a torque acts with its ratio."
    ),
    "force_sign": text("A force counts positive if it pushes in the direction in which the coordinate grows."),
    "force_wrong_equation": _FORCES,
    "input_everywhere": _FORCES,
    "gravity_sign": text(
        "A weight pulls downwards: against a coordinate that lifts the body, with one that lowers it."
    ),
    "gravity_forgotten": text("Every body has its weight: does it push or turn along this coordinate?"),
    "gravity_arm": text("The moment of a weight is the weight times the horizontal distance of the centre of mass."),
    "height_relative": text("How far does the centre of mass rise when this coordinate alone changes?"),
    "spring_half_forgotten": _SPRING,
    "spring_square_forgotten": _SPRING,
    "rest_forgotten": text("The force of a spring is its stiffness times its deflection from its neutral point."),
    "rotation_forgotten": text("What turns a body faster counts as well: J times its angular acceleration."),
    "translation_forgotten": _INERTIA,
    "inertia_about_pivot": _INERTIA,
    "half_forgotten": OF_INERTIA,
    "relative_speed": text("What carries the body moves, too: its acceleration is the sum of both."),
    "xi_sign": text("Forces and moments count with the sign that they have beside mass times acceleration."),
}
"""Why something is wrong in a balance of forces or moments."""
OF_STEPS: Mapping[str, Text] = {
    WHY_PART[2]: text("Which rates move this body, and how do they stand in its velocity and its angular velocity?"),
    str(WHY_FORCE): text("A force acts with its part along the motion; its moment is the force times its arm."),
    str(prescribed_sign.WHY): text(
        "What carries a body accelerates it, too, in the sense in which it moves; the second derivative of a sine or "
        "cosine has the opposite sign."
    ),
    WHY_PART[3]: text("A spring pulls by its stiffness times its deflection, a weight pulls downwards."),
}
"""The same for what is said of every mistake in an energy, or in a force."""
OPPOSITE = text("Action and reaction are opposite: two bodies are pushed in opposite directions.")
"""Why both ends of a force have opposite signs, where no motor has a circuit."""
_LAGRANGE = re.compile(r"T\*|∂|ℒ|Ξ|L |[Ee]nerg|\bV\b|square")
"""The words of Lagrange's equations."""
_OF_ENERGIES = re.compile(r"kinetic energy|energy of|∂|d/dt")


def with_fitting_advice(truth: Reference, lines: Sequence[AnsweredLine], verdict: Verdict) -> Verdict:
    """The verdict, with the advice of its mistakes as it fits the ``lines`` of the answer, and without second choices
    that speak of energies which nobody wrote."""
    balances = without_lagrange(lines)
    right = {f.line.name for f in verdict.findings if f.line.kind == "Xi" and f.status.right}
    dampers = [_as_of_resistance(truth, _as_of_damper(truth, m, right)) for m in verdict.mistakes]
    told = tuple(replace(m, why=_fitting(truth, m, balances, right)) for m in dampers)
    others = [m for m in verdict.alternatives if not (balances and _is_of_lagrange(m))]
    return replace(verdict, mistakes=told, alternatives=tuple(others))


def without_lagrange(lines: Sequence[AnsweredLine]) -> bool:
    """Whether an answer has no energy, no generalized force and no derivative of these: balances, or results alone."""
    kinds = {line.kind for line in lines}
    return silent_energies(lines) == {"T*", "V"} and kinds.isdisjoint(("Xi", "D", "p", *DERIVED))


def _is_of_lagrange(mistake: Mistake) -> bool:
    """Whether a mistake can only be made in an energy, or in a derivative of one."""
    return mistake.name == "inner_derivative" or _OF_ENERGIES.search(str(mistake.what)) is not None


def _as_of_damper(truth: Reference, mistake: Mistake, right: Collection[str | None]) -> Mistake:
    """A mistake in the number of a term with the constant of a damper, as one of step 6: no derivative brings it."""
    formulas = [x for x in mistake.what.parts if isinstance(x, sp.Expr) and not x.is_number]
    number = any(x in mistake.name for x in NUMBERS)
    if not formulas or not number or mistake.step != 5 or str(mistake.why) not in GENERAL:
        return mistake
    dampers = [truth.expand(e.b) for e in truth.model.elements if isinstance(e, Damper) and e.b is not None]
    own = set[sp.Basic]().union(*map(bounded.letters, dampers)) - bounded.letters(truth.T) - bounded.letters(truth.V)
    if not formulas[0].atoms(sp.Derivative) or not bounded.letters(formulas[0]) & own:
        return mistake
    return replace(mistake, step=6, why=AS_ABOVE if mistake.coordinate in right else OF_RESISTANCE)


def _as_of_resistance(truth: Reference, mistake: Mistake) -> Mistake:
    """A term with a rate and the constant of a resistance that is missing, as one of step 6: nothing is accelerated."""
    formulas = [x for x in mistake.what.parts if isinstance(x, sp.Expr) and not x.is_number]
    missing = any(x in mistake.name for x in MISSING) and str(mistake.why) in GENERAL
    if mistake.step != 5 or not formulas or not missing or mistake.coordinate is None:
        return mistake
    rates = formulas[0].atoms(sp.Derivative)
    if not rates or any(d.derivative_count > 1 for d in rates):
        return mistake
    s = ingredients_of(truth.derivation)
    shares = [x for e in s.resisting for x in s.shares(e).values()]
    own = set[sp.Basic]().union(*map(bounded.letters, shares)) - bounded.letters(truth.T) - bounded.letters(truth.V)
    held = {x for x in bounded.letters(formulas[0]) & own if isinstance(x, sp.Symbol)}
    if not held:
        return mistake
    i = next(k for k, c in enumerate(truth.model.coordinates) if c.name == mistake.coordinate)
    several = sum(t.has(*held) for t in sp.Add.make_args(bounded.expand(truth.Xi[i]))) > 1
    return replace(mistake, step=6, why=OF_WHOLE_VELOCITY if several else OF_RESISTANCE)


def _fitting(truth: Reference, mistake: Mistake, balances: bool, right: Collection[str | None]) -> Text:
    """Why something is wrong, by the kind of the change and by what the term holds; ``right`` are the coordinates
    whose generalized force is right."""
    why = str(mistake.why)
    if why == str(reaction_sign.WHY) and not truth.model.charges:
        return OPPOSITE
    if why in GENERAL:
        return _of_term(truth, mistake, balances)
    special = _of_ratio(truth, mistake) or _of_efforts(truth, mistake, why, right)
    if special is not None:
        return special
    if balances and mistake.name == "element_forgotten" and mistake.step == 2:
        return OF_BODIES
    if balances and mistake.name in BALANCES and _LAGRANGE.search(why):
        return BALANCES[mistake.name]
    if balances and why in OF_STEPS:
        return OF_STEPS[why]
    return mistake.why


def _of_ratio(truth: Reference, mistake: Mistake) -> Text | None:
    """What is advised where units say nothing: of a ratio, or of a pure number; None for anything else."""
    formulas = [x for x in mistake.what.parts if isinstance(x, sp.Expr)]
    if str(mistake.why) != UNITS or not formulas:
        return None
    letters = bounded.letters(formulas[-1])
    dims = ingredients_of(truth.derivation).dimensions
    if not letters or not all(isinstance(x, sp.Symbol) for x in letters) or dims is None:
        return None
    dim = dims.of(formulas[-1])
    return WHY_RATIO if dim is not None and not dim.unknown and dim == NONE else None


def _of_efforts(truth: Reference, mistake: Mistake, why: str, right: Collection[str | None]) -> Text | None:
    """What is advised for a force that counts with too small a part, for one that was moved to the other side with the
    wrong sign, and for a resistance that lacks what carries the body; None for anything else."""
    formulas = [x for x in mistake.what.parts if isinstance(x, sp.Expr)]
    turned = mistake.name == "arm" and [x.has(sp.sin, sp.cos) for x in formulas[-2:]] == [True, False]
    if turned or (mistake.name == "foreign_factor" and why == str(WHY_FORCE)):
        return WHOLE_FORCE
    if mistake.step == 6 and "sign" in mistake.name and mistake.coordinate in right:
        return OTHER_SIDE
    if why not in (WAY, str(force_component.WHY), str(effort_term_forgotten.WHY)) or mistake.step != 6:
        return None
    resisting = [e.title for e in ingredients_of(truth.derivation).resisting]
    return WHOLE_VELOCITY if mistake.element in resisting else None


def _of_term(truth: Reference, mistake: Mistake, balances: bool) -> Text:
    """What is advised for a term that is missing or has another number, sign, letter or function."""
    general = WHY_EQUATION if balances else text(WHY_PART[5])
    formulas = [x for x in mistake.what.parts if isinstance(x, sp.Expr) and not x.is_number]
    if balances and "sign" in mistake.name and _is_between(truth, mistake):
        return reaction_forgotten.WHY
    if not formulas or "sign" in mistake.name:
        return general
    if mistake.name == "letter":
        return text(LETTERS)
    moving = formulas[0].atoms(sp.Derivative)
    accelerated = any(d.derivative_count > 1 for d in moving)
    if any(x in mistake.name for x in NUMBERS):
        more = any(x in str(mistake.what) for x in (" too much", " twice"))
        if accelerated or not moving or more:
            return _of_accelerated(mistake, formulas[0]) if accelerated else OF_TWICE if moving else TERM_BY_TERM
        return _of_rates(formulas[0])
    if any(x in mistake.name for x in MISSING):
        if not moving:
            return OF_PLACES
        return OF_MOVED if accelerated else OF_MOTION if balances else product_rule.WHY
    if len(formulas) > 1 and _turns(formulas[0], formulas[1]):
        return text(ANGLES)
    return TERM_BY_TERM


def _of_accelerated(mistake: Mistake, term: sp.Expr) -> Text:
    """What is advised for what stands before an acceleration: that of the equation's own coordinate, of which it is a
    mass or a moment of inertia, or that of another one."""
    moving = {d.args[0] for d in term.atoms(sp.Derivative) if isinstance(d, sp.Derivative) and d.derivative_count > 1}
    if mistake.coordinate is None:
        return OF_COUPLING if term.has(sp.sin, sp.cos) else OF_INERTIA
    return OF_INERTIA if any(str(getattr(x, "func", x)) == mistake.coordinate for x in moving) else OF_COUPLING


def _of_rates(term: sp.Expr) -> Text:
    """What is advised for the number of a term with a rate, by whether it has two different ones or a square."""
    if isinstance(term, sp.Add):
        return TERM_BY_TERM
    powers = [f.as_base_exp() for f in sp.Mul.make_args(term)]
    rates = [(x, int(n) if n.is_Integer else 1) for x, n in powers if x.atoms(sp.Derivative)]
    if sum(n for _, n in rates) < 2:
        return OF_A_SQUARE
    if len(rates) > 1:
        return OF_TWO_RATES
    return OF_SQUARED_RATE if rates[0][0].is_Derivative else TERM_BY_TERM


def _is_between(truth: Reference, mistake: Mistake) -> bool:
    """Whether a mistake is in a spring or a damper that several coordinates deform."""
    elements = [e for e in truth.model.elements if e.title == mistake.element]
    moves = [e.extension(truth.model) for e in elements if isinstance(e, Spring)]
    moves += [e.rate(truth.model) for e in elements if isinstance(e, Damper)]
    return any(sum(truth.expand(x).has(c.symbol) for c in truth.model.coordinates) > 1 for x in moves)


def _turns(one: sp.Expr, other: sp.Expr) -> bool:
    """Whether two terms differ in their sines and cosines alone."""
    flat = [put(x, dict.fromkeys(x.atoms(sp.sin, sp.cos), sp.S.One)) for x in (one, other)]
    return flat != [one, other] and flat[0] in (flat[1], -flat[1])
