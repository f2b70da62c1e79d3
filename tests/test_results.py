"""What every result has in common: it shows itself shortly, and says which names its mappings have."""

from __future__ import annotations

import copy
import json
import pathlib
import pickle
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

import numpy as np
import pytest
import sympy as sp

import built_in
import lagrangian as lg
from lagrangian import Error
from lagrangian.errors import NoSuchEntry
from lagrangian.viewed import LONGEST


def system(name: str) -> lg.System:
    return built_in.system(name)


@pytest.fixture(scope="module")
def results() -> dict[str, Any]:
    cart, pendulum, top = system("cart-pole"), system("pendulum"), system("spherical-pendulum")
    derivation, run = cart.derive(), cart.simulate(0.1, samples=3, params={"m": 0.3})
    linear = cart.linearize()
    return {
        "system": cart,
        "derivation": derivation,
        "arm": system("robot-arm").derive(),
        "answer": derivation.check("T = 0"),
        "verified": pendulum.verify(states=1),
        "compiled": cart.compile(),
        "conserved": top.conserved_quantities(),
        "Hamilton": top.hamiltonian(),
        "Routh": top.routhian(),
        "equilibria": cart.equilibria(),
        "linearization": linear,
        "symbolic": linear.symbolic,
        "along": cart.linearize_along(run),
        "regulator": linear.lqr(1, 1),
        "comparison": system("lecture-2").compare(system("lecture-2-absolute")),
        "run": run,
        "runs": pendulum.sweep(0.1, ["L=0.5:2:4"], method="rk4", step=0.01, outputs=[f"L+{k}" for k in range(60)]),
        "event": lg.event(cart["x"] - 1),
    }


def parts(thing: Any, path: str, seen: set[int]) -> Iterator[tuple[str, Any]]:
    """What a person reaches from a result: its entries, the fields that it shows and its properties."""
    if id(thing) in seen or isinstance(thing, (str, sp.Basic, sp.MatrixBase, np.ndarray)):
        return
    seen.add(id(thing))
    if isinstance(thing, Mapping) and not type(thing).__module__.startswith("lagrangian.simulate"):
        listed = [(f"{path}[{k!s}]", x) for k, x in thing.items()]
    elif isinstance(thing, (tuple, list)):
        listed = [(f"{path}[{k}]", x) for k, x in enumerate(thing)]
    else:
        yield path, thing
        mine = type(thing).__module__.startswith("lagrangian")
        names = [f.name for f in fields(thing) if f.repr] if mine and is_dataclass(thing) else []
        names += [n for n in dir(type(thing)) if mine and isinstance(getattr(type(thing), n, None), property)]
        listed = [(f"{path}.{n}", getattr(thing, n)) for n in names if not n.startswith("_")]
    for where, part in listed:
        yield from parts(part, where, seen)


@pytest.mark.slow
def test_every_result_shows_itself_shortly(results: dict[str, Any]) -> None:
    shown = {where: repr(x) for name, result in results.items() for where, x in parts(result, name, set())}
    assert len(shown) > 500
    assert {where: len(text) for where, text in shown.items() if len(text) > LONGEST or "\n" in text} == {}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("derivation", "<Derivation of 'pole on a cart': 2 coordinates x, theta; 7 steps; 10 of 10 checks hold"),
        ("answer", "<CheckedAnswer, pole on a cart: wrong>"),
        ("comparison", "'two-link arm, absolute angles': the same>"),
        ("linearization", "<pole on a cart: linearization>"),
    ],
)
def test_a_result_says_of_what_it_is(results: dict[str, Any], name: str, said: str) -> None:
    assert said in repr(results[name])


@pytest.mark.slow
def test_a_step_a_check_and_an_element_are_said_in_a_line(results: dict[str, Any]) -> None:
    d = results["derivation"]
    assert repr(d.steps[2]) == "<Step 2: Kinetic co-energy>"
    assert repr(d.verified[0]).startswith("<Check: the equations agree with virtual work, a route without energies: ho")
    assert repr(results["system"].elements[0]).startswith("Particle(name='cart', mass=M, at=Point(name='cart'")


MISSING = {
    "Xi": lambda k: k["derivation"].Xi["thet"],
    "a step": lambda k: k["derivation"].steps[2].expressions["TT"],
    "a Xi of a step": lambda k: k["derivation"].steps[6].expressions["Xi"]["thet"],
    "the point": lambda k: k["linearization"].at["thet"],
    "a mode": lambda k: k["linearization"].modes[1].shape["thet"],
    "a rest": lambda k: k["equilibria"][0]["thet"],
    "Hamilton's equations": lambda k: k["Hamilton"].equations["thet"],
    "Routh's definitions": lambda k: k["Routh"].definitions["thet"],
    "a run's parameters": lambda k: k["run"].params["mm"],
    "a run's events": lambda k: k["run"].events["thet"],
    "a run's points": lambda k: k["run"].points["cort"],
    "a sweep": lambda k: k["runs"]["final L+1000"],
    "what was swept": lambda k: k["runs"].coordinates["LL"],
    "a system": lambda k: k["system"]["thet"],
    "an element": lambda k: k["system"]["friction 2"],
}


@pytest.mark.parametrize("case", MISSING)
def test_a_name_that_a_result_does_not_have_is_a_key_error_with_the_names(case: str, results: dict[str, Any]) -> None:
    with pytest.raises(KeyError) as caught:
        MISSING[case](results)
    assert isinstance(caught.value, Error) and isinstance(caught.value, ValueError)
    assert any(word in str(caught.value) for word in ("Did you mean", "known: ")), str(caught.value)
    assert len(str(caught.value)) < 700


def test_entries_are_found_by_name_and_by_symbol(results: dict[str, Any]) -> None:
    d, linear, rest = results["derivation"], results["linearization"], results["equilibria"][1]
    x, theta = results["system"]["x"], results["system"]["theta"]
    assert d.Xi["x"] == d.Xi[x] == d.Xi.get("x") and "theta" in d.Xi
    assert "thet" not in d.Xi and d.Xi.get("thet", 3) == 3
    assert linear.at[theta.diff()] == linear.at["theta'"] and rest[theta] == rest["theta"]
    H = results["Hamilton"].equations
    assert H["theta'"] == H[system("spherical-pendulum")["theta"].diff()]


def test_entries_are_still_a_dictionary(results: dict[str, Any]) -> None:
    Xi = results["derivation"].Xi
    for other in (copy.copy(Xi), copy.deepcopy(Xi), pickle.loads(pickle.dumps(Xi))):
        assert other == Xi and other["x"] == Xi["x"]
        with pytest.raises(NoSuchEntry, match="Xi has no entry 'y'"):
            other["y"]
    assert json.loads(json.dumps(results["linearization"].at)) == results["linearization"].at


def test_a_system_knows_whether_a_name_is_in_it(results: dict[str, Any]) -> None:
    s = results["system"]
    for name in ("x", "theta", "M", "F", "cart", "pole"):
        assert name in s and s[name] in s, name
    assert all(e in s and e.name in s for e in s.elements)
    assert "thet" not in s and 3 not in s and sp.Symbol("q") not in s
    assert system("pendulum").elements[0] not in s and lg.System("empty").origin not in s


def test_what_is_written_replaces_a_file_only_when_told(tmp_path: pathlib.Path) -> None:
    """Python's verbs that write a file: ``overwrite=False`` all of them, and the path returned."""
    s = system("pendulum")
    run, runs = s.simulate(0.1, samples=3), s.sweep(0.1, ["L=0.5:2:4"], method="rk4", step=0.01)
    for write, name in (
        (s.save, "a.toml"),
        (s.export, "a.c"),
        (s.export, "a.py"),
        (run.save, "a.csv"),
        (runs.save, "b.csv"),
    ):
        path = tmp_path / name
        assert write(path) in (path, (path,), (path, path.with_suffix(".h")))
        path.write_text("mine", encoding="utf-8")
        with pytest.raises(Error, match="exists already") as caught:
            write(path)
        assert caught.value.code == "E802" and "overwrite=True" in str(caught.value)
        assert path.read_text(encoding="utf-8") == "mine"
        write(path, overwrite=True)
        assert path.read_text(encoding="utf-8") != "mine"
    with pytest.raises(Error, match="exists already"):  # the header alone is enough
        (tmp_path / "a.c").unlink()
        s.export(tmp_path / "a.c")
    assert not (tmp_path / "a.c").exists()
