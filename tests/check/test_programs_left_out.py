"""What a program does that is not carried out, and could change what is judged, is not left out in silence.

Oracle: the equation of the pendulum. Every program has a twin that is right, or wrong, by the same form.
"""

from __future__ import annotations

import pytest

from built_in import derivation
from lagrangian import ParseError

RHS = """def rhs(t, z):
    theta, omega = z
    return [omega, -g/L*np.sin(theta) - b/(m*L**2)*omega]
"""
JULIA = """function f!(du, u, p, t)
    theta, omega = u
    du[1] = omega
    du[2] = -g/L*sin(theta) - b/(m*L^2)*omega
end
"""


def right(text: str, example: str = "pendulum") -> bool:
    """Whether a program is accepted; one that cannot be read is not."""
    try:
        return derivation(example).check(text, hint=0).right
    except ParseError:
        return False


@pytest.mark.sampled(4)
@pytest.mark.parametrize("head", ["if True", "while on", "for k in range(1000)", "try"])
def test_a_function_in_a_branch_ends_for_itself(head: str) -> None:
    behind = "except Exception:\n    pass\n" if head == "try" else ""
    assert right(f"{RHS}{head}:\n    def f(x):\n        return x\n{behind}")
    assert not right(f"{RHS}{head}:\n    def rhs(t, z):\n        return [z[1], g*z[0]]\n{behind}")
    assert not right(f"{RHS}{head}:\n    return\n{behind}")


@pytest.mark.parametrize("line", ["s = s + s", "s = [*s, *s]", "s.extend(s)", 's = f"{s}{s}"'])
def test_lists_and_texts_grow_within_bounds(line: str) -> None:
    start = '"ab"' if "f" in line else "[1, 2]"
    assert right(f"{RHS}s = {start}\nfor k in range(60):\n    {line}\n")


def test_two_strokes_in_julia_divide() -> None:
    assert right(JULIA.replace("b/(m", "b//(m"))
    assert not right(JULIA.replace("b/(m", "b//(2*m"))
    assert not right(JULIA.replace("*omega\n", "*omega // 2\n"))


def placed(head: str, inside: str) -> str:
    """The program with lines in front, and in its function."""
    lines = "".join(f"    {x}\n" for x in inside.split("\n") if x)
    return head + RHS.replace("    return", f"{lines}    return")


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("head", "inside", "good"),
    [
        ("", "q = {}\ng = q if on else q", ("2*g", "9.81")),
        ("q = {}\ng = q if on else q\n", "", ("2*g", "9.81")),
        ("def h():\n    return {}\ng = h() if on else h()\n", "", ("2*g", "9.81")),
        ("", "if True: g = {}", ("L + m", "1.62")),
        ("q = 2*g\nif True:\n    r = q\n    g = {}\n", "", ("r", "1.62")),
        ("for k in range(1000): b = {}\n", "", ("L*k", "0.5")),
        ("g = load({})\n", "", ("2*g", "'g'")),
        ("p = load({})\ng = p.g\n", "", ("2*g", "'g'")),
        ("g = load(g={}).h\n", "", ("2*g", "1.62")),
        ("p = load()\np.g = {}\ng = p.g\n", "", ("2*g", "1.62")),
        ("class P:\n    g = {}\ng = P.g\n", "", ("2*g", "9.81")),
        ("class P:\n    q = {}\ng = P.q\n", "", ("2*g", "9.81")),
        ("class P:\n    def __init__(self, g):\n        self.g = {}\np = P(9.81)\ng = p.g\n", "", ("2*g", "g")),
    ],
)
def test_what_is_not_known_is_no_given_value_if_the_system_is_in_it(
    head: str, inside: str, good: tuple[str, str]
) -> None:
    bad, given = good
    assert not right(placed(head.replace("{}", bad), inside.replace("{}", bad)))
    if "h\n" not in head[-2:]:
        assert right(placed(head.replace("{}", given), inside.replace("{}", given)))


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("line", "bad", "good"),
    [
        ("if z(1) > 1, b = {}; end", "5*L", "5"),
        ("switch q\n  case 1\n    b = {};\n  end", "5*L", "5"),
        ("[g, w] = deal({}, q{1});", "2*g", "9.81"),
        ("g = q{1}{};", "*g", ""),
        ("a = {2*g}; g = {}{1};", "a", "q"),
        ("g = {}{1};", "z", "q"),
    ],
)
def test_statements_of_matlab_that_cannot_be_read_hold_the_system(line: str, bad: str, good: str) -> None:
    program = "function dz = f(t, z)\n  @\n  dz = [z(2); -g/L*sin(z(1)) - b/(m*L^2)*z(2)];\nend\n"
    assert right(program.replace("@", line.replace("{}", good)))
    assert not right(program.replace("@", line.replace("{}", bad)))


CHANGED = """def double(x):
    x[1] = 2*x[1]
def rhs(t, z):
    theta, omega = z
    r = [omega, -g/L*np.sin(theta) - b/(m*L**2)*omega]
    @
    return r
"""


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "line",
    [
        "r.reverse()",
        "r.__setitem__(1, 2*g)",
        "r.sort()",
        "r.remove(omega)",
        "w = r.pop()",
        "np.copyto(r, 2*r)",
        "np.multiply(r, 2, out=r)",
        "change(r)",
        "w = change(r)",
        "double(r)",
        "(r := [1, 2])",
        "del r[1]",
        "w = r\n    w[1] = 2*g",
        "w = r\n    w.reverse()",
    ],
)
def test_a_call_that_may_change_a_list_is_not_left_out(line: str) -> None:
    assert not right(CHANGED.replace("@", line))


@pytest.mark.parametrize(
    "line", ["print(r)", "w = r.copy()\n    w[1] = 2*g", "plt.plot(t, r)", "w = len(r)", "np.max(r)"]
)
def test_a_call_that_leaves_a_list_as_it_is_does_no_harm(line: str) -> None:
    assert right(CHANGED.replace("@", line))


def test_a_table_that_is_changed_and_a_function_that_is_imported_are_not_known() -> None:
    head = "p = dict(g=9.81, L=1.0)\n@\n"
    program = placed(head, "g, L = p['g'], p['L']")
    assert right(program.replace("@", "print(p)"))
    assert not right(program.replace("@", "p.update(g=2*p['g'])"))
    assert not right(program.replace("@", "change(p)"))
    acc = "def acc(theta, omega):\n    return -g/L*np.sin(theta) - b/(m*L**2)*omega\n"
    assert right(f"from lib import acc\n{acc}")
    assert not right(f"{acc}from lib import acc\n")


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "wrong", ["2*{} if on else 1", "q[1:3:4]*{}", "weird({})", "np.clip(2*{}, -1, 1)", "{} @ {}", "load()*{}"]
)
def test_what_an_unread_function_makes_of_another_is_not_known(wrong: str) -> None:
    acc = "def acc(theta, omega):\n    return -g/L*np.sin(theta) - b/(m*L**2)*omega\n"
    outer = f"{acc}def rhs(t, z):\n    return [z[1], @]\n"
    assert right(outer.replace("@", "acc(z[0], z[1])"))
    assert not right(outer.replace("@", wrong.replace("{}", "acc(z[0], z[1])")))
    assert not right(f"{acc}def model(t, z):\n    a = acc(z[0], z[1])\n    return weird(2*a)\n")
    assert right(f"{acc}def simulate(z):\n    return weird(acc(z[0], z[1]))\n")
    assert right(f"{acc}def draw(z):\n    plt.plot(acc(z[0], z[1]))\n")


def test_rates_that_a_comment_lists_in_another_order_than_their_places_are_not_read() -> None:
    program = """A = [0 0 1 0; 0 0 0 1; -k_s/m_s, k_s/m_s, -b_s/m_s, b_s/m_s; ...
    k_s/m_u, -(k_s+k_t)/m_u, b_s/m_u, -b_s/m_u];
B = [0 0; 0 0; 0 1/m_s; k_t/m_u -1/m_u];
% x = [z_s; z_u; v_s; v_u], u = [z_r; F]
% xdot = A*x + B*u
"""
    assert right(program, "quarter-car")
    assert not right(program.replace("v_s; v_u", "v_u; v_s"), "quarter-car")
