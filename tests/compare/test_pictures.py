"""Two systems side by side: the same pose, and one picture of both."""

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest

import built_in
import lagrangian as lg

PAIRS = [
    ("lecture-3a", "lecture-3b", ("x1", "x2"), lambda q: (q["x1"], q["x1"] + q["x2r"])),
    ("lecture-3b", "lecture-3a", ("x1", "x2r"), lambda q: (q["x1"], q["x2"] - q["x1"])),
    ("lecture-2", "lecture-2-absolute", ("theta1", "theta2"), lambda q: (q["theta1"], q["theta2"] - q["theta1"])),
]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("a", "b", "names", "of"), PAIRS)
def test_both_are_drawn_in_the_same_pose(a: str, b: str, names: tuple, of) -> None:
    found = lg.compare(built_in.system(a), built_in.system(b)).look()
    assert np.allclose([found.left.pose[n] for n in names], of(found.right.pose), atol=1e-12)


def test_the_picture_holds_both_and_is_saved(tmp_path: Path) -> None:
    pair = lg.compare(built_in.system("lecture-3a"), built_in.system("lecture-3b")).look()
    root = ET.fromstring(pair.save(tmp_path / "pair.svg").read_text(encoding="utf-8").partition("\n")[2])
    named = [n for g in root.iter() for n in g.get("data-element", "").split()]
    assert named.count("m1") >= 4
    texts = "".join(root.itertext())
    assert "(A) two carts and a spring, absolute" in texts and "(B)" in texts
    width, height = (float(x) for x in root.get("viewBox", "").split()[2:])
    assert width >= pair.left.size[0] + pair.right.size[0] and height > max(pair.left.size[1], pair.right.size[1])
    assert "<svg" in pair._repr_html_()
    with pytest.raises(lg.Error):
        pair.save(tmp_path / "pair.png")


def test_systems_of_different_size_have_each_its_own_pose() -> None:
    found = lg.compare(built_in.system("pendulum"), built_in.system("double-pendulum")).look()
    assert set(found.left.pose) == {"theta"} and set(found.right.pose) == {"theta1", "theta2"}
