"""What docs/circuits.md says runs as it stands there, and is so."""

import math
from typing import Any

import pytest

import lagrangian as lg
from test_docs import blocks


@pytest.mark.slow
def test_the_guide_to_circuits_runs() -> None:
    names: dict[str, Any] = {}
    code = "\n".join(blocks("docs/circuits.md", "python"))
    exec(compile(code, "docs/circuits.md", "exec"), names)
    rest = names["rest"]
    assert (rest["q'"], rest["theta"]) == (pytest.approx(0.83333, rel=1e-4), pytest.approx(0.6907, rel=1e-3))
    assert rest.stability.verdict == "asymptotically stable"
    motor, magnet, texts = names["motor"], names["magnet"], blocks("docs/circuits.md", "text")
    for line in texts[0].splitlines():
        assert line in motor.to_text()
    for line in texts[1].splitlines():
        assert line in magnet.to_text()
    assert len(names["frequencies"]) == 2
    low, high = names["frequencies"]
    inverse = [[12e-6, -4e-6], [-4e-6, 24e-6]]
    determinant = 24e-6 * 12e-6 - 16e-12
    trace = inverse[0][0] / determinant / 100e-9 + inverse[1][1] / determinant / 200e-9
    assert low**2 + high**2 == pytest.approx(trace) and low * high == pytest.approx(
        math.sqrt(1 / determinant / (100e-9 * 200e-9))
    )
    assert float(names["fall"].audit) < 1e-8
    assert [e.stability.verdict for e in names["below"]] == ["asymptotically stable", "unstable"]
    assert len(names["above"]) == 0
    with pytest.raises(lg.Error, match="E523"):
        names["v"].hamiltonian()


@pytest.mark.slow
def test_ways_out_of_a_charge_without_a_coil() -> None:
    """q = C u eliminated: V = −½ C(x) u² has the equilibria of the charge's equation; q − I t prescribes a current."""
    s = lg.System("plates")
    x, u = s.coordinate("x"), s.input("u")
    s.particle(1, s.point("P", (x, 0)))
    s.spring(1, deflection=x)
    s.potential(-(u**2) / (2 * (1 - x)))
    limit = math.sqrt(8 / 27)
    assert len(s.equilibria(inputs={"u": 0.99 * limit}, box={"x": (0, 0.9)})) == 2
    assert len(s.equilibria(inputs={"u": 1.01 * limit}, box={"x": (0, 0.9)})) == 0
    t = lg.System("current")
    q = t.coordinate("q")
    t.inductor(1, q)
    t.resistor(2, q)
    t.resistor(3, q - 5 * t.t)
    run = t.simulate(10)
    assert run["q'"][-1] == pytest.approx(3 * 5 / (2 + 3), rel=1e-6)
