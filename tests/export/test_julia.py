"""Modules of Julia: read by a parser where one is installed, and their formulas read back as Python."""

import pathlib
import re
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from foreign import holds, states_of

import built_in
from lagrangian.export import exported_files
from lagrangian.export.programs import exported, program_of
from lagrangian.graph import evaluate


def as_python(text: str) -> dict[str, Any]:
    """The functions of a module of Julia: its assignments are those of Python but for powers, places and conditions."""
    body = text.split("module ", 1)[1]
    found: dict[str, Any] = {}
    for name, arguments, lines in re.findall(r"^function (\w+)\(([^\n]*)\)\n(.*?)^end$", body, flags=re.M | re.S):
        code = [f"def {name}({arguments}):"]
        for line in lines.splitlines():
            bare = line.split("  #")[0].replace("^", "**").replace("!(", "not (")
            if " = " in bare or "return" in bare:
                code.append(re.sub(r"\b(in_\w+)\[(\d+)\]", lambda m: f"{m[1]}[{int(m[2]) - 1}]", bare))
        names: dict[str, Any] = {x: getattr(np, x) for x in ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "abs")}
        names |= {"real_sqrt": np.sqrt, "real_log": np.log, "real_power": np.power, "real_asin": np.arcsin}
        names |= {"real_acos": np.arccos, "asinh": np.arcsinh, "sign": np.sign, "min": np.minimum, "max": np.maximum}
        names |= {"atan": lambda y, x=1.0: np.arctan2(y, x), "ifelse": lambda c, a, b: a if c else b}
        names |= {"PARAMETERS": (), "permutedims": np.ravel, "reshape": lambda x, *shape: x}
        names["Float64"] = {(): ()}
        exec("\n".join(code), names)
        found[name] = names[name]
    return found


@pytest.mark.parametrize("name", [pytest.param(x, marks=[pytest.mark.slow] * (x != "four-bar")) for x in built_in.SOME])
def test_formulas_read_back_give_the_same_numbers(name: str) -> None:
    model, state = built_in.system(name).model, states_of(name)[0]
    (text,) = exported_files(model, "julia", "s").values()
    assert isinstance(text, str)
    functions = as_python(text.replace("Float64[]", "[]"))
    for program_name in exported(model, whole=True):
        program = program_of(model, program_name)
        at = {**state, "x": [*state["q"], *state["v"]]}
        answer = functions[f"s_{program_name}"](*(at[g][0] if g == "t" else at[g] for g in program.inputs))
        answers = answer if isinstance(answer, tuple) else (answer,)
        expected = evaluate(program, {group: at[group] for group in program.inputs}).values()
        for got, wanted in zip(answers, expected, strict=True):
            np.testing.assert_allclose(np.ravel(got), np.ravel(wanted), rtol=1e-12, atol=1e-13)


@pytest.mark.slow
@pytest.mark.skipif(find_spec("tree_sitter_julia") is None, reason="no parser of Julia is installed")
@pytest.mark.parametrize("name", ["cart-pole", "four-bar", "bead-on-parabola"])
def test_a_parser_of_julia_finds_no_error(name: str) -> None:
    import tree_sitter
    import tree_sitter_julia

    (text,) = exported_files(built_in.system(name).model, "julia", "s").values()
    assert isinstance(text, str)
    parser = tree_sitter.Parser(tree_sitter.Language(tree_sitter_julia.language()))
    assert not parser.parse(text.encode("utf-8")).root_node.has_error
    assert parser.parse(text.replace("end\n", "end)\n", 1).encode("utf-8")).root_node.has_error


def test_julia_itself(tmp_path: pathlib.Path) -> None:
    holds("cart-pole", "julia", tmp_path)
