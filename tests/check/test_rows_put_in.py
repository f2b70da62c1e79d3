"""Constraints on velocities that were put into T* before it was differentiated: this mistake is named first.

The wrong equations are made here by SymPy from T* with the rates put in, as a student makes them; the terms that they
lack are those of the books: Chaplygin's sleigh (Bloch, Nonholonomic Mechanics and Control, 2nd ed. 2015, section 1.7)
and the corrections of Chaplygin and Hamel.
"""

from functools import cache

import pytest
import sympy as sp

import lagrangian as lg
from lagrangian.check import Status
from lagrangian.model import time
from lagrangian.page.plain import plain

NAME = "constraint_put_in_too_early"


@cache
def derived(name: str) -> lg.Derivation:
    """A built-in example."""
    return lg.example(name).derive()


def put_in(name: str, rates: dict[str, str], free: str) -> str:
    """Lagrange's equations of the coordinates ``free``, of T* with ``rates`` put in: what a student writes down."""
    d = derived(name)
    model, t = d.model, time
    letters = {x.name: x.symbol for x in (*model.coordinates, *model.parameters)}
    letters |= {f"d{c.name}": c.rate for c in model.coordinates}
    table = {letters[f"d{q}"]: sp.sympify(text, letters) for q, text in rates.items()}
    T = model.expand(d.T, constants=True).xreplace(table)
    V = model.expand(d.V, constants=True)
    rows = []
    for q in (letters[name] for name in free.split()):
        left = T.diff(q.diff(t)).diff(t) - T.diff(q) + V.diff(q)
        rows.append(f"{plain(sp.expand(left))} = {plain(sp.expand(d.Xi[q]))}")
    return "\n".join(rows)


ALONG = "m*v' = 0\n(J + m*a^2)*theta'' = 0"
KEPT = "m*x'' = -lambda*sin(theta)\nm*y'' = lambda*cos(theta)\n(J + m*a^2)*theta'' = 0"
BY_X = (
    "m*x''/cos(theta)^2 + 2*m*x'*theta'*sin(theta)/cos(theta)^3 = 0\n"
    "(J + m*a^2)*theta'' - m*x'^2*sin(theta)/cos(theta)^3 = 0"
)
ENERGIES = {
    ALONG: "T = 1/2*m*v^2 + 1/2*(J + m*a^2)*theta'^2\n",
    KEPT: "T = 1/2*m*(x'^2 + y'^2) + 1/2*(J + m*a^2)*theta'^2\n",
    BY_X: "T = 1/2*m*x'^2/cos(theta)^2 + 1/2*(J + m*a^2)*theta'^2\n",
}


@pytest.mark.parametrize(
    ("equations", "lost"),
    [
        (ALONG, ("a*m*v*theta' in the equation of theta", "-a*m*theta'^2 in the equation of v")),
        (KEPT, ("-a*m*cos(theta)*theta'^2 in the equation of x", "a*m*(sin(theta)*y' + cos(theta)*x')*theta' in")),
        pytest.param(
            BY_X,
            ("-a*m*theta'^2/cos(theta) - m*tan(theta)*theta'*x'/cos(theta)^2 in the equation of x",),
            marks=pytest.mark.slow,
        ),
    ],
)
def test_the_edge_of_a_sleigh_put_into_its_energy(equations: str, lost: tuple[str, ...]) -> None:
    """With v the terms −m a θ̇² and m a v θ̇ are lost: without them the sleigh would not turn into its course."""
    for energy in ("", ENERGIES[equations]):
        verdict = derived("chaplygin-sleigh").check(energy + equations)
        assert verdict.status is Status.WRONG and verdict.sure
        assert verdict.mistake is not None and verdict.mistake.name == NAME
        assert verdict.mistake.element == "velocity constraint 'knife edge'"
        assert all(words in str(verdict.mistake.what) for words in lost), str(verdict.mistake.what)
        assert [f.follows for f in verdict.findings if f.line.kind == "equation"].count(bool(energy)) == len(
            equations.splitlines()
        )


@pytest.mark.sampled(4)
@pytest.mark.parametrize("energy", ENERGIES.values())
def test_an_energy_on_the_constraint_is_right_beside_right_equations(energy: str) -> None:
    """Its value is that of T*, and the equations cannot have been derived from it."""
    right = "m*v' - m*a*theta'^2 = 0\n(J + m*a^2)*theta'' + m*a*v*theta' = 0"
    verdict = derived("chaplygin-sleigh").check(energy + right)
    assert verdict.right and "its value is right" in str(verdict.findings[0].note)
    assert not derived("chaplygin-sleigh").check(energy.replace("+ m*a^2", "+ 2*m*a^2") + right, hint=0).right


ON_BELT = """
name = "roller on a belt"
[coordinates]
x = {}
phi = {}
[parameters]
M = "4 kg"
J = "0.1 kg*m^2"
R = "0.2 m"
k = "60 N/m"
a0 = "1.5 m/s^2"
g = "9.81 m/s^2"
[points]
axle = ["x", "R"]
[[frame]]
name = "roller"
angle = "-phi"
[[rigid_body]]
mass = "M"
inertia = "J"
at = "axle"
frame = "roller"
[[gravity]]
direction = [0, -1]
[[spring]]
k = "k"
deflection = "x"
[[velocity_constraint]]
name = "belt"
expression = "x' - R*phi' - a0*t"
"""


@pytest.mark.slow
def test_a_lagrangian_on_the_constraint_may_have_another_level_of_height() -> None:
    belt = lg.loads(ON_BELT).derive()
    energy = "L = M x'^2/2 + J (x' - a0 t)^2/(2 R^2) - k x^2/2\n"
    right = energy + "(M + J/R^2) x'' + k x - J a0/R^2 = 0\nphi' = (x' - a0 t)/R"
    assert belt.check(right, hint=0).right
    assert not belt.check(right.replace("(x' - a0 t)^2", "(x' + a0 t)^2"), hint=0).right
    assert not belt.check(right.replace("/(2 R^2)", "/R^2"), hint=0).right
    assert not belt.check(right.replace("- k x^2/2", "- k x^2"), hint=0).right


@pytest.mark.sampled(2)
@pytest.mark.parametrize("right_side", ["= lambda", "- lambda = 0"])
def test_terms_are_told_with_the_signs_of_the_side_on_which_all_others_stand(right_side: str) -> None:
    """Also where the other side is the multiplier alone."""
    rest = "\nJ phi'' = -R lambda\nx' - R phi' = a0 t"
    belt = lg.loads(ON_BELT).derive()
    assert belt.check(f"M x'' + k x {right_side}{rest}", hint=0).right
    lacking, more = (belt.check(f"{left} {right_side}{rest}") for left in ("M x''", "M x'' + k x + k R"))
    assert [str(d.term) for f in lacking.findings for d in f.differences] == ["k*x(t)"]
    assert "is taken as R + x; it is x" in str(more.mistakes[0].what)


@pytest.mark.slow
def test_rolling_put_into_the_energy_of_a_disc() -> None:
    """The right equations have 2 m r² where the wrong ones have m r² (Neimark and Fufaev, 1972, chapter III)."""
    rates = {"x": "r*dphi*cos(psi)", "y": "r*dphi*sin(psi)"}
    verdict = derived("rolling-disc").check(put_in("rolling-disc", rates, "psi theta phi"))
    assert verdict.mistake is not None and verdict.mistake.name == NAME and verdict.mistake.element == "rolling 'floor'"
    said = str(verdict.mistake.what)
    assert "-m*r^2*cos(theta)*phi'*theta' in the equation of psi" in said.replace("theta'*phi'", "phi'*theta'")
    assert "m*r^2*cos(theta)*psi'*theta' in the equation of phi" in said


@pytest.mark.slow
def test_the_axles_of_a_car_put_into_its_energy() -> None:
    """Of the speeds v, θ′, δ′ the first alone drives; without its square the car would not mind that it turns."""
    rates = {"y": "dx*tan(theta)", "theta": "dx*tan(delta)/(l*cos(theta))"}
    verdict = derived("car").check(put_in("car", rates, "x delta"))
    assert verdict.mistake is not None and verdict.mistake.name == NAME
    assert verdict.mistake.element is None and "constraints on velocities were put into T*" in str(verdict.mistake.what)


@pytest.mark.slow
def test_what_can_be_integrated_may_be_put_in() -> None:
    """x′ = r φ′ keeps x − r φ: T* with it put in gives the right equation, and a mistake in that is another one."""
    right = put_in("wheel-on-incline", {"x": "r*dphi"}, "phi").replace(" = 0", " = m*g*r*sin(beta)")
    assert derived("wheel-on-incline").check(right, hint=0).right
    for wrong in (
        right.replace("m*g*r", "m*g"),
        right.replace("J*phi''", "J*phi''/2"),
        right.partition(" = ")[0] + " = 0",
    ):
        verdict = derived("wheel-on-incline").check(wrong)
        assert not verdict.right and NAME not in [m.name for m in (*verdict.mistakes, *verdict.alternatives)]


@pytest.mark.slow
def test_other_mistakes_keep_their_names() -> None:
    """A wrong inertia, and a wrong energy that does not hold on the constraint either."""
    right = "m*v' - m*a*theta'^2 = 0\n(J + m*a^2)*theta'' + m*a*v*theta' = 0"
    for wrong in (right.replace("J + m*a^2", "J"), right.replace("- m*a", "+ m*a"), f"T = m*v^2\n{ALONG}"):
        verdict = derived("chaplygin-sleigh").check(wrong)
        assert not verdict.right and NAME not in [m.name for m in verdict.mistakes]


@pytest.mark.slow
def test_an_upright_disc_may_be_put_in() -> None:
    """Without its lean, nothing is lost: (K + m r²) φ″ = 0 and I ψ″ = 0 are right."""
    s = lg.System("upright disc")
    x, y, psi, phi = s.coordinates("x y psi phi")
    m, r, I, K = s.parameters("m r I K")
    s.generalized_force(phi, s.inputs("tau"))
    s.particle(m, s.point("C", (x, y)))
    s.kinetic(I * psi.diff() ** 2 / 2 + K * phi.diff() ** 2 / 2)
    s.velocity_constraint(x.diff() - r * phi.diff() * sp.cos(psi), name="along x")
    s.velocity_constraint(y.diff() - r * phi.diff() * sp.sin(psi), name="along y")
    d = s.derive()
    assert not d.notices
    energy = "T = (K + m*r^2)*phi'^2/2 + I*psi'^2/2\n"
    assert d.check(f"{energy}(K + m*r^2)*phi'' = tau\nI*psi'' = 0", hint=0).right
    wrong = d.check("K*phi'' = tau\nI*psi'' = 0")
    assert not wrong.right and NAME not in [m.name for m in wrong.mistakes]


def test_an_energy_that_may_contain_a_constraint_gets_a_notice() -> None:
    """T* of the disc with the rolling put in has no x′ and no y′, and its equations are wrong."""
    s = lg.System("disc by hand")
    x, y, psi, phi = s.coordinates("x y psi phi")
    m, r, I, K = s.parameters("m r I K")
    s.kinetic(I * psi.diff() ** 2 / 2 + (K + m * r**2) * phi.diff() ** 2 / 2)
    s.velocity_constraint(x.diff() - r * phi.diff() * sp.cos(psi), name="along x")
    s.velocity_constraint(y.diff() - r * phi.diff(), name="straight")
    (notice,) = s.derive().notices
    assert notice.code == "E312" and notice.where == "constraint 'along x'" and "without x'" in str(notice)
