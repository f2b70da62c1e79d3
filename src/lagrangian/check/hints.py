"""What hint level 2 tells of a mistake: its kind, its place and what to look at, made of these alone.

No sentence of level 3 is shortened here: what is said follows from the kind, the step, the element and the coordinate,
so that it cannot hold the term.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum

from sympy.core.function import AppliedUndef

from lagrangian.page.formula import Left, Name, Partial, Text, Total, text


class MistakeKind(StrEnum):
    """The kinds of mistakes."""

    MISSING = "missing"
    EXTRA = "extra"
    SIGN = "sign"
    FACTOR = "factor"
    POWER = "power"
    LETTER = "letter"
    ANGLE = "angle"
    RATE = "rate"
    LENGTH = "length"
    DERIVATIVE = "derivative"
    SHARE = "share"
    TERM = "term"


_SAID = {
    MistakeKind.MISSING: "Something is missing in {}.",
    MistakeKind.EXTRA: "Something is counted too often in {}.",
    MistakeKind.SIGN: "There is a wrong sign in {}.",
    MistakeKind.FACTOR: "There is a wrong factor in {}.",
    MistakeKind.POWER: "There is a wrong power in {}.",
    MistakeKind.LETTER: "A letter in {} is not the right one.",
    MistakeKind.ANGLE: "There is a wrong angle, sine or cosine in {}.",
    MistakeKind.RATE: "There is a wrong velocity in {}.",
    MistakeKind.LENGTH: "There is a wrong length or height in {}.",
    MistakeKind.DERIVATIVE: "A derivative is not right in {}.",
    MistakeKind.SHARE: "{} is not right.",
    MistakeKind.TERM: "{} is not right.",
}
"""What is said of a place."""

_NAMES: Mapping[MistakeKind, str] = {
    MistakeKind.MISSING: (
        "term_forgotten left_out left_out_of_a_sum piece_left_out segment_left_out "
        "velocity_part_left_out turning_part_left_out deflection_left_out rate_left_out "
        "base_motion_forgotten carried_mass_forgotten coupling_forgotten cross_term_forgotten "
        "effort_term_forgotten element_forgotten gradient_forgotten gravity_forgotten inertia_left_out "
        "one_component position_in_flux_forgotten potential_forgotten reaction_forgotten "
        "rotation_forgotten translation_forgotten velocity_terms_forgotten"
    ),
    MistakeKind.EXTRA: ("left_over velocity_part_twice inertia_added element_twice"),
    MistakeKind.SIGN: (
        "sign_of_a_term wrong_sign sign_in_a_sum piece_sign segment_sign velocity_part_sign rate_sign "
        "turning_part_sign deflection_sign rate_sign_in_damper damper_sign force_sign gradient_sign "
        "gravity_sign plus_potential prescribed_sign reaction_sign spring_sign xi_sign"
    ),
    MistakeKind.FACTOR: (
        "factor_of_a_term wrong_number lost lost_in_a_sum inverted foreign_factor factor_missing "
        "divided_by divisor_missing no_arm arm coriolis_half damper_arm damper_half force_arm "
        "force_component half_forgotten spring_half_forgotten divided_by_a_part"
    ),
    MistakeKind.POWER: ("not_squared squared arm_not_squared spring_square_forgotten sum_not_squared"),
    MistakeKind.LETTER: ("letter exchanged mass_swapped parameter_swapped"),
    MistakeKind.ANGLE: (
        "sine_cosine tangent angle double_angle small_angle piece_function segment_turned "
        "segment_direction turning_function components_exchanged sine_for_cosine wrong_angle"
    ),
    MistakeKind.RATE: (
        "rate acceleration speeds_as_numbers omega damper_rate damper_other_velocity "
        "damper_rate_not_relative damper_to_ground relative_rate relative_speed"
    ),
    MistakeKind.LENGTH: (
        "piece_number segment_number sum deflection gravity_arm height_relative rest_forgotten "
        "spring_other_pair spring_to_ground way_in_full lengths_added"
    ),
    MistakeKind.DERIVATIVE: ("inner_derivative product_rule"),
    MistakeKind.SHARE: (
        "share_repeated share_moved arm_added force_wrong_equation input_everywhere spring_on_carrier "
        "counted_without_work"
    ),
    MistakeKind.TERM: ("inertia_form inertia_about_pivot damper_in_potential energy_for_coenergy"),
}
"""The names of the mistakes of each kind; every other one is of the last."""
_KINDS = {name: kind for kind, names in _NAMES.items() for name in names.split()}

NAMED = frozenset(_KINDS)
"""The names of the mistakes whose kinds are known."""

_LEDGERS: Mapping[int, str] = {2: "the kinetic energy of ", 3: "the potential energy of "}
_WHOLES: Mapping[int, str | Name] = {1: "the coordinates", 2: Name("T*"), 3: Name("V"), 4: Name("L"), 6: Name("Xi")}
_OF_STEPS: Mapping[int, str] = {
    1: "Do the coordinates describe every position, and are they independent?",
    2: "Go through the sketch, body by body: does its whole motion count, seen from the ground?",
    3: "Move one coordinate a little: which bodies rise or sink, and which springs change their length?",
    4: "Compare it with its definition, part by part.",
    5: "Go through this equation once more, term by term.",
    6: "Change only this coordinate a little. Does the point where the force acts move, and how far?",
}
_OF_KINDS: Mapping[MistakeKind, str] = {
    MistakeKind.SIGN: "Let a coordinate grow a little, and mind the direction of everything that changes.",
    MistakeKind.FACTOR: "Compare the units and the numbers of this term with those of its neighbours.",
    MistakeKind.POWER: "Compare the units of this term with those of its neighbours.",
    MistakeKind.LETTER: "Keep to the letters of the sketch: every element has its own.",
    MistakeKind.ANGLE: "Look where the angle is measured from, and try a special position, such as an angle of zero.",
    MistakeKind.RATE: "Ask of every rate whether it is absolute, or relative to what carries it.",
    MistakeKind.LENGTH: "Look at the sketch: from where to where is it measured?",
    MistakeKind.DERIVATIVE: "Differentiate once more, factor by factor: what in it moves?",
}
"""What to look at: by the kind or, where that says nothing, by the step."""


def kind_of(name: str) -> MistakeKind:
    """The kind of a mistake by its name."""
    return _KINDS.get(name, MistakeKind.TERM)


def hinted(
    kind: MistakeKind, step: int, element: str | None, coordinate: str | Left | None, brief: Text | None
) -> Text:
    """What is told: ``brief``, the mistake without its term, if it holds none, else a sentence made of the rest."""
    if brief is not None and all(map(_is_name, brief.parts)):
        return brief
    before, after = _SAID[kind].split("{}")
    return sentence(*(x for x in (before, *_place(kind, step, element, coordinate), after) if x != ""))


def advised(kind: MistakeKind, step: int) -> str:
    """What to look at to find the mistake."""
    return _OF_KINDS.get(kind) or _OF_STEPS.get(step, _OF_STEPS[5])


def sentence(*parts: str | Left) -> Text:
    """A sentence of parts, in which neighbouring words are joined."""
    joined: list[str | Left] = []
    for part in parts:
        if isinstance(part, str) and joined and isinstance(last := joined[-1], str):
            joined[-1] = last + part
        else:
            joined.append(part)
    return text(*capital(tuple(joined)))


def capital(words: tuple[str | Left, ...]) -> tuple[str | Left, ...]:
    """Words that begin a sentence."""
    if words and isinstance(first := words[0], str):
        return (first[:1].upper() + first[1:], *words[1:])
    return words


def _place(kind: MistakeKind, step: int, element: str | None, coordinate: str | Left | None) -> tuple[str | Left, ...]:
    if coordinate is not None:
        of = "the equation of "
        return (of, coordinate) if element is None else (f"what {element} adds to {of}", coordinate)
    whole = _WHOLES.get(step, "the equations")
    if element is None:
        return (whole,)
    if step not in _LEDGERS or kind is MistakeKind.SHARE:
        return (f"what {element} adds to ", whole)
    return ("the weights" if element.startswith("gravity ") else f"{_LEDGERS[step]}{element}",)


def _is_name(part: object) -> bool:
    """Whether a part of a sentence is words, the name of a quantity, a coordinate or a derivative of these."""
    if isinstance(part, Partial):
        return _is_name(part.of) and (_is_name(part.by) or getattr(part.by, "is_Derivative", False))
    if isinstance(part, Total):
        return _is_name(part.of)
    return isinstance(part, (str, Name, AppliedUndef))
