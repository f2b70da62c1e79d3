"""The codes of errors and notices, with the meaning of each. `tools/errors_page.py` generates the tables of errors.md
from them."""

from __future__ import annotations

from enum import StrEnum
from typing import Literal


class Code(StrEnum):
    """A short stable identifier of an error: ``what`` is wrong, in a few words, and an ``explanation`` of what is
    right.

    >>> Code("E102").what
    'a negative mass'
    """

    what: str
    explanation: str

    def __new__(cls, value: str, what: str, explanation: str) -> Code:
        """Make a member of the enumeration, which is the text of the code."""
        made = str.__new__(cls, value)
        made._value_, made.what, made.explanation = value, what, explanation
        return made

    E101 = (
        "E101",
        "a number that is not finite, or too large",
        "Masses, inertias and offsets must be real and below 1.8e308, and values of parameters at most 1e150 SI units.",
    )
    E102 = "E102", "a negative mass", "A mass must be positive, and so must an inductance."
    E103 = "E103", "a zero mass", "A mass, an inductance or a capacitance is not zero; leave out what has none."
    E104 = (
        "E104",
        "a rotation without inertia",
        "The only effect of a coordinate is to turn a body that has no inertia about that axis.",
    )
    E105 = (
        "E105",
        "an inertia that no real body has",
        "The largest principal moment exceeds the sum of the other two: a notice, not an error.",
    )
    E106 = (
        "E106",
        "an inertia of the wrong shape or sign",
        "In space an inertia is a symmetric 3×3 matrix, in the plane one number. A negative principal moment is an "
        "error if it makes the mass matrix indefinite, otherwise a notice.",
    )
    E107 = (
        "E107",
        "gravity that may be missing",
        "A notice: there is a parameter g but no gravity uses it, or nothing acts on bodies that swing in a plane.",
    )
    E108 = (
        "E108",
        "what a robot's file says beside its mechanics",
        "A notice: limits, shapes, transmissions and the like are listed, and the motion does not depend on them.",
    )
    E109 = (
        "E109",
        "masses that are too far apart",
        "A notice: a mass is less than 1e-13 of another one. Numbers with 16 digits do not hold both.",
    )
    E201 = (
        "E201",
        "no coordinates, or an idle one",
        "A system must have coordinates and mass, and every coordinate must move some; every charge needs a coil.",
    )
    E202 = (
        "E202",
        "dependent coordinates",
        "Every coordinate must move the system independently of the others; the entries of a quaternion do not.",
    )
    E203 = (
        "E203",
        "a singular mass matrix",
        "Accelerations need a positive definite mass matrix; here it is singular, indefinite or not finite.",
    )
    E210 = (
        "E210",
        "an unusable change of coordinates",
        "A change must be invertible, with as many new coordinates as it replaces, and solvable or inferable.",
    )
    E301 = (
        "E301",
        "a velocity constraint that is not linear in the rates",
        "It is a sum of terms a(q, t) · rate, and one a(q, t) alone.",
    )
    E302 = (
        "E302",
        "constraints that contradict each other",
        "No motion satisfies all of them; the message names them.",
    )
    E303 = (
        "E303",
        "a start that was moved onto the constraints",
        "A notice: initial values of a constrained system are guesses, except for coordinates in fixed.",
    )
    E304 = (
        "E304",
        "constraints that no position satisfies",
        "The message says how far the nearest position is from closing, and which fixed coordinate prevents it.",
    )
    E305 = (
        "E305",
        "too many fixed coordinates",
        "With these coordinates and rates held, no rates of the others satisfy the constraints.",
    )
    E306 = (
        "E306",
        "a constraint that says nothing new",
        "A notice: other constraints imply it in every position, so it is left out and its multiplier is 0.",
    )
    E308 = (
        "E308",
        "a position that contains a rate or a kink",
        "A position may depend on coordinates, parameters and t, and must have two derivatives.",
    )
    E309 = (
        "E309",
        "a constraint without a slope",
        "Where it holds, its gradient is 0, as that of x² = 0 is: it restricts no rate, and no force follows.",
    )
    E310 = (
        "E310",
        "friction whose share cannot be told",
        "What sticks is a constraint; where others hold the same direction, only the sum of their forces is known.",
    )
    E311 = (
        "E311",
        "friction that sticks where a smooth function is needed",
        "Runs and derivations take friction; for compiled functions, exports and equilibria `regime` says what slips.",
    )
    E312 = (
        "E312",
        "a constraint that an energy may contain already",
        "A notice: a velocity constraint holds a rate that no T* contains. Put into T* before the derivatives are "
        "taken, it gives wrong equations.",
    )
    E401 = (
        "E401",
        "something is missing",
        "A name, a value, an argument or the duration of a run is required.",
    )
    E402 = (
        "E402",
        "an unknown name",
        "No coordinate, parameter, function, method, format or option has that name, or several do.",
    )
    E403 = "E403", "a reserved name", "The name already has a meaning; choose another one."
    E404 = "E404", "something given twice", "Every name must have one meaning, and every value must be given once."
    E405 = (
        "E405",
        "an unknown field or notation",
        "The message lists the fields that are allowed there.",
    )
    E406 = (
        "E406",
        "a value of the wrong kind",
        "A number cannot be read, or one kind of value was given where another is expected; the message says which.",
    )
    E408 = (
        "E408",
        "a unit that does not fit",
        "The unit is unknown, cannot be read, or measures another quantity.",
    )
    E409 = "E409", "an axis or a direction without meaning", "A direction must not be zero, and an axis must not move."
    E410 = "E410", "two ends that are the same", "An element must connect two different points or angles."
    E412 = (
        "E412",
        "an element that acts on nothing",
        "An element needs its points, its frame or its deflection, and all of them must belong to this system.",
    )
    E413 = (
        "E413",
        "a circular definition",
        "Definitions, points, frames and inputs may use only what is defined before them.",
    )
    E414 = "E414", "a wrong number of components", "There are two components in the plane, three in space."
    E415 = (
        "E415",
        "a law without a closed form",
        "No integral of the spring's law was found; give its energy instead.",
    )
    E416 = (
        "E416",
        "a law that is not determined",
        "Give exactly one of k (or b), law and energy; its value must be defined everywhere.",
    )
    E417 = (
        "E417",
        "an input where none is allowed",
        "Positions and energies must not contain inputs, and nothing may contain rates of inputs.",
    )
    E418 = "E418", "an acceleration where none is allowed", "Forces may depend on positions, rates, inputs and t."
    E419 = (
        "E419",
        "a rate, coordinate or time out of place",
        "An argument depends on something that it must not depend on; the message says what is allowed.",
    )
    E501 = (
        "E501",
        "an argument that does not fit",
        "The argument has the wrong size, order or range, or contradicts another one; the message says what is needed.",
    )
    E502 = "E502", "an argument that is not finite", "Values, times and states must be finite, and must not be masked."
    E503 = (
        "E503",
        "a result that is not finite",
        "An expression has no finite value there: a division by zero, or a root of a negative number.",
    )
    E504 = (
        "E504",
        "steps that cannot become smaller",
        "The motion changes faster than the smallest possible step, or a solver gave up.",
    )
    E505 = (
        "E505",
        "a limit of a run",
        "A limit on steps, time, events or memory was reached, or the motion sticks where a force jumps.",
    )
    E506 = (
        "E506",
        "workers that do not respond",
        "The connection to a scheduler or its workers was lost, or they run another version.",
    )
    E507 = (
        "E507",
        "steps too long for the constraints",
        "A notice: steps of that length leave the constraints by so much that what is corrected is not small.",
    )
    E508 = (
        "E508",
        "constraints that depend on each other",
        "A notice: there or near there a constraint follows from others, and the system can move in more ways.",
    )
    E509 = (
        "E509",
        "a reset that breaks a constraint",
        "The state after an event must satisfy every constraint, and its rates too.",
    )
    E510 = (
        "E510",
        "a row that does not follow from the others any more",
        "A row was left out because it followed from the others at the start of a run, and later it did not.",
    )
    E511 = (
        "E511",
        "an energy that is kept less well than elsewhere",
        "A notice: over many oscillations a conservative system with constraints lost or gained more than 1e-8.",
    )
    E521 = (
        "E521",
        "not an equilibrium",
        "A system is linearized about an equilibrium unless you allow any operating point.",
    )
    E522 = "E522", "a mode that no feedback can stabilize", "No input acts on the mode, or no weight penalizes it."
    E523 = (
        "E523",
        "a result that cannot be written in symbols",
        "The result is too long, or does not exist in closed form.",
    )
    E524 = (
        "E524",
        "a coordinate that is not ignorable",
        "The coordinate appears in the Lagrangian, or a force acts on it.",
    )
    E525 = "E525", "a kink or a jump", "The expression has no derivative at that point."
    E601 = "E601", "a system that is too large", "Limits on names, elements and operations keep computations finite."
    E701 = (
        "E701",
        "not an expression",
        "The text cannot be read, or cannot be written, in the grammar of expressions and files.",
    )
    E702 = "E702", "not a name, or not a file", "A name is a letter followed by letters, digits and underscores."
    E703 = "E703", "a text that is too large", "Numbers, powers, lengths, depths and counts in a text are limited."
    E704 = "E704", "wrong arguments of a function", "The message says which arguments the function takes."
    E705 = "E705", "a division by zero", "An expression of numbers must have a finite real value."
    E801 = (
        "E801",
        "a file that cannot be read or written",
        "The message names the file and the error of the operating system.",
    )
    E802 = "E802", "a file that already exists", "A file is replaced only if you ask for it."
    E803 = "E803", "another store", "The store belongs to another sweep or version, or it is not a store."
    E804 = "E804", "a damaged store", "What was read differs from what was written."


CodeText = Literal[
    "E101", "E102", "E103", "E104", "E105", "E106", "E107", "E108", "E109", "E201", "E202", "E203", "E210", "E301",
    "E302", "E303", "E304", "E305", "E306", "E308", "E309", "E310", "E311", "E312", "E401", "E402", "E403", "E404",
    "E405", "E406", "E408", "E409", "E410", "E412", "E413", "E414", "E415", "E416", "E417", "E418", "E419", "E501",
    "E502", "E503", "E504", "E505", "E506", "E507", "E508", "E509", "E510", "E511", "E521", "E522", "E523", "E524",
    "E525", "E601", "E701", "E702", "E703", "E704", "E705", "E801", "E802", "E803", "E804",
]  # fmt: skip
"""The codes as literal texts: a type checker rejects any other code where an error is made."""
