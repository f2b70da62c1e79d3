"""What a frame with a quaternion adds to a derivation: speeds that are not rates of coordinates, and their equations.

The position and the quaternion e of a frame say where it is; the six quasi-velocities u, its velocity v and its angular
velocity ω in its own axes, say how it moves: q̇ = N(q) u. Lagrange's equations for such speeds are those of Boltzmann
and Hamel,

    d/dt ∂L/∂v + ω × ∂L/∂v − ∂L/∂π_v = Ξ_v
    d/dt ∂L/∂ω + ω × ∂L/∂ω + v × ∂L/∂v − ∂L/∂π_ω = Ξ_ω

with ∂/∂π_k = Σ_j N_jk ∂/∂q_j, the change along the motion that u_k alone makes; π_k is called a quasi-coordinate, and
has no value. A frame in a ball joint has no velocity v of its own: ω is its angular velocity relative to the frame that
carries it, and v × ∂L/∂v falls away. Source: L. Meirovitch, Methods of Analytical Dynamics, McGraw-Hill 1970, §4.12;
signs checked by tests.
"""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Sequence

import sympy as sp

from lagrangian.derive import Step
from lagrangian.derive.circuits import nothing_acts
from lagrangian.derive.constraints.page import Constraints
from lagrangian.derive.context import big_xi
from lagrangian.dynamics.loose import loose
from lagrangian.dynamics.notices import configurations
from lagrangian.errors import ModelError
from lagrangian.model import Floating, Model, Velocity
from lagrangian.page.formula import (
    Item,
    Left,
    Matrix,
    Minus,
    Name,
    Partial,
    Product,
    Table,
    Terms,
    Text,
    Total,
    formula,
    text,
)
from lagrangian.structured.listing import Listing
from lagrangian.structured.writing import ListingWriter

NEXT = {0: (1, 2), 1: (2, 0), 2: (0, 1)}
"""The components that follow x, y and z, as in a cross product: (a × b)_x = a_y b_z − a_z b_y."""


def floats(model: Model) -> Iterator[tuple[str, Floating]]:
    """The names of the frames of a model that float or turn in a ball joint, with their variables."""
    for frame in model.floating:
        assert frame.floating is not None and frame.name is not None
        yield frame.name, frame.floating


def quasi_velocities(model: Model) -> dict[sp.Expr, tuple[Floating, int]]:
    """For the symbol of every quasi-velocity, the frame's variables and its place among them."""
    return {v.symbol: (f, k) for _, f in floats(model) for k, v in enumerate(f.velocities)}


def moved_by(model: Model) -> dict[Velocity, sp.Expr]:
    """What every velocity changes, by which its equation is called: its coordinate, or the quasi-velocity itself."""
    rates: dict[sp.Expr, sp.Expr] = {c.rate: c.symbol for c in model.coordinates}
    return {v: rates.get(v.symbol, v.symbol) for v in model.velocities}


# -- step 0 and step 1 -------------------------------------------------------------------------------------------------


def free(model: Model) -> Step:
    """Step 0: nothing restricts the velocities, and the quaternions' lengths say nothing."""
    count = len(list(floats(model)))
    GC, DDOF = len(model.coordinates) - count, len(model.velocities)
    which = _which([n for n, f in floats(model) if not f.held], "floats", "float")
    turning = _which([n for n, f in floats(model) if f.held], "turns in a ball joint", "turn in ball joints")
    which = " and ".join(x for x in (which, turning) if x)
    return Step(
        0,
        "Holonomic?",
        text("Compared the number of generalized coordinates with the differential degrees of freedom."),
        text(
            "Lagrange's equations come one by one from a wiggle (a virtual displacement) of one freedom "
            "while the others stay fixed; only in a "
            "holonomic system is each of these wiggles possible."
        ),
        (
            formula(Name("#GC"), Name(str(GC)), Name("#DDOF"), brief=True),
            text(
                f"No constraint restricts the velocities; {which}. The turn of such a frame is described by a "
                "quaternion, four numbers of which only the ratios matter, so that they count as three. "
                f"#GC = {GC} is the number of generalized coordinates, #DDOF = {DDOF} the number of differential "
                "degrees of freedom: speeds that can be chosen freely at any instant. The two are equal, so the "
                "system is holonomic."
            ),
        ),
        {"holonomic": True, "GC": GC, "DDOF": DDOF},
        (text(f"holonomic: #GC = #DDOF = {GC}, because no constraint on velocities was described"),),
    )


def _which(names: Sequence[str], one: str, many: str) -> str:
    """``frame base floats``, ``frames a, b float``; nothing without names."""
    return f"frame {names[0]} {one}" if len(names) == 1 else f"frames {', '.join(names)} {many}" if names else ""


def held_floating(model: Model, known: Constraints) -> Step:
    """Step 0 where constraints hold floating frames."""
    speeds, h = len(model.velocities), known.holonomy
    DDOF, GC = h.DDOF, h.GC
    rows = tuple((text(row.name), text(*row.multiplier)) for row in known.rows)
    items: list[Item] = [Table((text("row"), text("its multiplier λ")), rows)]
    items += [text(f"The {notice.where} is {notice.text}.") for notice in known.notices()]
    items.append(
        text(
            f"{speeds} speeds and {speeds - DDOF} independent rows: #DDOF = {speeds} − {speeds - DDOF} = {DDOF} is "
            "the number of speeds that can be chosen freely at any instant. Of the quaternion of a frame only the "
            "ratios matter, so that its four numbers count as three."
        )
    )
    if GC is None:
        items.append(text(f"Whether the system is holonomic was not decided beyond depth {len(h.growth)} of brackets."))
    else:
        verdict = "the system is holonomic" if GC == DDOF else f"the system is nonholonomic by {GC - DDOF}"
        if GC == DDOF:
            items.append(formula(Name("#GC"), Name("#DDOF"), Name(str(GC)), brief=True))
        else:
            items += [formula(Name(x), Name(str(n)), brief=True) for x, n in (("#GC", GC), ("#DDOF", DDOF))]
        items.append(text(f"#GC = {GC} is the number of coordinates that describe all that can be reached: {verdict}."))
    return Step(
        0,
        "Holonomic?",
        text("Compared the number of generalized coordinates with the differential degrees of freedom."),
        text(
            "Lagrange's equations come one by one from a wiggle (a virtual displacement) of one freedom "
            "while the others stay fixed. "
            "Constraints forbid some of these wiggles; what they do instead is a force with a multiplier."
        ),
        tuple(items),
        {"holonomic": h.holonomic, "GC": GC, "DDOF": DDOF, "redundant": h.redundant},
        (text(f"#DDOF = {DDOF}, #GC = {'undecided' if GC is None else GC}"),),
    )


def speeds(model: Model) -> Step:
    """Step 1: the coordinates, the speeds, and how the coordinates follow from the speeds."""
    quasi = quasi_velocities(model)
    rows = [
        (text(v.symbol), text(f"{v.name}: {v.description}" if v.symbol in quasi else "the rate of a coordinate"))
        for v in model.velocities
    ]
    items: list[Item] = [
        Table((text("speed"), text("what it is")), tuple(rows), brief=True),
        text(
            "Complete: the coordinates (and t) determine the position of every mass; nothing else in the system moves. "
            "Independent: every speed can be chosen while the others are 0. The speeds of a frame with a quaternion "
            "are called quasi-velocities, because they are not the rates of coordinates."
        ),
    ]
    shown: dict[sp.Expr, sp.Expr] = {}
    carriers = {frame.name: frame.parent for frame in model.floating}
    explained: set[bool] = set()
    for name, f in floats(model):
        parent = carriers[name]
        around = "the fixed axes" if parent is None else f"the axes of {parent.name}" if parent.name else "its parent's"
        known = f.held in explained and parent is None
        items += [text(f"The same holds for {name}.")] if known else list(_kinematics(name, f, around))
        explained.add(f.held)
        shown |= rates(f)
    return Step(
        1,
        "Generalized coordinates and speeds",
        text("Chose coordinates that say where everything is, and independent speeds that say how it moves."),
        text(
            "No three angles describe every orientation: somewhere their rates lose a direction. A quaternion has "
            "no such place, but its four rates depend on each other. So the speeds are the velocity and the angular "
            "velocity themselves, in the frame's own axes, where inertias are constant."
        ),
        tuple(items),
        {"coordinates": tuple(c.symbol for c in model.coordinates), "rates": shown},
        (text("speeds: the velocities and angular velocities of floating frames, and the rates of all else"),),
    )


def rates(f: Floating) -> dict[sp.Expr, sp.Expr]:
    """q̇ = N(q) u by coordinate: ṗ = R v and ė = ½ e ∘ (ω, 0)."""
    moved = [] if f.held else f.rotation * sp.Matrix(f.velocity)
    return dict(zip((c.symbol for c in f.coordinates), [*moved, *_turning(f)], strict=True))


def _turning(f: Floating) -> list[sp.Expr]:
    """ė = ½ e ∘ (ω, 0)."""
    (x, y, z, w), (a, b, c) = f.quaternion, f.angular_velocity
    half = sp.Rational(1, 2)
    return [
        half * (w * a + y * c - z * b),
        half * (w * b + z * a - x * c),
        half * (w * c + x * b - y * a),
        -half * (x * a + y * b + z * c),
    ]


def _kinematics(name: str, f: Floating, around: str) -> Iterator[Item]:
    """How position and quaternion follow from the speeds; ``around`` are the axes against which the frame turns."""
    x, y, z, w = f.quaternion
    turned = [
        [1 - 2 * (y**2 + z**2), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x**2 + z**2), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x**2 + y**2)],
    ]
    yield text(
        f"The matrix R turns the axes of {name} into {around} (a quaternion of another length than 1 is divided "
        "by its length first):"
    )
    yield formula(Name("R"), Matrix(tuple(tuple(row) for row in turned)))
    position = "" if f.held else f"The rates of the position of {name} are R times its velocity; "
    yield text(position + ("The rates of its quaternion are" if f.held else "those of its quaternion are"))
    for c, rate in zip(f.orientation, _turning(f), strict=True):
        yield formula(c.rate, rate)


def check_speeds(model: Model) -> None:
    """Raise `ModelError` if a speed, or several together, move nothing that has mass."""
    p = [1.0 if x.value is None else x.value for x in model.parameters]
    moved = loose(model, next(iter(configurations(model))), [0.0] * len(model.inputs), p, 0.0)
    if moved:
        raise ModelError(
            f"system '{model.name}' has no equations of motion: {moved}",
            place=model.floating[0].place,
            fix="give what they move a mass, and an inertia about every axis",
            code="E201",
        )


# -- step 5 ------------------------------------------------------------------------------------------------------------


def laws(model: Model) -> Iterator[Item]:
    """Lagrange's equations for quasi-velocities, and why they have more terms."""
    v, w, L = Name("v"), Name("omega"), Name("L")
    by_v, by_w = Partial(L, v), Partial(L, w)
    kinds = {f.held for _, f in floats(model)}
    whose = {False: "The six speeds of a floating frame", True: "The three speeds of a frame in a ball joint"}
    yield text(
        f"{whose[min(kinds)]} are not the rates of coordinates: a frame that is turned about x and then about y ends "
        "in another orientation than one that is turned in the other order. So d/dt and δ cannot be interchanged as "
        "they can for a coordinate; the difference is a product with ",
        *((w,) if kinds == {True} else (w, " or ", v)),
        ". The equations that contain it are those of Boltzmann and Hamel:",
    )
    turning = (Total(by_w), " + ", w, " × ", by_w)
    end = (" − ", _along("omega"), " = ", Name("Xi", "omega"))
    if False in kinds:
        yield text(Total(by_v), " + ", w, " × ", by_v, " − ", _along("v"), " = ", Name("Xi", "v"), ",", brief=True)
        yield text(*turning, " + ", v, " × ", by_v, *end, ".", brief=True)
    if kinds == {False, True}:
        yield text("A frame in a ball joint has no velocity of its own:")
    if True in kinds:
        yield text(*turning, *end, ".", brief=True)
    yield text(
        "All vectors are in the axes of the frame. ",
        _along("k"),
        " is the change of ",
        L,
        " along the motion that speed k makes alone: the sum of the partial derivatives by the coordinates, each times "
        "what it moves by. There is no coordinate ",
        Name("pi"),
        "; the letter marks that motion.",
        brief=True,
    )


def left_side(symbol: sp.Expr, f: Floating, k: int) -> Left:
    """The left-hand side of the equation of a quasi-velocity, as it is written."""
    by = Total(Partial(Name("L"), symbol))
    return Terms((by, *_bracket(f, k), Minus(_along(f.velocities[k].name))))


def along(velocity: Velocity) -> Left:
    """∂T*/∂π of a quasi-velocity."""
    return Partial(Name("T*"), Name("pi", velocity.name))


def _along(index: str) -> Left:
    return Partial(Name("L"), Name("pi", index))


def _bracket(f: Floating, k: int) -> list[Left]:
    """Component k of ω × ∂L/∂v, or of ω × ∂L/∂ω + v × ∂L/∂v."""
    v, w = f.velocity, f.angular_velocity
    i, j = NEXT[k % 3]

    def crossed(a: Sequence[sp.Expr], b: Sequence[sp.Expr]) -> list[Left]:
        second = Product((a[j], Partial(Name("L"), b[i])))
        return [Product((a[i], Partial(Name("L"), b[j]))), Minus(second)]

    if f.held:
        return crossed(w, w)
    return crossed(w, v) if k < 3 else [*crossed(w, w), *crossed(v, v)]


# -- step 6 ------------------------------------------------------------------------------------------------------------


def by_power(found: Listing, write: ListingWriter) -> Step:
    """Step 6: the power of every force, and what each speed has of it."""
    model, m, zero = found.model, found.mechanics, found.graph.zero
    symbols = list(moved_by(model).values())
    items: list[Item] = []
    rows: list[tuple[Text, ...]] = []
    by_speed: list[list[str]] = [[] for _ in symbols]
    for element in (e for e in model.elements if e.ledger == "Ξ"):
        pairs = m.added[element.title].efforts
        powers = tuple(Product((write(effort), write(rate))) for rate, effort in pairs if zero not in (rate, effort))
        items.append(formula(Name("W", element.name, 1), Terms(powers), note=text(element.title)))
        for k, share in enumerate(m.gathered(list(pairs))):
            if share != zero:
                by_speed[k].append(element.title)
                rows.append((text(symbols[k]), text(element.title), text(write(share))))
    if rows:
        items.insert(0, text("The power of every force, effort times rate:"))
        items.append(Table((text("speed"), text("element"), text("adds")), tuple(rows)))
    else:
        items.append(text(f"No {nothing_acts(model)} was described: nothing non-conservative acts."))
    reasons: list[Text] = []
    for k, force in enumerate(found.forces):
        items.append(formula(big_xi(k), write(force), note=text("for ", symbols[k]), brief=True))
        whose = ", ".join(by_speed[k]) or "nothing"
        reasons.append(text(big_xi(k), f": {whose} {'works' if by_speed[k] else 'does work'} along ", symbols[k]))
    return Step(
        6,
        "Non-conservative forces",
        text("Found what the forces, torques and dampers add to every equation, by their power."),
        text(
            "They have no potential, so ",
            Name("V"),
            " does not contain them. A generalized force is what its speed is multiplied by in the power: along a "
            "motion with that speed alone, Ξ times the speed is the work done in a second.",
        ),
        tuple(items),
        {"Xi": {x: write(force) for x, force in zip(symbols, found.forces, strict=True)}},
        tuple(reasons),
    )
