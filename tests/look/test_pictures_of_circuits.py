"""Circuits in pictures: closed loops of wire, every branch in its loop, and windings on what they move."""

from collections import Counter
from itertools import combinations

import numpy as np
import pytest

import built_in
import lagrangian as lg
from built_in import CIRCUITS, picture
from lagrangian.page.scene import Path, Scene, ScenePart

BRANCHES = ("resistor", "inductor", "capacitor", "voltage_source", "transducer")


def _points(part: ScenePart) -> np.ndarray:
    assert isinstance(part.shape, Path)
    return np.array([numbers[-2:] for _, numbers in part.shape.commands if numbers])


def _meetings(scene: Scene) -> dict[tuple[int, int], Counter[str]]:
    """What meets at each place where a wire ends: wires, and the branches whose outlines are touched there."""
    found: dict[tuple[int, int], Counter[str]] = {}
    for part in scene.parts:
        if part.kind == "wire":
            for x, y in _points(part):
                found.setdefault((round(x), round(y)), Counter())["wire"] += 1
    for name in {p.elements[0] for p in scene.parts if p.kind in BRANCHES}:
        low, high = _outline(scene, name)
        for place, what in found.items():
            what[name] += bool((low - 1 <= place).all() and (place <= high + 1).all())
    return found


def _outline(scene: Scene, name: str) -> tuple[np.ndarray, np.ndarray]:
    found = np.concatenate([_points(p) for p in scene.parts if p.elements == (name,) and p.kind in BRANCHES])
    return found.min(axis=0), found.max(axis=0)


def _middle(scene: Scene, name: str) -> np.ndarray:
    low, high = _outline(scene, name)
    return (low + high) / 2


def _circuit(charges: int, *, letters: str) -> tuple[lg.System, list, list]:
    system = lg.System("circuit")
    qs = [system.coordinate(f"q{i + 1}", unit="C") for i in range(charges)]
    return system, qs, [system.parameter(x) for x in letters.split()]


@pytest.mark.parametrize("name", CIRCUITS)
def test_every_branch_is_drawn_and_no_wire_ends_in_the_air(name: str) -> None:
    model, scene = built_in.system(name).model, picture(name).scene
    drawn = {part.elements[0] for part in scene.parts if part.kind in BRANCHES}
    assert drawn == {e.name for e in model.branches}
    meetings = _meetings(scene)
    assert all(what.total() == 2 for what in meetings.values())
    assert all(sum(what[e.name] for what in meetings.values()) == 2 for e in model.branches)


def test_a_branch_with_the_difference_of_two_charges_lies_between_their_loops() -> None:
    """Kirchhoff's current law at both of its ends: three wires meet there."""
    system, (q1, q2), (L, C, R) = _circuit(2, letters="L C R")
    system.voltage_source(system.input("u", unit="V"), q1)
    system.inductor(L, q1, name="first")
    system.inductor(L, q2, name="second")
    system.capacitor(C, q1 - q2)
    system.resistor(R, q2)
    found = system.look()
    assert not found.missing
    meetings = [what.total() for what in _meetings(found.scene).values()]
    assert set(meetings) == {2, 3} and meetings.count(3) == 2
    assert sum(part.kind == "node" for part in found.scene.parts) == 2
    names = ("u", "first", "C", "second", "R")
    places = [float(_middle(found.scene, name)[0]) for name in names]
    assert places == sorted(places) and places[0] < places[-1]


@pytest.mark.parametrize("sign", [1, -1])
def test_a_source_pushes_along_the_arrow_of_its_charge(sign: int) -> None:
    """Clockwise is upward on the left side: there the two strokes of the plus lie above the one of the minus."""
    system, (q,), (L,) = _circuit(1, letters="L")
    system.inductor(L, q)
    system.voltage_source(system.input("u", unit="V"), sign * q, name="u")
    scene = system.look().scene
    signs = _points([p for p in scene.parts if p.elements == ("u",)][-1])
    middle = _middle(scene, "u")[1]
    above, below = (signs[:, 1] < middle).sum(), (signs[:, 1] > middle).sum()
    assert (4, 2)[::sign] == (above, below)


def test_coils_that_share_flux_face_each_other() -> None:
    system, (q1, q2), (L1, L2, M) = _circuit(2, letters="L1 L2 M")
    system.inductor(L1, q1)
    system.inductor(L2, q2)
    system.mutual_inductance(M, q1, q2)
    found = system.look()
    assert not found.missing
    (a, b), (c, d) = (_outline(found.scene, name) for name in ("L1", "L2"))
    assert b[0] < c[0] and abs((a + b)[1] - (c + d)[1]) < 1 and c[0] - b[0] < 60
    assert {x for label in found.scene.labels for x in label.names} == {"q1", "q2", "L1", "L2", "M"}


def test_a_bridge_has_a_loop_below_two_others() -> None:
    """Maxwell's: three wires meet at its four corners, and the source's loop is below the others."""
    system, (q1, q2, q3), (L1, L2, R3, R4, R5, L0) = _circuit(3, letters="L1 L2 R3 R4 R5 L0")
    system.voltage_source(system.input("u", unit="V"), q3)
    for L, charge in ((L1, q1), (L2, q2), (L0, q3)):
        system.inductor(L, charge)
    for R, charge in ((R3, q1 - q3), (R4, q2 - q3), (R5, q1 - q2)):
        system.resistor(R, charge)
    found = system.look()
    assert not found.missing
    meetings = _meetings(found.scene)
    counts = [what.total() for what in meetings.values()]
    assert set(counts) == {2, 3} and counts.count(3) == 4 == sum(part.kind == "node" for part in found.scene.parts)
    assert all(sum(what[e.name] for what in meetings.values()) == 2 for e in system.model.branches)
    height = {name: float(_middle(found.scene, name)[1]) for name in ("L1", "L2", "R3", "R4", "R5", "L0")}
    assert height["R5"] < height["R3"] == height["R4"] < height["L0"]
    assert max(height["L1"], height["L2"]) < height["R3"]


def test_the_charges_of_circuits_flow_within_their_wires() -> None:
    """In a page dots move along these ways, also beside bodies, to which the circuit gives way."""
    system, (q1, q2), (L, C) = _circuit(2, letters="L C")
    system.inductor(L, q1)
    system.inductor(L, -q2, name="second")
    system.capacitor(C, q1 + q2)
    scene = system.look().scene
    one, two = scene.flows
    assert (one.coordinate, two.coordinate) == ("q1", "q2") and one.sense == -two.sense
    wires = np.concatenate([_points(part) for part in scene.parts if part.kind == "wire"])
    assert (wires.min(axis=0) < (one.box[0], one.box[1])).all() and (wires.max(axis=0) > (two.box[2], two.box[3])).all()
    assert one.box[2] < two.box[0]
    assert all(part.moves for part in scene.parts if part.kind == "wire")
    beside = picture("dc-motor").scene
    assert [flow.coordinate for flow in beside.flows] == ["q"]
    assert {part.kind for part in beside.parts if part.aside} >= {"wire", "resistor"}
    assert not any(part.aside for part in beside.parts if part.kind in ("link", "gravity", "pin"))


def test_loops_that_do_not_lie_in_a_row_are_told() -> None:
    """Four loops of which each meets the three others: K₅ with the outside, which no plane holds."""
    system, qs, (L, R) = _circuit(4, letters="L R")
    for q in qs:
        system.inductor(L, q)
    for a, b in combinations(qs, 2):
        system.resistor(R, a - b)
    found = system.look()
    assert found.missing == (
        "the circuit of charges q1, q2, q3, q4 is not drawn: its loops do not lie in a row, with at most one more "
        "below it, each branch in one loop or between two",
    )
    assert not any(part.kind == "wire" for part in found.scene.parts)


def test_a_charge_that_is_counted_twice_is_told() -> None:
    system, (q,), (L, R) = _circuit(1, letters="L R")
    system.inductor(L, q)
    system.resistor(R, 2 * q)
    (told,) = system.look().missing
    assert told.startswith("the circuit of charge q1 is not drawn")


@pytest.mark.parametrize("sign", [1, -1])
def test_a_charge_that_is_given_has_a_source_of_current(sign: int) -> None:
    """q − I t flows through the resistor between two loops: clockwise, I t goes down on the right."""
    system, (q,), (L, R) = _circuit(1, letters="L R")
    current = system.parameter("I", "1 A")
    system.inductor(L, q)
    system.resistor(R, q - sign * current * system.t)
    found = system.look()
    assert not found.missing and "I" in {x for label in found.scene.labels for x in label.names}
    arrow = next(p for p in found.scene.parts if p.kind == "current_source" and p.solid)
    tip, *base = _points(arrow)
    assert (tip[1] - np.mean(base, axis=0)[1]) * sign > 0
    assert _middle(found.scene, "L")[0] < _middle(found.scene, "R")[0] < tip[0]


def test_a_winding_pulls_what_it_moves_in_the_sense_of_its_constant() -> None:
    for name, kind in (("dc-motor", "torque"), ("loudspeaker", "force")):
        efforts = [p for p in picture(name).scene.parts if p.kind == kind]
        assert {p.elements[0] for p in efforts} == {
            next(e.name for e in built_in.system(name).model.branches if e.kind == "transducer")
        }


def test_what_a_circuit_shows_is_said() -> None:
    assert (
        "Charge q flows through capacitor plates (which changes with x), inductor L, resistor R and voltage source u."
        in (picture("capacitive-actuator").description)
    )
    assert "transducer K turns the arm." in picture("dc-motor").description
    assert "Transducer Bl drives x." in picture("loudspeaker").description
