"""States of functions that return their rates: what a comment or an index says of them, and in which order they are.

Oracle: the equations of the cart with a pole. Every form has a wrong twin.
"""

import pytest

from built_in import derivation
from lagrangian import ParseError

BY_INDEX = """function dz = rhs({arguments})
% z = [x; theta; xdot; thetadot], F = force
A = [M + m, m*l*cos(z(2)); m*l*cos(z(2)), J + m*l^2];
f = [F - b*z(3) + m*l*sin(z(2))*z(4)^2; m*g*l*sin(z(2))];
qdd = A\\f;
dz = [z(3); z(4); qdd(1); qdd(2)];
end
"""
NAMED = """function dz = rhs(t, z)
{states}
A = [M + m, m*l*cos({a}); m*l*cos({a}), J + m*l^2];
h = [F - b*v + m*l*sin({a})*w^2; m*g*l*sin({a})];
acc = A\\h;
dz = [v; w; acc];
end
"""
ANGLE_FIRST = """function dz = rhs(t, z)
{states}
A = [J + m*l^2, m*l*cos(theta); m*l*cos(theta), M + m];
h = [m*g*l*sin(theta); F - b*v + m*l*sin(theta)*w^2];
a = A\\h;
dz = [w; v; a];
end
"""


@pytest.mark.sampled(6)
@pytest.mark.parametrize("arguments", ["~, z, F", "t, z, F", "tt, z", "z", "time, z, par"])
def test_the_state_is_the_argument_with_an_index(arguments: str) -> None:
    written = BY_INDEX.format(arguments=arguments)
    assert derivation("cart-pole").check(written, hint=0).right
    for old, new in (
        ("- b*z(3)", "- b*z(4)"),
        ("; m*g*l*sin(z(2))", "; m*g*l*sin(z(1))"),
        ("qdd(1); qdd(2)", "qdd(2); qdd(1)"),
    ):
        assert old in written
        assert not derivation("cart-pole").check(written.replace(old, new), hint=0).right


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("states", "a"),
    [
        ("x = z(1); th = z(2); v = z(3); w = z(4);", "th"),
        ("p = z(1); a = z(2); v = z(3); w = z(4);  % z = [x; theta; x'; theta']", "a"),
        ("% z = [x; theta; x'; theta']\np = z(1); a = z(2); v = z(3); w = z(4);", "a"),
        ("p = z(1); a = z(2); v = z(3); w = z(4);  % position, angle and their rates", "a"),
    ],
    ids=["shortened", "comment behind", "comment above", "nothing said"],
)
def test_states_have_names_of_their_own(states: str, a: str) -> None:
    written = NAMED.format(states=states, a=a)
    assert derivation("cart-pole").check(written, hint=0).right
    for old, new in (("dz = [v; w", "dz = [w; v"), ("F - b*v", "F + b*v"), ("J + m*l^2]", "J + 2*m*l^2]")):
        assert old in written
        assert not right(written.replace(old, new))


def test_accelerations_have_the_order_of_the_states() -> None:
    for name in ("theta", "th"):
        states = f"{name} = z(1); x = z(2); w = z(3); v = z(4);"
        written = ANGLE_FIRST.format(states=states).replace("(theta)", f"({name})")
        assert derivation("cart-pole").check(written, hint=0).right
        rows = written.replace("[J + m*l^2, m*l*cos", "[M + m, m*l*cos").replace(", M + m]", ", J + m*l^2]")
        first, _, second = rows.partition("h = [")[2].partition("];")[0].partition("; ")
        assert not right(rows.replace(f"{first}; {second}", f"{second}; {first}"))


def test_a_comment_that_names_a_rate_in_words_says_nothing_of_the_coordinate() -> None:
    written = """function dz = rhs(t, z)
% states: z(1) = theta, z(2) = theta dot
th = z(1); thd = z(2);
thdd = -g/L*sin(th) - b/(m*L^2)*thd;
dz = [thd; thdd];
end
"""
    assert derivation("pendulum").check(written, hint=0).right
    assert derivation("pendulum").check(written.replace("thd ", "w ").replace("thd;", "w;"), hint=0).right
    assert not derivation("pendulum").check(written.replace("*thd;", "*th;"), hint=0).right


def test_rows_of_matlab_end_with_their_lines() -> None:
    written = """function dz = rhs(t, z)
% z = [x theta dx dtheta]
A = [M + m, m*l*cos(z(2))   % first row
     m*l*cos(z(2)), J + m*l^2];
h = [F - b*z(3) + ...
     m*l*sin(z(2))*z(4)^2
     m*g*l*sin(z(2))];
dz = [z(3)
      z(4)
      A\\h];
end
"""
    assert right(written)
    assert not right(written.replace("     m*g*l", "     -m*g*l*cos(z(2))"))
    assert not right(written.replace("[z(3)\n      z(4)", "[z(4)\n      z(3)"))


@pytest.mark.slow
def test_functions_of_matlab_may_have_no_body() -> None:
    written = """A = @(z) [M + m, m*l*cos(z(2)); m*l*cos(z(2)), J + m*l^2];
h = @(z) [F - b*z(3) + m*l*sin(z(2))*z(4)^2; m*g*l*sin(z(2))];
rhs = @(~, z) [z(3); z(4); A(z)\\h(z)];
[t, z] = ode45(rhs, [0 10], [0; 0.1; 0; 0]);
"""
    assert right(written)
    assert not right(written.replace("m*g*l", "m*g*l*z(2)"))
    assert not right(written.replace("[z(3); z(4); A", "[z(4); z(3); A"))
    acceleration = "f = @(t, z) [z(2); -g/L*sin(z(1)) - b/(m*L^2)*z(2)];"
    assert derivation("pendulum").check(acceleration, hint=0).right
    assert not derivation("pendulum").check(acceleration.replace("-g", "g"), hint=0).right


def right(written: str) -> bool:
    """Whether an answer is right; one that is refused is not."""
    try:
        return derivation("cart-pole").check(written, hint=0).right
    except ParseError:
        return False


@pytest.mark.slow
def test_a_wrong_program_is_told_by_what_it_computes_where_its_states_are_misread() -> None:
    program = """function zd = sled(t, z, p)
% z = [x theta xdot thetadot]
x = z(1); th = z(2); xd = z(3); thd = z(4);
D = (p.M + p.m)*(p.J + p.m*p.l^2) - p.m^2*p.l^2*cos(th)^2;
r1 = p.F - p.b*xd + p.m*p.l*thd^2*sin(th);
r2 = p.m*p.g*p.l*sin(th);
xdd = ((p.J + p.m*p.l^2)*r1 - p.m*p.l*cos(th)*r2)/D;
thdd = ((p.M + p.m)*r2 - p.m*p.l*cos(th)*r1)/D;
zd = [xd; thd; xdd; thdd];
end"""
    cart = derivation("cart-pole")
    assert cart.check(program, hint=0).right
    found = cart.check(program.replace("(p.M + p.m)*r2", "p.M*r2"))
    assert [f.line.number for f in found.findings if not f.status.right] == [8]
    assert not found.right and "z(" not in str(found)


DRIVEN = """function dz = f(t, z, p)
% z = [theta; thetadot]
th = z(1); w = z(2);
y = p.a*cos(p.omega*t);
dy = -p.a*p.omega*sin(p.omega*t);
ddy = -p.a*p.omega^2*cos(p.omega*t);
dz = [w; (p.m*p.L*(p.g + ddy)*sin(th) - p.b*w)/(p.m*p.L^2)];
end"""


def test_a_wrong_rate_of_a_prescribed_motion_in_a_program_is_told_by_its_line() -> None:
    pendulum = derivation("kapitza-pendulum")
    found = pendulum.check(DRIVEN)
    assert found.right and len(found.findings) == 1
    assert pendulum.check(DRIVEN.replace("ddy = -p.a", "ddy = p.a*(-1)"), hint=0).right
    wrong = pendulum.check(DRIVEN.replace("ddy = -p.a", "ddy = p.a"))
    assert not wrong.right
    assert [f.line.number for f in wrong.findings if not f.status.right] == [6, 7]
    other = pendulum.check(DRIVEN.replace("p.g + ddy", "p.g - ddy"))
    assert not other.right and len(other.findings) == 1


OPEN = """rho = l*cos(theta);
D = m*rho;
A = [M + m, D;
     D, J + m*l^2];
f = [F - b*xd + m*l*sin(theta)*thetad^2;
     m*g*l*sin(theta)];
qdd = A\\f;
"""
BY_PARTS = """% rod as a constraint, unknowns x'', y'', lambda
Mass = [m, 0; 0, m];
Q = [0; -m*g];
A = [x, y];
gam = xd^2 + yd^2;
sol = [Mass, -A'; A, 0] \\ [Q; -gam];
xdd = sol(1); ydd = sol(2); lambda = sol(3);
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "program", "changes"),
    [
        ("cart-pole", OPEN, [("D = m", "D = 2*m"), ("m, D;", "m, -D;")]),
        ("rod-pendulum", BY_PARTS, [("[0; -m*g]", "[0; m*g]"), ("; -gam", "; gam"), ("[m, 0;", "[2*m, 0;")]),
    ],
    ids=["an energy's letter in a matrix", "a solution whose parts have names"],
)
def test_what_is_solved_in_the_open_is_judged(name: str, program: str, changes: list[tuple[str, str]]) -> None:
    assert derivation(name).check(program).right
    for old, new in changes:
        assert old in program
        assert not derivation(name).check(program.replace(old, new), hint=0).right
