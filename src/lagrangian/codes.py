"""The codes of errors and notices: what each means, in one place. `tools/errors_page.py` writes the page from it."""

from __future__ import annotations

from enum import StrEnum
from typing import Literal


class Code(StrEnum):
    """A stable short identifier of what is wrong: ``what`` in a few words, and an ``explanation`` of what is right.

    >>> Code("E102").what
    'a negative mass'
    """

    what: str
    explanation: str

    def __new__(cls, value: str, what: str, explanation: str) -> Code:
        """Make the member, which is the text of the code."""
        made = str.__new__(cls, value)
        made._value_, made.what, made.explanation = value, what, explanation
        return made

    E101 = "E101", "a number that is not finite", "Masses, inertias, offsets and values are real and below 1.8e308."
    E102 = "E102", "a negative mass", "A mass is above 0."
    E103 = "E103", "a zero mass", "A mass is above 0; leave out a body that weighs nothing."
    E104 = "E104", "a rotation without inertia", "A coordinate only turns a body that has no inertia about that axis."
    E105 = (
        "E105",
        "an inertia that fits no body",
        "The largest principal moment exceeds the sum of the other two: a notice, not an error.",
    )
    E106 = (
        "E106",
        "an inertia of wrong shape or sign",
        "In space it is a symmetric 3×3 matrix, in the plane one number. A negative principal moment is an error "
        "where it makes the mass matrix indefinite, else a notice.",
    )
    E107 = (
        "E107",
        "gravity that may be missing",
        "A notice: no gravity uses the parameter g, or bodies swing in the plane while nothing acts on them.",
    )
    E201 = (
        "E201",
        "no coordinates, or an idle one",
        "A system has coordinates and mass, and every coordinate moves some of the mass.",
    )
    E202 = (
        "E202",
        "dependent coordinates",
        "Every coordinate moves the system in its own way; the entries of a quaternion do not.",
    )
    E203 = (
        "E203",
        "a singular mass matrix",
        "Accelerations need a positive definite mass matrix: here it is singular, indefinite or not finite.",
    )
    E210 = (
        "E210",
        "an unusable change of coordinates",
        "A change is invertible, with as many new coordinates as it replaces, and can be solved or found.",
    )
    E308 = (
        "E308",
        "a position that holds a rate or a kink",
        "A position depends on coordinates, parameters and t, and has two derivatives.",
    )
    E401 = (
        "E401",
        "something is missing",
        "A name, a value, an argument or the duration of a run is needed and not given.",
    )
    E402 = (
        "E402",
        "an unknown name",
        "No coordinate, parameter, function, method, format or option has that name, or several have.",
    )
    E403 = "E403", "a reserved name", "The name has a meaning already; choose another one."
    E404 = "E404", "something given twice", "Every name means one thing, and every value is given once."
    E405 = (
        "E405",
        "an unknown field or notation",
        "A model file has known fields; the message lists those of the place.",
    )
    E406 = (
        "E406",
        "a value of the wrong kind",
        "A number that cannot be read, or one kind of thing where another belongs; the message says which.",
    )
    E408 = (
        "E408",
        "a unit that does not fit",
        "A unit that is unknown, that cannot be read, or that measures something else.",
    )
    E409 = "E409", "an axis or a direction without meaning", "A direction is not zero, and an axis does not move."
    E410 = "E410", "two ends that are one", "An element connects two different points or angles."
    E412 = (
        "E412",
        "an element that acts on nothing",
        "An element needs its points, its frame or its deflection, and all of them belong to this system.",
    )
    E413 = (
        "E413",
        "a definition that needs itself",
        "Definitions, points, frames and inputs use what comes before them, never in a circle.",
    )
    E414 = "E414", "a wrong number of components", "Two components in the plane, three in space."
    E415 = (
        "E415",
        "a law without closed form",
        "No integral of the spring's law was found: give its energy instead.",
    )
    E416 = (
        "E416",
        "a law that is not determined",
        "Exactly one of k (or b), law and energy is given; its value is known everywhere.",
    )
    E417 = (
        "E417",
        "an input where none may stand",
        "Positions and energies hold no inputs, and nothing holds their rates.",
    )
    E418 = "E418", "an acceleration where none may stand", "Forces depend on positions, rates, inputs and t."
    E419 = (
        "E419",
        "a rate, coordinate or time out of place",
        "Each argument of an element says what it may depend on; velocities are linear in the rates.",
    )
    E501 = (
        "E501",
        "an argument that does not fit",
        "It has the wrong size, order or range, or contradicts another one; the message says what is needed.",
    )
    E502 = "E502", "an argument that is not finite", "Values, times and states are finite; none is masked."
    E503 = (
        "E503",
        "a result that is not finite",
        "An expression has no finite value there: a division by zero, or a root of a negative number.",
    )
    E504 = (
        "E504",
        "steps that cannot get smaller",
        "The motion changes faster than time can be divided, or a solver gives up.",
    )
    E505 = (
        "E505",
        "a limit of a run",
        "A bound on steps, time, events or memory was reached, or a force that jumps holds the motion there.",
    )
    E506 = "E506", "workers that do not answer", "A scheduler or its workers were lost, or run another version."
    E521 = "E521", "not an equilibrium", "A linearization starts from rest, unless any operating point is asked for."
    E522 = "E522", "a mode that no feedback stabilizes", "No input acts on it, or no weight sees it."
    E523 = "E523", "a result that cannot be written in symbols", "It is too long, or it does not exist in closed form."
    E524 = "E524", "a coordinate that is not ignorable", "It appears in the Lagrangian, or a force acts on it."
    E525 = "E525", "a kink or a jump", "There is no derivative at that point."
    E601 = "E601", "a system that is too large", "Bounds on names, elements and operations keep work finite."
    E701 = "E701", "not an expression", "A text that cannot be read or written in the grammar of expressions and files."
    E702 = "E702", "not a name, or no such file", "A name is a letter, then letters, digits and underscores."
    E703 = "E703", "too large to be read", "Bounds on numbers, powers, lengths, depths and counts of what is typed."
    E704 = "E704", "wrong arguments of a function", "Every function takes a fixed number of arguments."
    E705 = "E705", "a division by zero", "An expression of numbers alone has a finite real value."
    E801 = "E801", "a file that cannot be read or written", "The message says which file, and what the system answered."
    E802 = "E802", "a file that is there already", "Nothing is replaced unasked."
    E803 = "E803", "another store", "The store belongs to another sweep or version, or is not a store."
    E804 = "E804", "a damaged store", "What is read is not what was written."


CodeText = Literal[
    "E101", "E102", "E103", "E104", "E105", "E106", "E107", "E201", "E202", "E203", "E210", "E308", "E401", "E402",
    "E403", "E404", "E405", "E406", "E408", "E409", "E410", "E412", "E413", "E414", "E415", "E416", "E417", "E418",
    "E419", "E501", "E502", "E503", "E504", "E505", "E506", "E521", "E522", "E523", "E524", "E525", "E601", "E701",
    "E702", "E703", "E704", "E705", "E801", "E802", "E803", "E804",
]  # fmt: skip
"""The codes as text: a type checker refuses any other where an error is made."""
