"""Inertias that fit no body: the mass matrix decides whether they are noted or refused, however they are given."""

import json

import numpy as np
import pytest
import sympy as sp
from typer.testing import CliRunner

import lagrangian as lg
from lagrangian import ModelError
from lagrangian.cli.app import app

FILE = """
name = "plate"
[coordinates]
a = ""
b = ""
[parameters]
C = {value = "%s kg*m^2"}
[points]
P = ["b", "0", "0"]
[[frame]]
name = "turned"
angle = "a"
axis = [0, 0, 1]
[[rigid_body]]
name = "plate"
mass = "1"
inertia = ["1", "1", "C"]
at = "P"
frame = "turned"
"""


def link(J: float) -> lg.System:
    """A rod of mass 1 kg whose centre is 1 m from the pivot: M = 1 + J."""
    s = lg.System("link")
    theta = s.coordinates("theta")
    m, L, inertia = s.parameters("m L J", m=1, L=1, J=J)
    s.rigid_body(m, inertia, at=s.origin + (L * sp.sin(theta), -L * sp.cos(theta)), frame=theta, name="rod")
    s.generalized_force(theta, s.input("tau"))
    return s


@pytest.fixture(scope="module")
def plate() -> lg.System:
    return lg.loads(FILE % "5")


def test_a_broken_triangle_is_noted_wherever_the_system_is_shown(plate: lg.System) -> None:
    (notice,) = plate.notices
    assert notice.code == "E105"
    assert notice.where == "rigid body 'plate' (line 14)"
    assert "1 + 1 ≥ 5" in notice.text
    d = plate.derive()
    brief = d.to_text(brief=True)
    for shown in (repr(plate), brief, d.to_text(), d.to_markdown(), d.to_latex(), d.to_html(), d._repr_html_()):
        assert "rigid body 'plate'" in shown.replace("&#x27;", "'")
        assert "violate 1 + 1" in " ".join(shown.split()).replace("\\+", "+")
    assert d.to_dict()["notices"] == [{"code": "E105", "where": notice.where, "text": notice.text}]


@pytest.mark.slow
def test_the_command_shows_it_too(plate: lg.System, tmp_path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "plate.toml"
    path.write_text(FILE % "5", encoding="utf-8")
    answer = CliRunner().invoke(app, ["verify", str(path), "--states", "2"])
    assert answer.exit_code == 0
    assert "violate 1 + 1 ≥ 5" in " ".join(answer.output.split())


@pytest.mark.slow
def test_a_floating_body_shows_it_in_verify(tmp_path) -> None:  # type: ignore[no-untyped-def]
    path = tmp_path / "hull.toml"
    s = lg.System("hull")
    hull = s.floating_frame("hull")
    s.rigid_body(1, (1, 1, 3), at=hull.origin, frame=hull, name="hull body")
    s.save(path)
    answer = CliRunner().invoke(app, ["verify", str(path), "--states", "2"])
    assert answer.exit_code == 0
    assert "violate 1 + 1 ≥ 3" in " ".join(answer.output.split())


def test_bodies_that_there_are_have_no_notice() -> None:
    assert link(1 / 12).notices == ()
    assert "notice" not in repr(link(1 / 12))


def test_a_negative_inertia_is_noted_where_the_mass_matrix_stays_positive() -> None:
    s = link(-0.1)  # M = 0.9
    assert [n.code for n in s.notices] == ["E106"]
    assert s.compile().mass_matrix([0.3]) == pytest.approx(0.9)


def test_and_refused_where_it_does_not_with_the_entry_that_matters() -> None:
    with pytest.raises(ModelError, match=r"rod.*indefinite.*along theta is -0.5.*J = -1.5") as trouble:
        link(-1.5).derive()  # M = −0.5
    assert trouble.value.code == "E106"
    with pytest.raises(ModelError, match="Izz = -2"):
        lg.loads(FILE % "-2").derive()


def test_values_that_come_with_a_call_are_held_to_the_same_rule() -> None:
    s = link(0.1)
    dyn = s.compile()
    assert dyn.forward([0.3], [0.0], p={"J": -0.5}) == pytest.approx(0.0)
    for p in ({"J": -1.5}, [1, 1, -1.5], np.array([[1, 1, 1.0], [1, 1, -1.5]]), np.tile([1, 1, -1.5], (9, 1))):
        with pytest.raises(ModelError, match=r"J = -1\.5"):
            dyn.forward([0.3], [0.0], p=p)
        with pytest.raises(ModelError, match=r"J = -1\.5"):
            dyn.rhs(0.0, [0.3, 0.0], p=p)
    with pytest.raises(ModelError, match="negative"):
        dyn.forward([0.3], [0.0], p={"m": -1.0})
    with pytest.raises(ModelError, match=r"J = -1\.5"):
        s.simulate(1.0, params={"J": -1.5})
    run = s.simulate(1.0, params={"J": -0.5}, theta=1.0, samples=3)
    assert [n.code for n in run.notices] == ["E106"]
    assert "rod" in repr(run)
    assert s.simulate(1.0, theta=1.0, samples=3).notices == ()


def test_runs_of_a_sweep_are_held_to_it() -> None:
    runs = link(0.1).sweep(1.0, {"J": [-2, -1.5, -0.5, 0.0, 1.0, 2.0]}, theta=1.0)
    assert list(runs.status) == [-7, -7, 0, 0, 0, 0]


def test_parameters_without_values_leave_the_matter_open() -> None:
    s = lg.System("open")
    theta = s.coordinates("theta")
    m, L = s.parameters("m L")
    s.rigid_body(m, -1, at=s.origin + (L * sp.sin(theta), -L * sp.cos(theta)), frame=theta, name="rod")
    assert s.notices[0].code == "E106"  # m L² may be above 1
    with pytest.raises(ModelError, match="indefinite"):
        s.simulate(1.0, params={"m": 1, "L": 0.5})


def test_it_is_plain_data(plate: lg.System) -> None:
    assert json.loads(json.dumps(plate.derive().to_dict()))["notices"][0]["code"] == "E105"


INERTIAS = {
    "diagonal": lambda J: [J, 2 * J, 3 * J],
    "full": lambda J: [[2 * J, J / 2, 0.1], [J / 2, 3 * J, 0.2], [0.1, 0.2, J]],
    "rod": lambda J: [0, J, J],
}


@pytest.mark.sampled(8)
@pytest.mark.parametrize("inertia", INERTIAS.values(), ids=INERTIAS)
@pytest.mark.parametrize("value", [2.0, 1e-3, -0.4, -50.0])
def test_many_calls_with_new_values_are_held_to_it_too(inertia, value: float) -> None:
    """After a few sets that were looked at closely, numbers tell what is beyond doubt, with the same verdict."""
    s = lg.System("top")
    a, b = s.coordinates("a b")
    m, J = s.parameters("m J", m=1.0, J=1.0)
    outer = s.frame(a, axis=(0, 0, 1))
    frame = s.frame(b, axis=(0, 1, 0), parent=outer)
    s.rigid_body(m, inertia(J), at=s.origin + (sp.cos(a), sp.sin(a), 0), frame=frame, name="rod")
    fresh, used = s.compile(), s.compile()
    for k in range(10):
        used.forward([0.3, 0.2], [0.0, 1.0], p=[1.0, 1 + 0.1 * k])
    given = {"p": np.array([1.0, value])}
    try:
        wanted = fresh.forward([0.3, 0.2], [0.0, 1.0], **given)
    except ModelError as refused:
        with pytest.raises(ModelError, match=str(refused.code)):
            used.forward([0.3, 0.2], [0.0, 1.0], **given)
    else:
        np.testing.assert_array_equal(used.forward([0.3, 0.2], [0.0, 1.0], **given), wanted)
    for q in ([0.3, 0.2], np.tile([0.3, 0.2], (9, 1))):
        for p in ([-1.0, 1.0], np.array([-1.0, 1.0]), np.array([[1.0, 1.0]] * 8 + [[-1.0, 1.0]])):
            with pytest.raises(ModelError, match="negative"):
                used.forward(q, [0.0, 1.0], p=p)
