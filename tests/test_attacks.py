"""Misuse of the Python interface: one readable error each, and unusual input that is right accepted."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.errors import Error
from lagrangian.write import write_file


def cart():
    system = lg.System("cart")
    x = system.coordinate("x")
    m = system.parameter("m", 2.0)
    system.particle(m, at=system.origin + (x, 0))
    return system, x


n = sp.Symbol("n")


@pytest.mark.parametrize(
    ("value", "said"),
    [
        (sp.Sum(n, (n, 0, sp.Symbol("m"))), "is not supported"),
        (sp.Lambda(n, n), "is not supported"),
        (sp.AccumBounds(0, 1), "is not supported"),
        (sp.floor(sp.Symbol("m")), "is not supported"),
        (sp.Rational(1, 10**400), "largest floating-point number"),
        (10**400, "largest floating-point number"),
        (np.float64("nan"), "finite"),
        (np.array([1.0]), "must be a number"),
    ],
)
@pytest.mark.parametrize("slot", ["particle", "potential", "generalized_force"])
def test_an_expression_the_engine_cannot_hold_is_refused_where_it_is_given(value, said, slot):
    system, x = cart()
    calls = {
        "particle": lambda: system.particle(value, at=system.origin + (x, 1)),
        "potential": lambda: system.potential(value),
        "generalized_force": lambda: system.generalized_force(x, value),
    }
    with pytest.raises(lg.ModelError, match=said):
        calls[slot]()


@pytest.mark.parametrize("mass", [np.float64(0.1), np.float32(0.1), 0.1])
def test_numbers_of_numpy_are_numbers(mass):
    system = lg.System("cart")
    x = system.coordinate("x")
    system.particle(mass, at=system.origin + (x, 0))
    assert system.derive().mass_matrix[0, 0] == sp.Rational(1, 10)


def test_whole_numbers_of_numpy_are_numbers():
    system, x = cart()
    system.spring(np.int32(3), deflection=x)
    assert system.compile().forward([1.0], [0.0]) == pytest.approx([-1.5])


def test_a_body_that_does_not_turn_moves_like_a_particle():
    system = lg.System("sliding block")
    x = system.coordinate("x")
    m, J = system.parameters("m J")
    system.rigid_body(m, J, at=system.origin + (x, 0), frame=sp.Rational(1, 3))
    assert system.derive().mass_matrix == sp.Matrix([[m]])


@pytest.mark.parametrize("function", [sp.Abs, sp.sign, lambda x: sp.Max(x, 1), lambda x: sp.Min(x, 1)])
def test_a_position_with_a_kink_is_refused_by_its_place(function):
    system = lg.System("kink")
    x = system.coordinate("x")
    with pytest.raises(lg.ModelError, match=r"component 1 of .* the velocity would jump"):
        system.particle(1, at=system.origin + (function(x), 0))


@pytest.mark.parametrize("kind", ["spring", "damper", "force"])
def test_what_acts_on_nothing_is_refused(kind):
    system, _ = cart()
    with pytest.raises(lg.ModelError, match="acts on nothing"):
        getattr(system, kind)(1, deflection=3)


@pytest.mark.parametrize("law", [int, len, float])
def test_a_law_that_takes_no_symbol_is_told(law):
    system, x = cart()
    with pytest.raises(lg.ModelError, match="law"):
        system.spring(law=law, deflection=x)


@pytest.mark.parametrize(
    "misuse",
    [
        lambda s, x: s.frame(x, parent="B"),
        lambda s, x: s.frame(x, origin="A"),
        lambda s, x: s.point("P", (x, 0), relative_to="A"),
        lambda s, x: s.point("P", (x, 0), frame=x),
        lambda s, x: s.point(np.zeros(2), (x, 0)),
        lambda s, x: s.particle(1, at=s.origin + (x, 0), name=x > 0),
        lambda s, x: s.coordinates(None),
        lambda s, x: s.parameter("k", 1.0, unit=3),
        lambda s, x: s[None],
        lambda s, x: s.save(None),
        lambda s, x: s.export(None),
        lambda s, x: lg.load(None),
        lambda s, x: lg.loads(b""),
        lambda s, x: lg.System.from_energies(3, T=x),
        lambda s, x: lg.System.from_energies([x], T=None),
        lambda s, x: lg.System.from_energies([x], T=x.diff() ** 2, Xi=3),
        lambda s, x: s.compile(threads="2"),
        lambda s, x: s.compile(threads=1.5),
        lambda s, x: s.compile(lanes=True),
        lambda s, x: s.compile().program([]),
        lambda s, x: s.compile().rhs(0.0, 1.0),
        lambda s, x: s.compile().rhs(0.0, None),
        lambda s, x: s.compile().rhs(0.0, [[1], [1, 2]]),
    ],
)
def test_a_wrong_type_is_one_readable_error(misuse):
    system, x = cart()
    with pytest.raises(Error):
        misuse(system, x)


shell = pytest.mark.skipif(not Path("/dev/full").is_char_device(), reason="no /dev/full here")


@shell
@pytest.mark.slow
def test_a_full_disk_is_one_message():
    with Path("/dev/full").open("wb") as full:
        command = [sys.executable, "-m", "lagrangian", "schema"]
        done = subprocess.run(command, stdout=full, stderr=subprocess.PIPE, text=True, check=False)
    assert done.returncode == 2
    assert "no space left" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="closing a descriptor is the shell's")
@pytest.mark.parametrize("closed", ["derive -e lecture-1 >&-", "derive - <&-"])
def test_a_closed_stream_is_one_message(closed):
    done = subprocess.run(
        ["sh", "-c", f"'{sys.executable}' -m lagrangian {closed}"], capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert "is closed" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_an_output_that_is_no_regular_file_is_written_into_never_replaced(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    try:
        write_file(pipe, "equations\n")
        assert os.read(reader, 100) == b"equations\n"
    finally:
        os.close(reader)
    assert pipe.is_fifo()
