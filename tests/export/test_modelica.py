"""Models of Modelica: compiled by Rumoca and read by pymoca where these are installed, and read back as Python."""

import pathlib
import re
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from foreign import holds, states_of

import built_in
import lagrangian as lg
from lagrangian import examples
from lagrangian.codegen.modelica import FUNCTIONS, to_modelica
from lagrangian.export import exported_files, program_of
from lagrangian.export.modelica import ModelicaNames
from lagrangian.export.start import start_of
from lagrangian.graph import Graph, Output, Program, evaluate
from lagrangian.graph.graph import UNARY
from lagrangian.verify.foreign.checks import answers, largest_difference
from lagrangian.verify.foreign.runs import MissingError

NAMES: dict[str, Any] = {
    name: getattr(np, other)
    for name, other in (
        *((x, x) for x in ("sqrt", "sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log", "abs", "sign")),
        *((x, "arc" + x[1:]) for x in ("asin", "acos", "atan", "atan2")),
        *(("inverse_" + x, "arc" + x) for x in ("sinh", "cosh", "tanh")),
        *(("min", "minimum"), ("max", "maximum")),
    )
}


def conditional(text: str) -> str:
    """``if noEvent(c) then a else b`` as Python writes it, the innermost first."""
    pattern = re.compile(r"\(?if noEvent(\((?:[^()]|\([^()]*\))*\)) then ")
    while found := list(pattern.finditer(text)):
        last = found[-1]
        rest = text[last.end() :]
        depth = 0
        for at, sign in enumerate(rest):
            depth += {"(": 1, ")": -1}.get(sign, 0)
            if depth == 0 and rest[at:].startswith(" else "):
                break
        opened = "(" if last[0].startswith("(if") else ""
        text = f"{text[: last.start()]}{opened}({rest[:at]}) if {last[1]} else {rest[at + 6 :]}"
    return text


def solved(text: str, values: dict[str, float]) -> dict[str, float]:
    """The values of everything after the equations, which stand in an order in which they can be computed."""
    found: dict[str, Any] = {**NAMES, **values, "noEvent": lambda x: x}
    for line in text.split("\nequation\n")[1].splitlines()[:-1]:
        name, expression = line.strip().rstrip(";").split(" = ", 1)
        word = re.sub(r"^der\((.*)\)$", r"der_\1", name)
        found[word] = eval(compile(conditional(expression.replace("^", "**")), "equation", "eval"), found)
    return found


@pytest.mark.parametrize("name", [pytest.param(x, marks=[pytest.mark.slow] * (x != "four-bar")) for x in built_in.SOME])
def test_equations_read_back_give_the_numbers_of_the_compiled_code(name: str) -> None:
    s, state = built_in.system(name), states_of(name)[0]
    (text,) = exported_files(s.model, "modelica", "S").values()
    assert isinstance(text, str)
    dyn = s.compile()
    lam = dyn.multipliers(*(np.array(state[x]) for x in "qvup"), state["t"][0]) if s.model.constraints else {}
    names = ModelicaNames.of(s.model, len(lam))
    values = {n: x for group in "qvup" for n, x in zip(getattr(names, group), state[group], strict=True)}
    found = solved(text, {**values, "time": state["t"][0]})
    q, v, u, p = (np.array(state[group]) for group in "qvup")
    expected = dyn.rhs(state["t"][0], np.concatenate([q, v]), u, p)
    got = [found[f"der_{n}"] for n in (*names.q, *names.v)]
    np.testing.assert_allclose(got, expected, rtol=0, atol=1e-12 * np.abs(expected).max())
    T, V = dyn.energies(q, v, u, p, state["t"][0])
    np.testing.assert_allclose([found["energy_kinetic"], found["energy_potential"]], [T, V], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose([found[n] for n in names.lam], [*lam.values()], rtol=1e-11)


def test_every_operation_is_written() -> None:
    """Precedence, conditions within each other, and comparisons of reals, which have no ``==``."""
    g = Graph()
    a, b = g.input("q", 0), g.input("q", 1)
    rows = [g.unary(name, a) for name in UNARY if name not in ("asin", "acos", "acosh", "atanh")]
    rows += [getattr(g, name)(a, b) for name in ("add", "sub", "mul", "div", "min", "max", "pow", "atan2")]
    rows += [g.sub(a, g.neg(b)), g.mul(g.neg(a), g.neg(b)), g.neg(g.powi(a, 2)), g.powi(g.neg(a), 3), g.powi(a, -3)]
    flags = [g.lt(a, b), g.le(a, b), g.eq(a, b)]
    flags += [g.and_(flags[0], g.le(a, g.const(1.0))), g.or_(flags[0], flags[2]), g.not_(flags[1])]
    picked = [g.select(flag, a, g.const(-7.0)) for flag in flags]
    rows += [*picked, g.select(flags[0], picked[1], g.mul(a, picked[3])), g.abs(a), g.sign(g.sub(a, b))]
    rows += [g.mul(g.const(-2.5), picked[0]), g.add(picked[0], g.mul(picked[3], picked[1]))]
    made = Program("all", g, {"q": ("a", "b")}, {"r": Output(tuple(rows), (len(rows),))}, {})
    _, outputs, lines = to_modelica(made, {("q", 0): "a", ("q", 1): "b"}, "r_")
    text = "\nequation\n" + "\n".join([*lines, *(f"y{k} = {x};" for k, x in enumerate(outputs["r"]))]) + "\nend;"
    assert "==" not in text
    for a_value, b_value in ((0.3, 0.7), (0.7, 0.3), (0.5, 0.5), (2.0, 3.0), (2.5, 1.5)):
        found = solved(text, {"a": a_value, "b": b_value})
        got = [float(found[f"y{k}"]) for k in range(len(rows))]
        np.testing.assert_allclose(got, evaluate(made, {"q": [a_value, b_value]})["r"], rtol=1e-14)


@pytest.mark.parametrize("kind", FUNCTIONS)
def test_the_inverse_functions_hold_for_small_arguments_too(kind: str) -> None:
    """Their algorithms, read as Python, against NumPy's."""
    text = FUNCTIONS[kind].replace(" := ", " = ").replace("^", "**")
    assigned = re.findall(r"^ +(?:Real )?(\w+) = (.*);$", text, flags=re.M)
    assert assigned[-1][0] == "y"
    for x in (1e-12, -3e-7, 0.002, 0.4, -0.9) if kind != "acosh" else (1.0001, 1.5, 40.0):
        found: dict[str, Any] = {**NAMES, "x": x, "noEvent": lambda c: c}
        for name, expression in assigned:
            found[name] = eval(compile(conditional(expression), kind, "eval"), found)
        wanted = getattr(np, "arc" + kind[1:])(x)
        assert abs(found["y"] - wanted) <= 1e-11 * abs(wanted)


def test_names_that_modelica_does_not_take_are_replaced(tmp_path: pathlib.Path) -> None:
    s = lg.System('the "end"')
    end, der = s.coordinates("end der")
    m, factor = s.parameter("m", 1.0), s.parameter("u1", 2.0)
    s.particle(m, at=s.origin + (end, der))
    s.force((s.input("input") * factor, 0), at=s.origin + (end, der))
    (path,) = s.export(tmp_path / "S.mo")
    text = path.read_text(encoding="utf-8")
    assert (
        "Real q1(" in text
        and "Real q2(" in text
        and ("parameter Real p2(" in text or "parameter Real p2 " in text)
        and "input Real u1" in text
    )
    assert 'model S "the _end_"' in text


needs_rumoca = pytest.mark.skipif(find_spec("rumoca") is None, reason="Rumoca is not installed")
SMALL = "capacitive-actuator"
"""An example that Rumoca's solvers take no step of from random states: they are many orders too large for it."""


@pytest.mark.thinned(4)
@pytest.mark.slow
@needs_rumoca
@pytest.mark.parametrize("name", [x for x in examples.names() if x != SMALL])
def test_rumoca_gives_the_numbers_of_the_compiled_code(name: str, tmp_path: pathlib.Path) -> None:
    holds(name, "modelica", tmp_path)


@pytest.mark.slow
@needs_rumoca
def test_rumoca_gives_them_where_states_are_small(tmp_path: pathlib.Path) -> None:
    model = built_in.system(SMALL).model
    state = {"q": [2e-14, 3e-7], "v": [1e-8, 2e-3], "a": [0.0, 0.0], "u": [4.0], "t": [0.0]}
    states = [{**state, "p": [x.value for x in model.parameters]}]
    made, found = answers(model, "modelica", states, tmp_path)
    assert found["rhs"][0].shape == (1, 4)
    assert largest_difference(made, found, states) < 1e-12
    with pytest.raises(MissingError, match="takes no step"):
        answers(model, "modelica", states_of(SMALL), tmp_path)


@pytest.mark.slow
@needs_rumoca
@pytest.mark.parametrize("name", ["cart-pole", "four-bar", "rolling-disc"])
def test_runs_by_rumoca_are_ours(name: str) -> None:
    import rumoca

    s = built_in.system(name)
    (text,) = exported_files(s.model, "modelica", "S").values()
    assert isinstance(text, str)
    given = ", ".join(f"{x.name} = 0.3" for x in s.model.inputs)
    model = rumoca.Session().loads(f"{text}model Run S part({given}); end Run;", model="Run")
    there = model.simulate(t=(0, 1), dt=0.1, config=rumoca.SimConfig(rtol=1e-10, atol=1e-12, dt=0.1))
    start, n = start_of(s.model), len(s.model.coordinates)
    initial = {c.name: x for c, x in zip(s.model.coordinates, start.x[:n], strict=True)}
    initial |= {v.name: x for v, x in zip(s.model.velocities, start.x[n:], strict=True)}
    here = s.simulate(1.0, samples=11, initial=initial, inputs={x.name: 0.3 for x in s.model.inputs}, rtol=1e-11)
    for c in s.model.coordinates:
        np.testing.assert_allclose(np.ravel(there[f"part.{c.name}"])[-1], here[c.name][-1], rtol=0, atol=1e-7)


@pytest.mark.slow
@pytest.mark.skipif(find_spec("pymoca") is None, reason="pymoca is not installed")
@pytest.mark.parametrize("name", ["cart-pole", "four-bar", "bead-on-parabola", "kapitza-pendulum"])
def test_pymoca_reads_the_model(name: str) -> None:
    from pymoca import parser

    (text,) = exported_files(built_in.system(name).model, "modelica", "S").values()
    assert isinstance(text, str)
    tree = parser.parse(text)
    model = tree.classes["S"]
    found = {symbol.name for symbol in model.symbols.values()}
    program = program_of(built_in.system(name).model, "rhs")
    assert len(found) > len(program.inputs["x"]) + len(program.inputs["p"])
    assert len(model.equations) == text.split("\nequation\n")[1].count(";") - 1
