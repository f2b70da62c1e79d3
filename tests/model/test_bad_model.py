"""Descriptions that are wrong, in Python: one error each, naming the element, the value and the fix."""

import math

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian import ModelError

x, y = sp.Function("x")(sp.Symbol("t")), sp.Function("y")(sp.Symbol("t"))


class Bench:
    """A system with two coordinates and the usual parameters, for each case to spoil."""

    def __init__(self) -> None:
        self.s = s = lg.System("bench")
        self.x, self.y = s.coordinates("x y")
        self.m, self.k, self.L = s.parameters("m k L")
        self.F = s.input("F")
        self.A = s.point("A", (self.x, 0))
        self.B = s.point("B", (self.x + self.L * sp.cos(self.y), self.L * sp.sin(self.y)))


def space() -> lg.System:
    s = lg.System("space")
    s.coordinates("a b")
    return s


def body(inertia: object, mass: object = 1) -> lg.System:
    s = space()
    frame = s.frame(s["a"], axis=(0, 0, 1))
    s.rigid_body(mass, inertia, at=s.origin + (s["b"], 0, 0), frame=frame, name="plate")
    return s


CASES = {
    "duplicate coordinate": (lambda b: b.s.coordinates("x"), ["coordinate 'x' is defined twice"]),
    "input named as a coordinate": (lambda b: b.s.input("x"), ["as a coordinate and as an input"]),
    "parameter named as a coordinate": (lambda b: b.s.parameters("x"), ["'x' is defined twice", "parameter"]),
    "reserved t": (lambda b: b.s.parameters("t"), ["'t' is reserved", "time"]),
    "reserved pi": (lambda b: b.s.parameters("pi"), ["'pi' is reserved", "3.14"]),
    "reserved sin": (lambda b: b.s.parameters("sin"), ["'sin' is reserved", "function"]),
    "name not an identifier": (lambda b: b.s.parameter("a;b"), ["'a;b' is not an identifier"]),
    "name starts with a digit": (lambda b: b.s.parameter("1m"), ["'1m' is not an identifier"]),
    "name too long": (lambda b: b.s.parameter("m" * 1000), ["1000 characters", "at most 64"]),
    "empty names": (lambda b: b.s.parameters(""), ["no name"]),
    "infinite parameter": (lambda b: b.s.parameter("c", math.inf), ["'c'", "finite", "inf"]),
    "nan parameter": (lambda b: b.s.parameter("c", math.nan), ["'c'", "finite", "nan"]),
    "complex parameter": (lambda b: b.s.parameter("c", 1j), ["'c'", "real", "1j"]),
    "parameter of the wrong type": (lambda b: b.s.parameter("c", [1]), ["'c'", "number", "[1]"]),
    "boolean parameter": (lambda b: b.s.parameter("c", True), ["'c'", "number", "True"]),
    "value for an unlisted name": (lambda b: b.s.parameters("c", d=1), ["'d'", "not among"]),
    "unknown symbol": (lambda b: b.s.particle(sp.Symbol("mm"), b.A), ["unknown symbol 'mm'", "Did you mean 'm'"]),
    "undeclared moving symbol": (
        lambda b: b.s.particle(b.m, b.s.origin + (b.x, sp.Function("z")(sp.Symbol("t")))),
        ["unknown moving symbol 'z'", "declare"],
    ),
    "a symbol with assumptions of its own": (
        lambda b: b.s.particle(sp.Symbol("m", positive=True), b.A),
        ["'m'", "not the symbol that was declared", "declaration returned"],
    ),
    "a static symbol for a coordinate": (
        lambda b: b.s.point("P", (sp.Symbol("x"), 0)),
        ["'x'", "not the symbol that was declared"],
    ),
    "mass as text": (lambda b: b.s.particle("m", b.A), ["mass", "str", "SymPy"]),
    "mass missing": (lambda b: b.s.particle(None, b.A), ["mass", "NoneType"]),
    "particle at nothing": (lambda b: b.s.particle(b.m, None), ["must be at a point"]),
    "particle at a tuple": (lambda b: b.s.particle(b.m, (1, 2)), ["must be at a point", "origin"]),
    "negative mass": (lambda b: (b.s.particle(-1, b.A), b.s.model), ["mass = -1", "negative"]),
    "zero mass": (lambda b: (b.s.particle(0, b.A), b.s.model), ["mass", "zero"]),
    "nan mass": (lambda b: b.s.particle(math.nan, b.A), ["mass", "finite", "nan"]),
    "complex mass": (lambda b: b.s.particle(sp.I * b.m, b.A), ["mass", "real"]),
    "mass that moves": (lambda b: b.s.particle(b.m * b.x, b.A), ["mass", "coordinate 'x'", "parameters"]),
    "mass of an input": (lambda b: b.s.particle(b.F, b.A), ["mass", "input 'F'"]),
    "mass that depends on time": (lambda b: b.s.particle(b.m * b.s.t, b.A), ["mass", "time"]),
    "point with one component": (lambda b: b.s.origin + (b.x,), ["1 component", "two in the plane"]),
    "point with four components": (lambda b: b.s.origin + (1, 2, 3, 4), ["4 components"]),
    "point of the wrong dimension": (lambda b: b.A + (1, 2, 3), ["3 components", "2"]),
    "points that disagree": (lambda b: b.s.particle(b.m, b.s.origin + (b.x, 0, 0)), ["3 components", "2"]),
    "point plus point": (lambda b: b.A + b.B, ["cannot be added"]),
    "rate in a position": (lambda b: b.s.point("P", (b.x.diff(), 0)), ["rate", "x'", "position"]),
    "input in a position": (lambda b: b.s.point("P", (b.F, 0)), ["input 'F'", "prescribe"]),
    "duplicate point": (lambda b: b.s.point("A", (0, 0)), ["point 'A' is defined twice"]),
    "point of another system": (lambda b: b.s.particle(b.m, lg.System("other").origin + (1, 0)), ["another system"]),
    "spring between a point and itself": (
        lambda b: b.s.spring(b.k, between=(b.A, b.A)),
        ["spring", "same point", "two different"],
    ),
    "spring between one point": (lambda b: b.s.spring(b.k, between=(b.A,)), ["two points"]),
    "spring with neither": (lambda b: b.s.spring(b.k), ["neither", "between", "deflection"]),
    "spring with both": (lambda b: b.s.spring(b.k, between=(b.A, b.B), deflection=b.x), ["both"]),
    "spring without stiffness": (lambda b: b.s.spring(deflection=b.x), ["exactly one of k, law and energy"]),
    "rate in a deflection": (lambda b: b.s.spring(b.k, deflection=b.x.diff()), ["deflection", "rate", "x'"]),
    "law without closed form": (
        lambda b: b.s.spring(law=lambda d: sp.sin(sp.exp(d**2)), deflection=b.x),
        ["closed form", "energy"],
    ),
    "rates inside V": (lambda b: b.s.potential(b.m * b.x.diff() ** 2), ["potential energy V", "rate", "x'"]),
    "acceleration in T": (lambda b: b.s.kinetic(b.m * b.x.diff(b.s.t, 2)), ["acceleration", "x''"]),
    "acceleration in a force": (lambda b: b.s.force(b.x.diff(b.s.t, 2), deflection=b.x), ["acceleration"]),
    "rate of an input": (lambda b: b.s.force(b.F.diff(), deflection=b.x), ["derivative of input 'F'"]),
    "input in a damper's deflection": (lambda b: b.s.damper(b.k, deflection=b.x - b.F), ["input 'F'"]),
    "force on nothing": (lambda b: b.s.force(b.F), ["acts on nothing"]),
    "vector force on nothing": (lambda b: b.s.force((b.F, 0)), ["needs the point"]),
    "scalar force at a point": (lambda b: b.s.force(b.F, at=b.A), ["vector"]),
    "force with reaction on itself": (lambda b: b.s.force((b.F, 0), at=b.A, reaction=b.A), ["same point"]),
    "force of the wrong dimension": (lambda b: b.s.force((b.F, 0, 0), at=b.A), ["3 components", "2"]),
    "torque on nothing": (lambda b: b.s.torque(b.F), ["acts on nothing"]),
    "torque reacting on itself": (lambda b: b.s.torque(b.F, on=b.y, reaction=b.y), ["same angle"]),
    "gravity with no direction": (lambda b: b.s.gravity(direction=(0, 0)), ["direction is zero"]),
    "gravity of the wrong dimension": (lambda b: b.s.gravity(direction=(0, 0, -1)), ["3 components", "2"]),
    "duplicate element name": (
        lambda b: (b.s.particle(b.m, b.A, name="cart"), b.s.particle(b.m, b.B, name="cart")),
        ["'cart' is taken"],
    ),
    "generalized force on a parameter": (lambda b: b.s.generalized_force(b.m, b.F), ["'m' is not a coordinate"]),
    "nothing has mass": (lambda b: b.s.model, ["has mass", "particle"]),
    "unknown name looked up": (lambda b: b.s["mm"], ["'mm'", "Did you mean 'm'"]),
    "no coordinates": (lambda b: lg.System("empty").derive(), ["no coordinates"]),
    "no name": (lambda b: lg.System(""), ["needs a name"]),
    "inertia of three numbers in the plane": (
        lambda b: b.s.rigid_body(b.m, (1, 2, 3), at=b.A, frame=b.y),
        ["one number J"],
    ),
    "one inertia in space": (lambda b: body(5), ["three principal moments"]),
    "inertia not symmetric": (
        lambda b: body([[1, 0.2, 0], [0.1, 1, 0], [0, 0, 1]]),
        ["not symmetric", "(1,2)", "1/5", "1/10"],
    ),
    "negative inertia": (lambda b: body((1, 1, -1)).model, ["plate", "semidefinite", "indefinite", "Izz = -1"]),
    "negative mass, where the body is described": (lambda b: body((1, 1, 1), -2), ["plate", "mass = -2"]),
    "rigid body without frame": (lambda b: b.s.rigid_body(b.m, b.k, at=b.A, frame=None), ["angle"]),
    "axis zero": (lambda b: space().frame(sp.Integer(1), axis=(0, 0, 0)), ["axis", "(0, 0, 0)"]),
    "bad unit": (lambda b: b.s.parameter("c", "3 kgg"), ["kgg"]),
    "empty value": (lambda b: b.s.parameter("c", ""), ["'c'"]),
    "comma for a point": (lambda b: b.s.parameter("c", "1,5 kg"), ["1.5"]),
    "energies of no function": (lambda b: lg.System.from_energies([b.m], T=b.m), ["function of time"]),
}


@pytest.mark.parametrize("case", CASES)
def test_a_wrong_description_is_refused_in_words(case: str) -> None:
    spoil, fragments = CASES[case]
    with pytest.raises(ModelError) as caught:
        spoil(Bench())
    message = str(caught.value)
    for fragment in fragments:
        assert fragment in message, message
    assert "Traceback" not in message and len(message) < 1000


@pytest.mark.parametrize(
    ("positions", "fragments"),
    [
        (lambda a, b, L: [(a + b, 0)], ["'a' and 'b' are dependent", "together"]),
        (lambda a, b, L: [(a, 0)], ["'b' moves nothing that has mass"]),
        (lambda a, b, L: [(L * sp.cos(a - b), L * sp.sin(a - b))], ["'a' and 'b' are dependent"]),
        (lambda a, b, L: [(L, 0)], ["'a' moves nothing"]),
    ],
)
def test_dependent_and_idle_coordinates_are_named(positions, fragments) -> None:  # type: ignore[no-untyped-def]
    s = lg.System("bad coordinates")
    a, b = s.coordinates("a b")
    m, L = s.parameters("m L")
    for place in positions(a, b, L):
        s.particle(m, s.origin + place)
    with pytest.raises(ModelError) as caught:
        s.derive()
    for fragment in fragments:
        assert fragment in str(caught.value)


def test_a_rotor_without_inertia_is_named() -> None:
    s = lg.System("spinning point")
    a, b = s.coordinates("a b")
    s.rigid_body(1, 0, at=s.origin + (a, 0), frame=b, name="bob")
    with pytest.raises(ModelError, match="'b' only turns rigid body 'bob', which has no inertia"):
        s.derive()


@pytest.mark.parametrize("inertia", [(1, 1, 2), (0, 1, 1), (1e-12, 1e-12, 1e-12), (1e9, 1e9, 2e9)])
def test_thin_rods_and_plates_are_bodies(inertia) -> None:  # type: ignore[no-untyped-def]
    assert body(inertia).model.bodies[0].name == "plate"


@pytest.mark.parametrize("name", ["E", "I", "N", "S", "beta", "gamma", "lambda_", "zeta", "Q", "O", "C", "θ", "x_1"])
def test_names_that_sympy_uses_itself_are_ordinary(name: str) -> None:
    s = lg.System("names")
    q = s.coordinates("q")
    m = s.parameters(name)
    s.particle(m, s.origin + (q, 0))
    assert m * q.diff() ** 2 / 2 == s.derive().T
