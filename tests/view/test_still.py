"""The schematic as an image: of the size of the picture, with bodies and letters where they are, and without matplotlib
an error that says what to install."""

from __future__ import annotations

import io
import sys
from typing import Any

import numpy as np
import pytest

import lagrangian as lg
from built_in import picture
from lagrangian.page.palette import DARK, LIGHT

matplotlib_image = pytest.importorskip("matplotlib.image")


def pixels(content: bytes) -> np.ndarray:
    """The colours (height, width, 3) of an image, from 0 to 255."""
    image = matplotlib_image.imread(io.BytesIO(content), format="png")
    return np.rint(255 * image[..., :3]).astype(int)


def colour(text: str) -> list[int]:
    return [int(text[k : k + 2], 16) for k in (1, 3, 5)]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("dark", [False, True])
def test_the_image_has_the_bodies_where_the_picture_has_them(dark: bool) -> None:
    shown = picture("double-pendulum")
    palette, scene = DARK if dark else LIGHT, shown.scene
    image = pixels(shown.to_png(dark=dark, scale=3))
    assert image.shape[:2] == pytest.approx((3 * scene.size[1], 3 * scene.size[0]), abs=2)
    assert image[2, 2].tolist() == colour(palette.paper)
    ball = next(p for p in scene.parts if p.kind == "ball" and "m2" in p.elements)
    x, y = scene.seen(ball.placement.at, ball.placement.shift)
    assert image[round(3 * y), round(3 * x)].tolist() == colour(palette.body)


def test_every_label_has_ink() -> None:
    shown = picture("lecture-1")
    image = pixels(shown.to_png())
    for label in shown.scene.labels:
        x, y, w, h = (round(2 * v) for v in label.box)
        own = image[y : y + h, x : x + w].reshape(-1, 3)
        assert np.abs(own - colour(LIGHT.line(label.role))).sum(axis=1).min() < 60, label.names


def test_the_ending_chooses_it(tmp_path: Any) -> None:
    path = picture("pendulum").save(tmp_path / "pendulum.png")
    assert path.read_bytes().startswith(b"\x89PNG\r\n")


def test_without_matplotlib_the_error_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib.figure", None)
    with pytest.raises(lg.Error, match="matplotlib") as caught:
        picture("pendulum").to_png()
    assert "pip install 'lagrangian[plot]'" in str(caught.value)
