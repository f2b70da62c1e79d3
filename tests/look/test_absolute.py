"""Systems as people write them down: everything from the origin, small angles, lengths by sines; the same pictures."""

from collections import Counter

import numpy as np
import pytest
from sympy import cos, pi, sin

import lagrangian as lg
from lagrangian.page.placing import placed, places

SLOPE = pi / 6


def _wedge(*, absolute: bool, sense: int) -> lg.System:
    """A block on a wedge (Meriam and Kraige, Dynamics, 3): down the slope or up, from the wedge or from the origin."""
    s = lg.System("wedge")
    x, y = s.coordinates("x y")
    M, m, k = s.parameters("M m k", M="4 kg", m="1 kg", k="50 N/m")
    wedge = s.point("wedge", (x, 0))
    step = (y * cos(SLOPE), sense * y * sin(SLOPE))
    block = s.point("block", (x + step[0], step[1])) if absolute else s.point("block", step, relative_to=wedge)
    s.particle(M, at=wedge, name="wedge")
    s.particle(m, at=block, name="block")
    s.spring(k, deflection=x)
    return s


def _spots(picture: lg.Picture, kind: str) -> np.ndarray:
    """The places [px] of the parts of a kind."""
    at = places(picture.scene)
    drawn = [x for part in picture.scene.parts if part.kind == kind for x in placed(part, at)]
    found = [numbers[:2] if letter == "O" else numbers for letter, numbers in drawn]
    return np.concatenate(found).reshape(-1, 2)


@pytest.mark.parametrize("sense", [1, -1])
def test_a_block_on_a_wedge_is_drawn_alike_from_the_wedge_and_from_the_origin(sense: int) -> None:
    one, two = (_wedge(absolute=x, sense=sense).look() for x in (False, True))
    assert not one.missing and one.to_svg() == two.to_svg()


@pytest.mark.parametrize("sense", [1, -1])
def test_a_block_lies_on_its_wedge_and_its_spring_ends_there(sense: int) -> None:
    picture = _wedge(absolute=False, sense=sense).look()
    wedge, block, spring = (_spots(picture, kind) for kind in ("wedge", "block", "spring"))
    assert wedge[:, 0].min() < block[:, 0].mean() < wedge[:, 0].max()
    assert wedge[:, 1].min() - 40 < block[:, 1].mean() < wedge[:, 1].max()
    upright = wedge[np.argmin(wedge[:, 1]), 0]
    assert np.abs(spring[:, 0] - upright).min() < 0.5
    assert wedge[:, 1].min() < spring[:, 1].mean() < wedge[:, 1].max()


def test_springs_of_small_angles_hang_on_the_body_where_their_lever_arms_end() -> None:
    """Half a car by y − a θ and y + b θ (Rao, Mechanical Vibrations, 5.5), with no point of the model there."""
    s = lg.System("half car")
    y, theta = s.coordinates("y theta")
    a, b, k, c, m, J = s.parameters("a b k c m J", a="1.2 m", b="1.4 m", k="20 kN/m", c="1 kN*s/m", m="1 t", J=1500)
    body = s.frame(theta, name="body")
    s.rigid_body(m, J, at=s.point("G", (0, y)), frame=body, name="body")
    for arm in (-a, b):
        s.spring(k, deflection=y + arm * theta)
        s.damper(c, deflection=y + arm * theta)
    picture = s.look()
    assert not picture.missing
    scale, middle = picture.scene.scale, _spots(picture, "centre")[:, 0].mean()
    tops = sorted(
        placed(part, places(picture.scene))[0][1][0]
        for part in picture.scene.parts
        if part.kind in ("spring", "damper")
    )
    for found, arm in zip(tops, (-1.2, -1.2, 1.4, 1.4), strict=True):
        assert abs(found - middle - arm * np.cos(picture.pose["theta"]) * scale) < 20


def _bar_in_guides() -> lg.System:
    """A bar between an upright and a level guide (Hibbeler, Dynamics, 18): no rod joins its middle to the corner."""
    s = lg.System("bar in guides")
    theta = s.coordinate("theta")
    m, L, k = s.parameters("m L k", m="3 kg", L="1 m", k="200 N/m")
    bar = s.frame(theta, name="bar")
    A, B = s.point("A", (0, L * cos(theta))), s.point("B", (L * sin(theta), 0))
    s.rigid_body(m, m * L**2 / 12, at=s.point("G", (L / 2 * sin(theta), L / 2 * cos(theta))), frame=bar, name="bar")
    s.particle(m, at=A, name="A")
    s.particle(m, at=B, name="B")
    s.spring(k, deflection=L - L * cos(theta))
    return s


def test_a_bar_is_held_by_its_ends_and_a_spring_finds_the_block_that_it_moves() -> None:
    picture = _bar_in_guides().look()
    kinds = Counter(part.kind for part in picture.scene.parts)
    assert not picture.missing
    assert kinds["spring"] == 1 and kinds["rod"] == 0 and kinds["pin"] == 0 and kinds["link"] >= 1
    upright = _spots(picture, "spring")
    assert np.ptp(upright[:, 1]) > np.ptp(upright[:, 0])


def test_a_motor_that_drives_a_cart_by_its_wheel_pushes_the_cart() -> None:
    s = lg.System("driven cart")
    q, x = s.coordinate("q", unit="C"), s.coordinate("x")
    M, L, K, r = s.parameters("M L K r", M="1 kg", L="1 mH", K="0.05 N*m/A", r="20 mm")
    s.particle(M, at=s.point("cart", (x, 0)), name="cart")
    s.inductor(L, q)
    s.transducer(K, q, on=-x / r)
    picture = s.look()
    assert not picture.missing
    shaft = next(p for p in picture.scene.parts if p.kind == "force" and not p.solid)
    (_, start), (_, end) = placed(shaft, places(picture.scene))[:2]
    assert end[0] < start[0] and end[1] == pytest.approx(start[1])
