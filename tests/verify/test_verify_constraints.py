"""What `verify` says of systems with constraints that an independent examination found it wrong about."""

import pytest

import lagrangian as lg


def failed(s: lg.System) -> list[str]:
    return [f"{c.what}: {c.figure}" for c in s.verify(states=12) if c.holds is not True]


@pytest.mark.slow
def test_a_rope_over_two_pegs() -> None:
    """Of random lengths some are hardly longer than the way between the pegs: a point there all but meets its peg."""
    s = lg.System("rope over two pegs")
    xa, ya, xb, yb = s.coordinates("xa ya xb yb")
    a, b = s.point("A", (xa, ya)), s.point("B", (xb, yb))
    s.particle(1.0, at=a)
    s.particle(1.3, at=b)
    s.gravity()
    s.rope((a, s.point("P1", (-0.5, 0)), s.point("P2", (0.5, 0)), b), length=s.parameter("L", "4 m"), name="rope")
    assert not failed(s)


@pytest.mark.slow
def test_a_floating_body_on_a_ball_joint() -> None:
    s = lg.System("body on a ball joint")
    b = s.floating_frame("b")
    s.rigid_body(2.0, (0.1, 0.2, 0.25), at=b.origin, frame=b)
    s.gravity(direction=(0, 0, -1))
    s.ball((b.point(0.1, 0.2, 0.5, name="P"), s.origin), name="ball")
    assert not failed(s)
