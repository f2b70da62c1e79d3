"""Scenes made by hand, with hostile names and every kind of shape."""

from math import cos, pi, sin

from lagrangian.page.scene import Disc, Label, Path, Placement, Scene, ScenePart, Trace

HOSTILE = (
    "</text></svg><script>alert(1)</script>",
    '"><img src=x onerror=alert(1)>',
    "a\x00b\u202ec\ud800",
    "]]>&<!--",
    "m" * 10_000,
)

TURN = pi / 6


def line(*points: tuple[float, float], closed: bool = False) -> Path:
    corners = tuple(("L" if i else "M", point) for i, point in enumerate(points))
    return Path((*corners, ("Z", ())) if closed else corners)


def pendulum() -> Scene:
    """A rod of 1 m, turned by 30° from the vertical, 150 px a metre, with its pin, its angle and gravity."""
    ground = line((80, 40), (150, 40))
    return Scene(
        name="simple pendulum",
        size=(300, 240),
        origin=(115, 62),
        scale=150,
        view=((1, 0), (0, -1)),
        positions=((0.0, 0.0), (sin(TURN), -cos(TURN))),
        parts=(
            ScenePart(ground, "ground", outline=2),
            ScenePart(line((0, 0), (0, 75)), "thin", Placement(0), dashed=True, outline=1, moves=False),
            ScenePart(line((0, 0), (1, 0)), "rod", Placement(0, 1, "along"), ("rod",), outline=3, layer=1),
            ScenePart(Disc((0, 0), 11), "body", Placement(1), ("bob", "link 2"), "ball", filled=True, layer=2),
            ScenePart(line((255, 60), (255, 100)), "gravity", elements=("gravity",), outline=2),
        ),
        labels=(
            Label(("m",), (214, 192), "body", ("bob",)),
            Label(("theta1",), (133, 112), "coordinate"),
            Label(("g",), (270, 85), "gravity", ("gravity",)),
        ),
        description="a mass m on a rod that turns about a fixed pin",
        trail=(1,),
    )


def carts() -> Scene:
    """Two carts, a spring, a rope, a wheel with a mark, and a bar."""
    box = line((-25, -16), (25, -16), (25, 14), (-25, 14), closed=True)
    zigzag = line((0, 0), (0.2, 0), (0.3, -7), (0.5, 7), (0.7, -7), (0.8, 0), (1, 0))
    wave = Path((("M", (0, 0)), ("C", (0.2, -5, 0.8, 5, 1, 0))))
    return Scene(
        name="two carts",
        size=(400, 150),
        origin=(30, 100),
        scale=130,
        view=((1, 0), (0, -1)),
        positions=((0.0, 0.0), (1.0, 0.0), (2.2, 0.0), (2.2, 0.3)),
        parts=(
            ScenePart(line((20, 120), (390, 120)), "ground", outline=2, layer=-1),
            ScenePart(box, "body", Placement(1), ("cart 1",), "cart", filled=True, layer=2),
            ScenePart(box, "body", Placement(2), ("cart 2",), "cart", filled=True, layer=2),
            ScenePart(zigzag, "stiffness", Placement(0, 1, "along", shift_towards=(-25, 0)), ("k",), "spring"),
            ScenePart(wave, "input", Placement(1, 2, "along", (25, 0), (-25, 0)), ("F",), "force"),
            ScenePart(Disc((0, 0), 1), "body", Placement(2, 3, "both"), ("wheel",), "wheel"),
            ScenePart(line((0, 0), (1, 0)), "body", Placement(2, 3, "both"), ("wheel",), "wheel"),
            ScenePart(Trace((0, 3, 1), shifts=((0, 0), (0, -9), (0, 4))), "constraint", elements=("rope",)),
            ScenePart(line((0, 0), (60, 0)), "body", Placement(1, shift=(0, -40)), outline=12, layer=3),
            ScenePart(line((0, 0), (60, 0)), "body", Placement(1, shift=(0, -40)), outline=9, layer=3, paint="inside"),
        ),
        labels=(Label(("m_1", "J_wheel"), (160, 99), "body", ("cart 1",)),),
    )


def hostile() -> Scene:
    """A scene whose every text tries to leave its place."""
    return Scene(
        name=HOSTILE[0],
        size=(200, 100),
        origin=(0, 0),
        scale=1,
        view=((1, 0), (0, -1)),
        positions=((0.0, 0.0),),
        parts=tuple(ScenePart(Disc((50, 50), 9), "body", elements=(x,), kind=x) for x in HOSTILE),
        labels=tuple(Label((x, "m"), (50, 50), "input", (x,)) for x in HOSTILE),
        description="".join(HOSTILE[:4]),
    )
