"""Every built-in example has a picture whose parts lie within its frame."""

import numpy as np
import pytest

import built_in
from built_in import SOME, picture
from lagrangian.examples import names
from lagrangian.graph import evaluate
from lagrangian.page.placing import places


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", names())
def test_every_example_is_drawn_within_its_frame(name: str) -> None:
    found = picture(name)
    scene = found.scene
    assert {x for part in scene.parts for x in part.elements}
    spots = np.array(list(places(scene)))
    assert np.isfinite(spots).all()
    for label in scene.labels:
        x, y, w, h = label.box
        assert x >= 0 and y >= 0 and x + w <= scene.size[0] and y + h <= scene.size[1]


def test_the_anchors_are_the_points_of_the_system() -> None:
    system = built_in.system("double-pendulum")
    found = system.look(pose={"theta1": 0.3, "theta2": 1.1})
    program = found.program
    x = [0.3, 1.1, 0.0, 0.0]
    p = [program.defaults[name] for name in program.inputs["p"]]
    r = np.array(evaluate(program, {"x": x, "u": [], "p": p, "t": [0.0]})["r"])
    assert np.allclose(r, found.scene.positions)
    L1, L2 = (system.model.values[system[name]] for name in ("L1", "L2"))
    first = np.array([L1 * np.sin(0.3), -L1 * np.cos(0.3)])
    second = first + np.array([L2 * np.sin(1.1), -L2 * np.cos(1.1)])
    for expected in (np.zeros(2), first, second):
        assert np.abs(r - expected).sum(axis=1).min() < 1e-12
