"""The words for a local change: what was done, why it is wrong, and, for a hint, where without what.

One entry a kind. A sentence never speaks of a line that the answer may not have: "the weight of the bob", not "your V".
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from typing import cast

import sympy as sp

from lagrangian import bounded
from lagrangian.check.explain.changes.change import LocalChange, Site, Words
from lagrangian.check.explain.rates_apart import rates_apart
from lagrangian.check.explain.rotations_said import OMEGA, inertias, of_rotation, why_omega
from lagrangian.check.hints import capital, sentence
from lagrangian.check.terms.alike import put_together
from lagrangian.check.terms.signs import opposed, turned, without_double_sign
from lagrangian.check.verdict import Mistake
from lagrangian.model import Model, RigidBody, Spring
from lagrangian.page.formula import Left, Text, text
from lagrangian.records import dataclass


@dataclass(frozen=True)
class KindWords:
    """The words of one kind: parts in which ``{site}``, ``{right}`` and ``{written}`` are filled in."""

    what: str
    brief: str
    why: str


SIGN = "In {site}, {right} has the wrong sign.", "There is a wrong sign in {brief}."
PLURALS = (
    "the terms",
    "the velocity terms",
    "the products",
    "the weights",
    "the energies",
    "the kinetic energies",
    "the kinetic energy and the weight",
)
"""How the words of a site begin that ask for a verb in the plural."""

LETTERS = "Keep to the letters of the sketch: every element has its own length, mass, stiffness and damping."
UNITS = "Compare the units of this term with those of its neighbours in the same equation."
ANGLES = "Look where the angle is measured from, and try a special position, such as an angle of zero."

WHY_PART = {
    2: "Every body has the kinetic energy of its translation and, if it turns, that of its rotation. Take the total "
    "velocity, seen from the ground.",
    3: "Every spring and every weight has its own potential energy: the whole deflection is squared, and heights are "
    "counted upwards.",
    5: "Go through ∂L/∂ξ̇, its d/dt and ∂L/∂ξ once more, term by term, and mind the signs.",
    6: "Change only this coordinate a little. Does the point where the force acts move, and how far?",
}
NO_WORK = (
    "Change only this coordinate a little. Where what the force or torque acts on does not move, or both its ends move "
    "together, it does no work, and is not in this Ξ."
)
WHY_NUMBER = "Check the factor in front of the mass or moment of inertia."
WHY_INERTIA = f"{WHY_NUMBER} Is the moment of inertia about the centre of mass?"
WHY_PRODUCTS = "A sum is squared as a whole, and velocities add before they are squared: (a + b)² = a² + 2 a b + b²."
WAY = "Go along the way from the fixed point to the body: every piece of it counts, with its direction."
VELOCITY = "The velocity is the derivative of the position; every coordinate that moves the body adds to it."
MEASURE = "Look at the sketch: how far is it, and does the number belong to this length or to another one?"
DEFLECTION = "The deflection of a spring is the motion of one end relative to the other, less the rest length."
DAMPER = "A damper feels the velocity of one end relative to the other."

KINDS: Mapping[str, KindWords] = {
    "letter": KindWords(
        "In {site}, {written} stands in place of {right}.", "A letter in {brief} is not the right one.", LETTERS
    ),
    "exchanged": KindWords(
        "In {site}, {right} and {written} are exchanged.", "Two letters are exchanged in {brief}.", LETTERS
    ),
    "lost": KindWords("In {site}, the factor {right} is missing.", "A factor is missing in {brief}.", UNITS),
    "lost_in_a_sum": KindWords("In {site}, the factor {right} is missing.", "A factor is missing in {brief}.", UNITS),
    "left_out_of_a_sum": KindWords("In {site}, {right} is left out.", "Something is left out in {brief}.", WAY),
    "sign_in_a_sum": KindWords(
        "In {site}, {right} has the wrong sign.",
        "There is a wrong sign in {brief}.",
        "Go along the way from the fixed point to the body, and mind the direction of every piece.",
    ),
    "not_squared": KindWords(
        "In {site}, {right} stands once, and belongs there squared.", "Something in {brief} is not squared.", UNITS
    ),
    "squared": KindWords(
        "In {site}, {right} stands squared, and belongs there once.",
        "Something in {brief} is squared that should not be.",
        UNITS,
    ),
    "inverted": KindWords(
        "In {site}, {right} stands on the wrong side of the fraction line.",
        "A factor in {brief} stands on the wrong side of a fraction line.",
        UNITS,
    ),
    "sine_cosine": KindWords(
        "In {site}, {written} stands in place of {right}.", "There is a wrong sine or cosine in {brief}.", ANGLES
    ),
    "tangent": KindWords(
        "In {site}, {written} stands in place of {right}.", "There is a wrong function of an angle in {brief}.", ANGLES
    ),
    "angle": KindWords(
        "In {site}, {written} stands in place of {right}: the angle is another one.",
        "The angle in {brief} is not the right one.",
        "Measure every angle from the direction that the formula means; an absolute angle is a sum of relative ones.",
    ),
    "double_angle": KindWords(
        "In {site}, {written} stands in place of {right}.", "The angle in {brief} is not the right one.", ANGLES
    ),
    "small_angle": KindWords(
        "In {site}, {right} was replaced by {written}, as if the angle were small.",
        "Something in {brief} holds for small angles only.",
        "Nothing says that the motion is small.",
    ),
    "rate": KindWords(
        "In {site}, {written} stands in place of {right}.",
        "There is a wrong rate in {brief}.",
        "Ask of every rate whether it is absolute, or relative to what carries it.",
    ),
    "acceleration": KindWords(
        "In {site}, {written} stands in place of {right}.",
        "There is a wrong acceleration in {brief}.",
        "Carry out d/dt ∂L/∂ξ̇ once more, term by term.",
    ),
    "foreign_factor": KindWords(
        "In {site} there is the factor {written} too much.", "There is a factor too much in {brief}.", UNITS
    ),
    "factor_missing": KindWords(
        "In {site}, the factor {written} is missing.", "A factor is missing in {brief}.", UNITS
    ),
    "divided_by": KindWords(
        "In {site} there is the divisor {written} too much.", "There is a divisor too much in {brief}.", UNITS
    ),
    "divisor_missing": KindWords(
        "In {site}, one divisor {written} is missing.", "A divisor is missing in {brief}.", UNITS
    ),
    "piece_left_out": KindWords("In {site}, the piece {right} is left out.", "Something is left out in {brief}.", WAY),
    "piece_sign": KindWords(
        "In {site}, the piece {right} has the wrong sign.", "There is a wrong sign in {brief}.", WAY
    ),
    "piece_function": KindWords(
        "In {site}, {written} stands in place of {right}.", "A component of {brief} is not right.", ANGLES
    ),
    "piece_number": KindWords(
        "In {site}, {written} stands in place of {right}.",
        "A length in {brief} is not right.",
        MEASURE,
    ),
    "segment_left_out": KindWords(
        "In {site}, what {right} contributes is left out.", "Something is left out in {brief}.", WAY
    ),
    "segment_sign": KindWords(
        "In {site}, what {right} contributes has the wrong sign.", "There is a wrong sign in {brief}.", WAY
    ),
    "segment_turned": KindWords(
        "In {site}, sine and cosine are exchanged in what {right} contributes.",
        "A sine or cosine in {brief} is not right.",
        ANGLES,
    ),
    "segment_direction": KindWords(
        "In {site}, what {right} contributes is turned by a right angle, as by a sine in place of a cosine.",
        "Something in {brief} points in another direction.",
        WAY,
    ),
    "sum": KindWords("In {site}, {written} stands in place of {right}.", "A sum in {brief} is not right.", WAY),
    "segment_number": KindWords(
        "In {site}, {written} stands in place of {right}.",
        "A length in {brief} is not right.",
        MEASURE,
    ),
    "velocity_part_left_out": KindWords(
        "In {site}, {right} is left out.", "Something is left out in {brief}.", VELOCITY
    ),
    "velocity_part_sign": KindWords(*SIGN, VELOCITY),
    "rate_sign": KindWords(
        "In {site}, the sign of {right} against {written} is wrong.",
        "There is a wrong sign in {brief}.",
        VELOCITY,
    ),
    "speeds_as_numbers": KindWords(
        "The speeds in {site} were added as numbers, {written}; they are vectors in different directions.",
        "The parts of {brief} were not added as vectors.",
        "Velocities are vectors: add them component by component, or with the cosine of the angle between them.",
    ),
    "omega": KindWords("{Site} is {right}, not {written}{apart}", "{Brief} is not right.", OMEGA),
    "turning_part_left_out": KindWords("In {site}, {right} is left out.", "Something is left out in {brief}.", OMEGA),
    "turning_part_sign": KindWords(*SIGN, OMEGA),
    "turning_function": KindWords(
        "In {site}, {written} stands in place of {right}.", "There is a wrong sine or cosine in {brief}.", ANGLES
    ),
    "components_exchanged": KindWords(
        "In {site}, {right} and {written} are exchanged.", "Two components are exchanged in {brief}.", ANGLES
    ),
    "inertia_form": KindWords(
        "{Site} is taken as {written}.",
        "{Brief} is not right.",
        "Take the moment of inertia that is given, about the centre of mass.",
    ),
    "inertia_added": KindWords(
        "In {site} there is {times}{right} too much as an inertia for {written}.",
        "There is an inertia too much in {brief}.",
        "Each body has the kinetic energy of its centre of mass and that of its rotation about it, and nothing else.",
    ),
    "deflection": KindWords("{Site} is taken as {written}; it is {right}.", "{Brief} is not right.", DEFLECTION),
    "deflection_left_out": KindWords(
        "{Site} is taken as {written}; it is {right}.", "Something is left out in {brief}.", DEFLECTION
    ),
    "deflection_sign": KindWords(
        "{Site} is taken as {written}; it is {right}.", "There is a wrong sign in {brief}.", DEFLECTION
    ),
    "inner_derivative": KindWords(
        "In {site} the inner derivative is {right}, not {written}.",
        "The chain rule was not followed in {brief}.",
        "The derivative of a square is twice what is squared, times the derivative of what is squared.",
    ),
    "share_repeated": KindWords(
        "{Site} does not belong there: that share belongs to the equation of {right}.",
        "{Brief} is not right.",
        WHY_PART[6],
    ),
    "share_moved": KindWords("{Site} belongs to the equation of {right}.", "{Brief} is not right.", WHY_PART[6]),
    "no_arm": KindWords("In {site}, the factor {right} is missing.", "{Brief} comes with a wrong factor.", WHY_PART[6]),
    "velocity_part_twice": KindWords(
        "In {site}, {right} is counted once more.", "Something is counted twice in {brief}.", VELOCITY
    ),
    "arm": KindWords(
        "In {site}, the factor is {written}; it should be {right}.",
        "{Brief} comes with a wrong factor.",
        WHY_PART[6],
    ),
    "arm_added": KindWords("{Site}, where it does no work.", "{Brief} is not right.", NO_WORK),
    "rate_left_out": KindWords(
        "{Site} is taken as {written}; it is {right}.", "Something is left out in {brief}.", DAMPER
    ),
    "rate_sign_in_damper": KindWords(
        "{Site} is taken as {written}; it is {right}.", "There is a wrong sign in {brief}.", DAMPER
    ),
    "damper_rate": KindWords("{Site} is taken as {written}; it is {right}.", "{Brief} is not right.", DAMPER),
}
"""The kinds of changes whose words do not depend on a multiple."""
UNSIGNED = ("piece_sign", "velocity_part_sign", "turning_part_sign")
"""Those that say of a part that its sign is wrong."""


def mistake(change: LocalChange, times: Fraction, model: Model, factor: sp.Expr | None = None) -> Mistake:
    """The mistake that a multiple of a change is; ``factor`` brings terms of an equation to the answer's own scale."""
    site = _in_scale(change.site, factor)
    if of_body := change.kind in ("sign_in_a_sum", "left_out_of_a_sum") and change.right in inertias(model):
        change = replace(change, right=("what ", cast("sp.Symbol", change.right), " contributes"))
    if change.kind in KINDS:
        kind = KINDS[change.kind]
        what, brief, why, name = (
            _filled(kind.what, change, site, times),
            _filled(kind.brief, change, site, times),
            WHY_PART.get(site.step, WHY_PART[5]) if of_body else kind.why,
            change.kind,
        )
    else:
        name, what, brief = _part(change, site, times)
        what = text(*what.parts, *of_rotation(model, site)) if name == "term_forgotten" else what
        why = WHY_PART.get(site.step, WHY_PART[5])
        if name == "wrong_number" and site.step == 2:
            why = WHY_INERTIA if isinstance(site.element, RigidBody) else WHY_NUMBER
        why = WHY_PRODUCTS if site.step == 2 and str(site.words[0]).startswith("the products") else why
    why = why_omega(change.right) if change.kind == "omega" else why
    why = VELOCITY if change.kind == "left_out_of_a_sum" and isinstance(change.right, sp.Derivative) else why
    if why == MEASURE and isinstance(site.element, Spring):
        why = DEFLECTION
    if why == UNITS and _has_no_unit(change):
        why = ANGLES
    coordinate = model.coordinates[site.coordinate].name if site.coordinate is not None else None
    element = site.element.title if site.element is not None else None
    return Mistake(name, what, text(why), site.step, element, coordinate, brief, site.body)


def _has_no_unit(change: LocalChange) -> bool:
    """Whether the factor that is wrong is made of sines and cosines alone, so that units say nothing about it."""
    factors = [x for x in (change.right, change.written) if isinstance(x, sp.Expr)]
    bases = [f.as_base_exp()[0] for x in factors for f in sp.Mul.make_args(x)]
    return any(isinstance(x, (sp.sin, sp.cos)) for x in bases) and all(
        x.is_number or isinstance(x, (sp.sin, sp.cos)) for x in bases
    )


def _in_scale(site: Site, factor: sp.Expr | None) -> Site:
    """The site with the term that its words hold multiplied by ``factor``."""
    if factor is None or not (site.single and site.rows) or not isinstance(site.words[1], sp.Expr):
        return site
    term = factor * site.words[1]
    whole = term if factor in (1, -1) else bounded.expand(term)
    return replace(site, words=(site.words[0], whole, *site.words[2:]))


def _part(change: LocalChange, site: Site, times: Fraction) -> tuple[str, Text, Text]:
    """The words for a multiple of a part: its name, what was done, and that without terms."""
    where = _only(site)
    whole = capital(site.words)
    brief = capital(site.brief)
    be, have, count = _verbs(site)
    if times == -1:
        name = "term_forgotten" if site.single else "left_out"
        what = sentence(*whole, f" {be} missing", *where, ".")
        return name, what, sentence("Something is missing: ", *site.brief, *where, ".")
    if times == -2:
        name = "sign_of_a_term" if site.single else "wrong_sign"
        hint = sentence("There is a wrong sign: ", *site.brief, *where, ".")
        return (
            name,
            sentence(*_as_written(whole, site), f" {have} the wrong sign", *where, *_true_sign(site), "."),
            hint,
        )
    if times == 1 and site.against:
        what = sentence(*whole, " is left over", *where, ": ", *site.against, " cancels it.")
        return "left_over", what, sentence("Something should cancel: ", *site.brief, *where, ".")
    number = 1 + times
    name = "factor_of_a_term" if site.single else "wrong_number"
    hint = sentence(*brief, *where, f" {have} a wrong factor.")
    if number in (2, Fraction(1, 2)):
        return name, sentence(*whole, f" {count} {'twice' if number == 2 else 'half'}", *where, "."), hint
    said = sp.Rational(number.numerator, number.denominator)
    if site.single and isinstance(whole[1], sp.Expr):
        return name, sentence(whole[0], said * whole[1], *whole[2:], " should be ", whole[1], *where, "."), hint
    right = f" times what {'they' if be == 'are' else 'it'} should be"
    return name, sentence(*whole, f" {be} ", said, right, *where, "."), hint


def _as_written(words: Words, site: Site) -> Words:
    """The words of a site with its single term as it was written: in an equation with the other sign, else with
    none."""
    if not site.single or not isinstance(words[1], sp.Expr):
        return words
    if not site.rows and not words[1].could_extract_minus_sign():
        return words
    return (words[0], -words[1], *words[2:])


def _true_sign(site: Site) -> Words:
    """With which sign the single term of an equation stands on its left-hand side."""
    if not (site.single and site.rows) or not isinstance(site.words[1], sp.Expr):
        return ()
    return (": on the left-hand side it should be ", site.words[1])


def _verbs(site: Site) -> tuple[str, str, str]:
    """is, has and counts, or their plurals, as the words of a site ask for."""
    first = site.words[0] if site.words else ""
    if isinstance(first, str) and first.startswith(PLURALS):
        return "are", "have", "count"
    return "is", "has", "counts"


def _only(site: Site) -> Words:
    """Where a site counts, if it is in one equation alone."""
    return (" in one equation alone",) if site.only is not None else ()


def _filled(words: str, change: LocalChange, site: Site, times: Fraction) -> Text:
    """A template with its gaps filled."""
    number = sp.Rational(times.numerator, times.denominator)
    values: dict[str, Words] = {
        "times": () if number == 1 else (number, "·"),
        "site": (*site.words, *_only(site)),
        "brief": (*site.brief, *_only(site)),
        "Site": capital(site.words),
        "Brief": capital(site.brief),
    }
    for key, value in (("right", change.right), ("written", change.written)):
        values[key] = value if isinstance(value, tuple) else (_short(value),) if value is not None else ()
    exprs = [x for x in (change.right, change.written) if isinstance(x, sp.Expr)]
    if change.kind in ("arm", "omega") and len(exprs) > 1 and all(x.could_extract_minus_sign() for x in exprs):
        values["right"], values["written"] = ((-x,) for x in exprs)  # whichever side it stands on, or sense it has
    elif change.kind == "omega" and len(exprs) > 1 and opposed(*exprs):
        values["right"] = (turned(exprs[0]),)
    if change.kind in UNSIGNED and isinstance(change.right, sp.Expr) and change.right.could_extract_minus_sign():
        values["right"] = (_short(-change.right),)  # which sign it has depends on the axis
    values["apart"] = (rates_apart(*exprs) if len(exprs) > 1 else ()) or (".",)
    parts: list[str | Left] = []
    for k, piece in enumerate(words.replace("}", "{").split("{")):
        parts += values[piece] if k % 2 else [piece] if piece else []
    return sentence(*parts)


def _short(value: sp.Expr) -> sp.Expr:
    """A length with its root drawn: R + r sin θ for √((R + r sin θ)²); h/cos²θ for h + h tan²θ."""
    value = without_double_sign(put_together(value) if value.has(sp.tan) else value)
    roots = [f for f in value.atoms(sp.Pow) if f.exp == sp.S.Half and f.has(sp.sin, sp.cos)]
    drawn = {f: sp.powdenest(sp.sqrt(sp.factor(bounded.trigsimp(f.base))), force=True) for f in roots}
    return cast("sp.Expr", value.xreplace(drawn))
