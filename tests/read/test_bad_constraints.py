"""Sixty bad or odd constraints in files: each is told where it is, what is wrong and what would be right."""

import pytest

import lagrangian as lg

HEAD = """name = "s"
[coordinates]
x = ""
y = ""
theta = ""
[parameters]
l = "1 m"
m = "1 kg"
J = "1 kg*m^2"
[inputs]
F = "N"
[points]
P = ["x", "y"]
Q = [1, 0]
[[frame]]
name = "b"
angle = "theta"
[[rigid_body]]
name = "disc"
mass = "m"
inertia = "J"
at = "P"
frame = "b"
"""

BAD = {
    "no form": ('[[constraint]]\nname="a"\n', "E412", "got neither"),
    "two forms": ('[[constraint]]\nexpression="x"\nbetween=["P","Q"]\n', "E412", "got both"),
    "unknown point": ('[[constraint]]\nbetween=["P","R"]\n', "E412", "unknown point 'R'"),
    "three points": ('[[constraint]]\nbetween=["P","Q","origin"]\n', "E414", "3 entries"),
    "one point": ('[[pin]]\nbetween=["P"]\n', "E414", "1 entry"),
    "rate": ('[[constraint]]\nexpression="x\'"\n', "E419", "contains a rate"),
    "input": ('[[constraint]]\nexpression="x - F"\n', "E417", "may depend on t"),
    "input rate": ('[[velocity_constraint]]\nexpression="x\' - F"\n', "E417", "may depend on t"),
    "quadratic": ('[[velocity_constraint]]\nexpression="x\'^2 - 1"\n', "E301", "not linear"),
    "sin of rate": ('[[velocity_constraint]]\nexpression="sin(x\')"\n', "E301", "not linear"),
    "abs of rate": ('[[velocity_constraint]]\nexpression="abs(x\') - 1"\n', "E301", "not linear"),
    "no rate": ('[[velocity_constraint]]\nexpression="x"\n', "E301", "no rate"),
    "acceleration": ("[[velocity_constraint]]\nexpression=\"x''\"\n", "E418", "acceleration"),
    "units": ('[[constraint]]\nexpression="x - m"\n', "E408", "inside its expression"),
    "units of a distance": ('[[constraint]]\nbetween=["P","Q"]\ndistance="m"\n', "E408", "kg, but m"),
    "empty": ('[[constraint]]\nexpression=""\n', "E406", "empty"),
    "garbage": ('[[constraint]]\nexpression="x -* y"\n', "E701", "after '-'"),
    "call": ('[[constraint]]\nexpression="__import__(1)"\n', "E402", "__import__"),
    "unknown": ('[[constraint]]\nexpression="z"\n', "E402", "unknown symbol 'z'"),
    "unknown body": ('[[rolling]]\nbody="wheel"\nat="P"\nalong=[1,0]\n', "E402", "known: disc"),
    "frame for body": ('[[rolling]]\nbody="b"\nat="P"\nalong=[1,0]\n', "E402", "the body that turns with it is 'disc'"),
    "directions of two kinds": (
        '[[rolling]]\nbody="disc"\nat="P"\nalong=[1,[0,1]]\n',
        "E406",
        "direction 1 is not a list",
    ),
    "along zero": ('[[rolling]]\nbody="disc"\nat="P"\nalong=[0,0]\n', "E409", "no direction"),
    "along three": ('[[rolling]]\nbody="disc"\nat="P"\nalong=[1,0,0]\n', "E414", "2 components"),
    "missing at": ('[[rolling]]\nbody="disc"\nalong=[1,0]\n', "E401", "'at' is missing"),
    "weld same": ('[[weld]]\nbetween=["P","P"]\n', "E410", "same point"),
    "weld frames": ('[[weld]]\nbetween=["P","Q"]\nbodies=["c"]\n', "E412", "unknown frame 'c'"),
    "slider": ('[[slider]]\nbetween=["P","Q"]\nalong=["x",1]\n', "E419", "made of parameters"),
    "rope": ('[[rope]]\nthrough=["P"]\nlength=1\n', "E414", "1 entry"),
    "rope neg": ('[[rope]]\nthrough=["P","Q"]\nlength=-1\n', "E406", "above 0"),
    "name twice": (
        '[[constraint]]\nname="a"\nexpression="x"\n[[pin]]\nname="a"\nbetween=["P","Q"]\n',
        "E404",
        "line 24",
    ),
    "contradict": (
        '[[constraint]]\nname="a"\nexpression="x"\n[[constraint]]\nname="b"\nexpression="x-1 + l - l"\n',
        "E302",
        "'b'",
    ),
    "too many": (
        '[[pin]]\nbetween=["P","Q"]\n[[constraint]]\nexpression="theta"\n[[constraint]]\nexpression="theta+x/l-1"\n',
        "E302",
        "contradicts",
    ),
    "more rows than velocities": (
        '[[pin]]\nname="p"\nbetween=["P","Q"]\n[[constraint]]\nname="c"\nexpression="theta"\n'
        '[[velocity_constraint]]\nname="d"\nexpression="x\' - theta\' - 1"\n',
        "E302",
        "the constraint 'd' contradicts 'p.x' and 'c'",
    ),
    "too short": (
        '[[constraint]]\nname="rod"\nbetween=["P","Q"]\ndistance="l"\n[[constraint]]\nexpression="x - 5*l"\n',
        "E304",
        "'rod' by 3 m",
    ),
    "held open": (
        '[[constraint]]\nname="rod"\nbetween=["P","Q"]\ndistance="l"\n[simulate]\nfixed=["x","y"]\n',
        "E304",
        "do not hold x or y fixed: without that, a position is found",
    ),
    "unknown field": ('[[constraint]]\nbetween=["P","Q"]\ndistence="l"\n', "E405", "'distance'"),
    "unknown axes": ('[[constraint]]\nbetween=["P","Q"]\naxes="zz"\n', "E412", "unknown frame 'zz'"),
    "unknown joint": (
        '[[constraint]]\nname="rod"\nbetween=["P","Q"]\ndistance="l"\n[simulate]\nreactions=["rud"]\n',
        "E402",
        "no joint 'rud'",
    ),
    "kink": ('[[constraint]]\nexpression="abs(x) - l"\n', "E308", "kink"),
    "sqrt neg": ('[[constraint]]\nexpression="sqrt(-1 - x^2/l^2)"\n', "E503", "constraint 1 has no finite"),
    "impossible": ('[[constraint]]\nexpression="x^2/l^2 + 1"\n', "E304", "look at the expressions"),
    "no slope": ('[[constraint]]\nname="a"\nexpression="x^2"\n', "E309", "write what is 0 itself"),
    "rates held": (
        '[[velocity_constraint]]\nexpression="x\' - y\'"\n[simulate]\nfixed=["x","y"]\ninitial={"x\'"=1, "y\'"=2}\n',
        "E305",
        "hold fewer",
    ),
    "friction on its own row": (
        '[[friction]]\nmu=0.3\npressed_by="floor"\ndeflection="y"\n[[constraint]]\nname="floor"\nexpression="y"\n',
        "E310",
        "friction 1: the row 'floor' presses",
    ),
    "floating section": ('[[floating]]\nname="b"\n', "E405", "mean 'frame' with floating = true"),
    "section of books": ('[[nonholonomic]]\nexpression="x\'"\n', "E405", "mean 'velocity_constraint'"),
    "joint of books": ('[[hinge]]\nbetween=["P","Q"]\n', "E405", "mean 'pin'"),
    "numbered": ('[[constraint]]\nexpression="x\'"\n', "E419", "] constraint 1: the"),
    "equation": (
        '[[constraint]]\nexpression="x = l*theta - y"\n',
        "E701",
        "write what is zero, without '=': x - (l*theta - y)",
    ),
    "equals zero": ('[[constraint]]\nname="c"\nexpression="x - l = 0"\n', "E701", "without '=': x - l"),
    "comparison": ('[[velocity_constraint]]\nname="c"\nexpression="x\' == y\'"\n', "E701", "without '=': x' - y'"),
    "a rate": ('[[constraint]]\nname="c"\nexpression="x\' - y"\n', "E419", "on rates is a velocity constraint"),
    "one end": ('[[constraint]]\nbetween=["P"]\n', "E414", "has 1 entry"),
    "const": ('[[constraint]]\nexpression="l"\n', "E410", "restricts nothing"),
    "pin axis": ('[[pin]]\nbetween=["P","Q"]\naxis=[0,0,1]\n', "E414", "no axis"),
    "fixed": ('[[pin]]\nbetween=["P","Q"]\n[simulate]\nfixed=["z"]\n', "E402", "no coordinate 'z'"),
}


def verbs(text: str) -> None:
    """Read, derive and run: what is wrong shows at the latest here."""
    s = lg.loads(HEAD + text)
    s.derive()
    s.simulate(0.5, x=0.3, y=0.2)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("case", BAD)
def test_what_is_wrong_is_said_with_its_place_and_a_cure(case: str) -> None:
    text, code, said = BAD[case]
    with pytest.raises(lg.Error) as caught:
        verbs(text)
    error = caught.value
    assert error.code == code and said in str(error), str(error)
    assert error.fix or "known" in str(error)
    assert "<text>:" in str(error)


@pytest.mark.slow
def test_a_system_that_cannot_move_is_solved_all_the_same() -> None:
    s = lg.loads(HEAD + '[[pin]]\nname="p"\nbetween=["P","Q"]\n[[constraint]]\nname="c"\nexpression="theta"\n')
    d = s.derive()
    assert d.constraints is not None and d.constraints.verdict == "holonomic: #GC = #DDOF = 0"
    assert "Nothing is left to move freely" in str(d)
    assert all(check.holds is not False for check in d.verified)
    run = s.simulate(0.5, x=0.3, y=0.2)
    assert run.success and run["x"][-1] == pytest.approx(1.0)


@pytest.mark.slow
def test_a_prescribed_motion_is_no_mistake() -> None:
    s = lg.loads(HEAD + '[[constraint]]\nname="drive"\nexpression="x - l*sin(3*t)"\n')
    assert s.simulate(0.5).success
