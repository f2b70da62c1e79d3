"""What is wrong with a circuit is said where it is described, with what would be right."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
import sympy as sp

import lagrangian as lg


def loop() -> tuple[lg.System, Any, Any]:
    s = lg.System("loop")
    return s, s.coordinate("q", unit="C"), s.coordinate("x", unit="m")


WRONG: dict[str, tuple[Callable[[lg.System, Any, Any], object], str, str]] = {
    "no charge": (lambda s, q, x: s.inductor(1), "E412", "it is in no circuit"),
    "a charge that is a product": (lambda s, q, x: s.inductor(1, q * x), "E412", "is not a sum of charges"),
    "a current for a charge": (lambda s, q, x: s.resistor(1, q.diff()), "E412", "is not a sum of charges"),
    "a constant charge": (lambda s, q, x: s.capacitor(1, 2), "E412", "no coordinate is in its charge 2"),
    "text for a charge": (lambda s, q, x: s.capacitor(1, "q"), "E406", "must be a number or a SymPy expression"),
    "neither L nor a law": (lambda s, q, x: s.inductor(charge=q), "E416", "one of L, law and coenergy (got none)"),
    "L and a law": (lambda s, q, x: s.inductor(1, q, law=lambda i: i), "E416", "(got L, law)"),
    "C and energy": (lambda s, q, x: s.capacitor(1, q, energy=lambda e: e**2), "E416", "(got C, energy)"),
    "a source without a value": (lambda s, q, x: s.voltage_source(None, q), "E416", "its voltage is missing"),
    "a motor that drives nothing": (lambda s, q, x: s.transducer(1, q), "E416", "its on is missing"),
    "a given current through nothing that moves": (
        lambda s, q, x: s.inductor(1, charge=2 * s.t), "E412", "no coordinate is in its charge 2*t"
    ),
    "a given charge that nothing changes": (
        lambda s, q, x: s.capacitor(1, charge=2 * s.t), "E412", "no coordinate is in its charge 2*t"
    ),
    "one coil twice": (lambda s, q, x: s.mutual_inductance(1, q, q), "E410", "both of its coils have the same charge"),
    "an inductance of a rate": (lambda s, q, x: s.inductor(x.diff(), q), "E419", "the inductance contains a rate, x'"),
    "an inductance of an input": (lambda s, q, x: s.inductor(s.input("w"), q), "E417", "contains the input"),
    "a law without integral": (lambda s, q, x: s.inductor(None, q, law=lambda i: sp.sin(i**3)), "E415", "coenergy"),
    "a law that cannot be called": (lambda s, q, x: s.resistor(charge=q, law=lambda i: i < 1 and i), "E406", "law"),
    "a capacitance of 0": (lambda s, q, x: s.capacitor(0, q), "E103", "its capacitance is zero"),
    "an unknown charge": (lambda s, q, x: s.inductor(1, sp.Function("p")(s.t)), "E402", "p"),
    "a frame in space": (
        lambda s, q, x: s.transducer(1, q, on=s.frame(x, axis=(0, 0, 1))), "E414", "about which axis it turns"
    ),
    "a name that is not one": (lambda s, q, x: s.resistor(R=1, charge=q, **dict[str, Any](wires=2)), "E501", "wires"),
}  # fmt: skip


@pytest.mark.parametrize("what", WRONG)
def test_a_wrong_circuit_is_refused(what: str) -> None:
    make, code, message = WRONG[what]
    s, q, x = loop()
    with pytest.raises(lg.Error) as found:
        make(s, q, x)
    assert message in str(found.value), str(found.value)
    assert found.value.code == code or what == "a name that is not one"


@pytest.mark.parametrize(("L", "code"), [(-1, "E102"), (0, "E103"), ("-2 mH", "E102")])
def test_an_inductance_is_positive(L: Any, code: str) -> None:
    s, q, _ = loop()
    s.inductor(s.parameter("L", L) if isinstance(L, str) else L, q)
    with pytest.raises(lg.Error, match="its inductance") as found:
        s.derive()
    assert found.value.code == code


def test_charges_without_a_coil_are_told_by_every_verb() -> None:
    s, q, x = loop()
    s.particle(1, s.point("P", (x, 0)))
    s.resistor(1, q)
    s.capacitor(1, q)
    for verb in (s.derive, s.compile, s.linearize, s.equilibria, lambda: s.simulate(1)):
        with pytest.raises(lg.Error, match="the circuit of charge 'q' has no inductance") as found:
            verb()
        assert found.value.code == "E201" and "add an inductor that 'q' flows through" in str(found.value)
    bare = lg.System("RC")
    bare.resistor(1, bare.coordinate("q"))
    with pytest.raises(lg.Error, match="nothing in system 'RC' has inductance"):
        bare.derive()


FILE = """
name = "loop"
[coordinates]
q = { description = "charge", unit = "C" }
[parameters]
L = "1 H"
[[inductor]]
charge = "q"
L = "L"
"""


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (('charge = "q"', ""), "charge"),
        (('charge = "q"', 'charge = "p"'), "'p'"),
        (('L = "L"\n', 'l = "L"\n'), "'l'"),
        (('L = "L"', 'law = "L*curent"'), "curent"),
        (('L = "1 H"', 'L = "1 F"'), "has the unit F, but H is needed"),
        (('unit = "C"', 'unit = "A"'), "has the unit A, but C is needed"),
        (('L = "L"', 'law = "L*current^2"'), "L*current^2 has the unit N m, but Wb is needed"),
        (("[[inductor]]", "[[indcutor]]"), "inductor"),
    ],
)
def test_a_wrong_file_is_refused_with_its_line(change: tuple[str, str], message: str) -> None:
    with pytest.raises(lg.Error) as found:
        lg.loads(FILE.replace(*change)).derive()
    assert message in str(found.value), str(found.value)
    lg.loads(FILE).derive()


MOTOR = """
name = "motor"
[coordinates]
q = { description = "charge", unit = "C" }
theta = "rotor"
[parameters]
L = "1 mH"
R = "2 ohm"
K = "0.1 V*s/rad"
J = "1 g*m^2"
[inputs]
u = "V, voltage"
[energies]
T = "J*theta'^2/2"
[[inductor]]
charge = "q"
L = "L"
[[resistor]]
charge = "q"
R = "R"
[[voltage_source]]
charge = "q"
value = "u"
[[transducer]]
charge = "q"
k = "K"
on = "theta"
"""


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (('"0.1 V*s/rad"', '"0.1 N/A"'), "its constant K has the unit N/A, but Wb is needed"),
        (('"2 ohm"', '"2 S"'), "its resistance R has the unit S, but Ω is needed"),
        (('"V, voltage"', '"A, voltage"'), "its voltage u has the unit A, but V is needed"),
        (('unit = "C"', 'unit = "m"'), "its charge q has the unit m, but C is needed"),
        (('"1 g*m^2"', '"1 K"'), "K"),
    ],
)
def test_units_of_a_motor_fit_together(change: tuple[str, str], message: str) -> None:
    lg.loads(MOTOR).compile()
    with pytest.raises(lg.Error) as found:
        lg.loads(MOTOR.replace(*change)).compile()
    assert message in str(found.value) and found.value.code == "E408"


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"params": {"R": "3 V"}}, "parameter 'R' = '3 V' has the unit V, but Ω is needed"),
        ({"inputs": {"u": "5 A"}}, "input 'u' = '5 A' has the unit A, but V is needed"),
        ({"initial": {"q'": "2 V"}}, "state 'q'' = '2 V' has the unit V, but A is needed"),
        ({"initial": {"q": "2 A"}}, "state 'q' = '2 A' has the unit A, but C is needed"),
    ],
)
def test_values_of_a_run_have_the_units_of_circuits(given: dict[str, Any], message: str) -> None:
    s = lg.loads(MOTOR)
    with pytest.raises(lg.Error) as found:
        s.simulate(0.01, **given)
    assert message in str(found.value) and found.value.code == "E408"
    run = s.simulate(0.01, params={"R": "2000 mohm"}, initial={"q'": "1 mA"}, inputs={"u": "0.1 kV"}, samples=3)
    assert run.success and run["q'"][0] == pytest.approx(1e-3)


def test_law_symbols_have_no_meaning_elsewhere() -> None:
    with pytest.raises(lg.Error, match="current"):
        lg.loads(FILE.replace('L = "L"', 'L = "L*current"'))
