"""Model files: what they mean, that they are written back as the same system, and the published schema."""

import tomllib

import jsonschema
import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

from built_in import LARGE, SOME
from lagrangian import examples
from lagrangian.errors import ModelError
from lagrangian.model import (
    Builder,
    Damper,
    Dissipation,
    Force,
    GeneralizedForce,
    Gravity,
    Kinetic,
    Model,
    Particle,
    Potential,
    RigidBody,
    Spring,
    Torque,
    time,
)
from lagrangian.read import dumps, load, loads, schema
from size import rest_slow, sized

CARTS = """
name = "two carts and a spring"

[coordinates]
x1 = "cart 1, from the wall"
x2 = { description = "cart 2, from cart 1 (relative)", unit = "m" }

[parameters]
m1 = "1 kg"
m2 = { value = 2000, unit = "g", description = "cart 2" }
k = 40
c = { unit = "N*s/m" }

[inputs]
F = "N, pushes the carts apart"

[define]
X2 = "x1 + x2"

[points]
A = ["x1", "0"]
B = { from = "A", offset = ["x2", 0] }

[[spring]]
k = "k"
deflection = "x2"

[[particle]]
name = "cart 1"
mass = "m1"
at = "A"

[[force]]
value = "F"
deflection = "x2"

[[particle]]
name = "cart 2"
mass = "m2"
at = "B"

[simulate]
duration = "10 s"
initial = { x2 = "0.4 m", "x1'" = 1 }
"""


def summary(model: Model) -> list[object]:
    """Everything a model says, in a form that can be compared."""
    d = model.dimension
    rows: list[object] = [model.name, d, dict(model.settings)]
    for c in model.coordinates:
        rows.append((c.name, c.symbol, c.description, c.unit))
    for p in model.parameters:
        rows.append((p.name, p.symbol, p.value, p.description, p.unit is None))
    for i in model.inputs:
        rows.append((i.name, i.symbol, i.description, i.unit))
    rows += [(x.name, x.symbol, x.expression) for x in model.definitions]
    for e in model.elements:
        rows.append((e.kind, e.name, [u.expr for u in e.uses()]))
        rows.append([list(model.position(p)) for _, p in e.points()])
        rows.append([list(f.rotation) for _, f in e.frames()])
        rows.append([e.kinetic(model), e.potential(model)])
        rows.append([(a.effort, a.rate) for a in e.works(model)])
    return rows


def same(one: object, two: object) -> bool:
    """Whether two summaries agree; expressions that are written differently are multiplied out."""
    if isinstance(one, list | tuple) and isinstance(two, list | tuple):
        return len(one) == len(two) and all(map(same, one, two))
    return one == two or (
        isinstance(one, sp.Expr) and isinstance(two, sp.Expr) and bool(sp.expand(one) == sp.expand(two))
    )


def test_a_file_means_what_it_says() -> None:
    model = loads(CARTS).model()
    x1, x2 = (c.symbol for c in model.coordinates)
    assert [c.unit for c in model.coordinates] == [None, "m"]
    assert [(p.name, p.value, p.unit) for p in model.parameters] == [
        ("m1", 1.0, "kg"),
        ("m2", 2.0, "g"),
        ("k", 40.0, None),
        ("c", None, "N*s/m"),
    ]
    assert (model.inputs[0].unit, model.inputs[0].description) == ("N", "pushes the carts apart")
    assert model.definitions[0].expression == x1 + x2
    assert [e.title for e in model.elements] == ["spring 'k'", "particle 'cart 1'", "force 'F'", "particle 'cart 2'"]
    assert model.position(model.bodies[1].at) == (x1 + x2, 0)
    assert model.settings == {"duration": "10 s", "initial": {"x2": "0.4 m", "x1'": 1}}
    place = model.elements[3].place
    assert place is not None and (place.line, place.text) == (
        CARTS[: CARTS.rindex("[[particle]]")].count("\n") + 1,
        "[[particle]]",
    )


def test_a_file_is_written_back_as_the_same_system() -> None:
    model = loads(CARTS).model()
    text = dumps(model)
    again = loads(text).model()
    assert same(summary(again), summary(model))
    assert dumps(again) == text


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", rest_slow(examples.names(), set(examples.names()) - LARGE))
def test_built_in_examples_round_trip(name: str) -> None:
    model = loads(examples.text(name), name).model()
    again = loads(dumps(model), name).model()
    assert same(summary(again), summary(model))


@pytest.fixture(scope="module")
def published() -> jsonschema.Draft202012Validator:
    return jsonschema.Draft202012Validator(schema())


@pytest.mark.parametrize("name", examples.names())
def test_the_schema_accepts_what_the_reader_accepts(name: str, published: jsonschema.Draft202012Validator) -> None:
    published.validate(tomllib.loads(examples.text(name)))


@pytest.mark.slow
def test_schema_is_a_draft_2020_12_schema_with_a_description_on_every_field() -> None:
    made = schema()
    jsonschema.Draft202012Validator.check_schema(made)
    assert made["$schema"].endswith("2020-12/schema")
    tables = [made, *made["$defs"].values()]
    for table in tables:
        assert table.get("additionalProperties", False) is False
        for name, field in table.get("properties", {}).items():
            assert field.get("description"), name
    bad = {"name": "x", "particle": [{"masss": 1, "at": "A"}]}
    assert not jsonschema.Draft202012Validator(made).is_valid(bad)


def everything() -> Builder:
    """A system in space with every kind of element, described as Python does, most points and frames unnamed."""
    b = Builder('all "kinds" \\ of θ')
    q, s, u = (b.coordinate(n, description=d).symbol for n, d in (("q", ""), ("θ₁", "turn"), ("u", 'with "quotes"')))
    m, k, J = (
        b.parameter(n, v, unit=un).symbol for n, v, un in (("m", 0.1, "lb"), ("k", 3.0, "N/m"), ("J", None, None))
    )
    tau = b.input("tau", description="N, not the unit", unit="N*m").symbol
    half = b.define("half", q / 2).symbol
    arm = b.frame(None, s, axis=(0, 0, 1))
    wrist = b.frame("wrist", u, axis=(1, 1, 0), parent=arm, origin=b.origin + (half, 0, 0))
    elbow = arm.point(sp.Rational(1, 3), 0, 0)
    tip = wrist.point(0, q, 1, at=elbow)
    plus = tip + (0, 0, q)
    b.add(Particle(mass=m, at=tip))
    b.add(Spring(k=k, between=(b.origin, plus), rest=1, name="first"))
    b.add(RigidBody(mass=2 * m, inertia=(J, J, J / 2), at=wrist.point(1, 2, 3), frame=wrist, name="top"))
    b.add(RigidBody(mass=m, inertia=[[3, -1, 0], [-1, 3, 0], [0, 0, 4]], at=plus, frame=arm, name="tensor"))
    b.add(Gravity(direction=(0, 3, -4), g=b.standard_gravity(9.81), datum=b.origin + (0, 0, 2)))
    b.add(Spring(law=lambda delta: k * delta + 3 * delta**3, deflection=q, name="hard"))
    b.add(Spring(energy=lambda delta: k * delta**4, deflection=s, name="quartic"))
    b.add(Damper(b=2, deflection=q))
    b.add(Damper(law=lambda rate: k * rate * sp.Abs(rate), between=(elbow, tip), name="drag"))
    b.add(Force(value=(0, tau, sp.sin(time)), at=tip, reaction=b.origin, axes=wrist))
    b.add(Force(value=sp.Piecewise((k, q > 0), (0, True)), deflection=q, name="stop"))
    b.add(Torque(value=tau, on=wrist, reaction=arm))
    b.add(Torque(value=(0, 0, tau), on=arm, name="vector"))
    b.add(Potential(value=k * sp.cos(q) / 3))
    b.add(Kinetic(value=m * q.diff(time) ** 2))
    b.add(Dissipation(value=k * s.diff(time) ** 2))
    b.add(GeneralizedForce(coordinate=s, value=-tau * s.diff(time)))
    b.settings["duration"] = 2.5
    return b


@pytest.mark.slow
def test_everything_python_can_describe_a_file_can() -> None:
    model = everything().model()
    text = dumps(model)
    again = loads(text).model()
    assert same(summary(again), summary(model))
    assert dumps(again) == text


def test_energies_section() -> None:
    text = """name = "by energies"
coordinates = { x = "" }
parameters = { m = 1, k = 2, c = 3 }
[inputs]
F = ""
[energies]
T = "1/2*m*x'^2"
V = "1/2*k*x^2"
D = "1/2*c*x'^2"
Xi = { x = "F" }
"""
    model = loads(text).model()
    assert [(e.kind, e.name) for e in model.elements] == [
        ("kinetic", "T*"),
        ("potential", "V"),
        ("dissipation", "D"),
        ("generalized_force", "Xi_x"),
    ]
    assert same(summary(loads(dumps(model)).model()), summary(model))


def test_plane_body_turned_by_an_angle() -> None:
    text = CARTS + '[[rigid_body]]\nmass = 1\ninertia = 2\nat = ["x1", 1]\nframe = "x1/3"\n'
    model = loads(text).model()
    assert model.bodies[-1].frame.total_angle == model.coordinates[0].symbol / 3
    assert same(summary(loads(dumps(model)).model()), summary(model))


def test_points_and_frames_may_refer_to_later_ones() -> None:
    text = """name = "later"
coordinates = { a = "" }
[[frame]]
name = "f"
angle = "a"
origin = "P"
[points]
Q = { frame = "f", offset = [1, 0] }
P = [2, 0]
[[particle]]
mass = 1
at = "Q"
"""
    model = loads(text).model()
    a = model.coordinates[0].symbol
    assert model.position(model.bodies[0].at) == (2 + sp.cos(a), sp.sin(a))


def test_what_the_grammar_has_no_word_for_is_refused_with_its_place() -> None:
    b = Builder("x")
    x = b.coordinate("x").symbol
    b.add(Particle(mass=1, at=b.origin + (x, 0)))
    largest = sp.Max(*(k * x + k**2 for k in range(33)), evaluate=False)  # the grammar takes 32
    b.add(Force(value=largest, deflection=x, name="largest"))
    with pytest.raises(ModelError, match=r"value of force 'largest' cannot be written to a model file: .*max"):
        dumps(b.model())


def test_a_step_is_written_in_cases() -> None:
    b = Builder("x")
    x = b.coordinate("x").symbol
    b.add(Particle(mass=1, at=b.origin + (x, 0)))
    b.add(Force(value=sp.Heaviside(x), deflection=x, name="step"))
    (force,) = [e for e in loads(dumps(b.model())).model().elements if e.name == "step"]
    for at in (-1, 0, 1):
        assert force.value.subs(x, at) == sp.Heaviside(at, sp.Rational(1, 2))  # type: ignore[attr-defined]


def test_a_saved_file_loads(tmp_path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "θ carts.toml"
    path.write_text(CARTS, encoding="utf-8")
    assert same(summary(load(path).model()), summary(loads(CARTS).model()))


@sized(150, 20)
@given(
    st.floats(allow_nan=False, allow_infinity=False).filter(lambda v: v == 0 or 1e-150 < abs(v) < 1e150),
    st.sampled_from([None, "kg", "mm", "deg", "lbf", "N/m", "km/h", "rpm", "°", "m^(1/2)"]),
)
def test_parameter_values_survive_to_the_last_bit(value: float, unit: str | None) -> None:
    b = Builder("x")
    x = b.coordinate("x").symbol
    b.parameter("p", value, unit=unit)
    b.add(Particle(mass=1, at=b.origin + (x, 0)))
    assert loads(dumps(b.model())).model().parameters[0].value == value


@sized(100, 15)
@given(st.text(max_size=30), st.text(max_size=30))
def test_any_description_survives(first: str, second: str) -> None:
    b = Builder("x")
    x = b.coordinate("x", description=first).symbol
    b.input("F", description=second)
    b.add(Particle(mass=1, at=b.origin + (x, 0)))
    again = loads(dumps(b.model())).model()
    assert (again.coordinates[0].description, again.inputs[0].description) == (first, second)


@pytest.mark.parametrize(
    "law", ["max(k*delta, 0)", "min(delta, k, 2*delta)", "k*max(delta, 0, k - delta, 3, k*delta)^2"]
)
def test_maxima_and_minima_come_back(law: str) -> None:
    text = f'''
name = "stop"
[coordinates]
q = ""
[parameters]
k = 2
[[particle]]
mass = 1
at = ["q", 0]
[[force]]
value = "{law.replace("delta", "q")}"
deflection = "q"
'''
    first = loads(text).model()
    again = loads(dumps(first)).model()
    assert dumps(again) == dumps(first)
    assert [e.value for e in again.elements[1:]] == [e.value for e in first.elements[1:]]  # type: ignore[attr-defined]
