"""``[look]`` in model files: what is read, what is refused and where, and what is written again."""

import re

import pytest

import built_in
import lagrangian as lg
from lagrangian.coordinates.carry import changed
from lagrangian.read import schema

HINTS = """
[look]
pose = { theta = "20 deg" }
kinds = { cart = "box" }
view = { azimuth = "30 deg", elevation = 0.2 }
trail = ["pole"]
hide = ["g"]

[[look.line]]
through = ["cart", "pole"]
kind = "wire"

[[look.shape]]
frame = "pole"
box = ["5 cm", 0.6]

[[look.shape]]
frame = "rod"
at = "cart"
points = [[0, 0], ["0.1 m", 0], [0, "0.1 m"]]
"""
FILE = built_in.system("cart-pole").to_toml() + HINTS


def test_hints_are_written_as_they_were_read() -> None:
    system = lg.loads(FILE)
    again = lg.loads(system.to_toml())
    assert again.model.look == system.model.look
    assert again.to_toml() == system.to_toml()
    assert system.model.look["pose"] == {"theta": "20 deg"}
    assert system.model.look["line"] == [{"through": ["cart", "pole"], "kind": "wire"}]
    assert [sorted(x) for x in system.model.look["shape"]] == [["box", "frame"], ["at", "frame", "points"]]


def test_hints_do_not_change_the_mechanics() -> None:
    assert lg.loads(FILE).derive().equations == built_in.derivation("cart-pole").equations


WRONG = [
    ('theta = "20 deg"', "thet = 1", "E402", "Did you mean 'theta'"),
    ('"20 deg"', '"20 kg"', "E408", "a length or an angle"),
    ('cart = "box"', 'cort = "box"', "E402", "Did you mean 'cart'"),
    ('cart = "box"', 'cart = "bax"', "E402", "Did you mean 'box'"),
    ('"30 deg"', '"30 m"', "E408", "an angle"),
    ("elevation = 0.2", "elevation = 99", "E406", "two turns"),
    ("elevation = 0.2", "elevation = nan", "E101", "finite"),
    ("elevation", "elevetion", "E405", "Did you mean 'elevation'"),
    ('trail = ["pole"]', 'trail = ["pool"]', "E402", "Did you mean 'pole'"),
    ('hide = ["g"]', 'hide = ["gravitas"]', "E402", "known:"),
    ('["cart", "pole"]', '["cart", "pale"]', "E402", "Did you mean 'pole'"),
    ('["cart", "pole"]', '["cart"]', "E414", "at least 2"),
    ('"wire"', '"wir"', "E402", "Did you mean 'wire'"),
    ('frame = "pole"', 'frame = "pol"', "E402", "Did you mean 'pole'"),
    ('at = "cart"', 'at = "card"', "E402", "Did you mean 'cart'"),
    ('"5 cm"', '"5 kg"', "E408", "a length"),
    ('"5 cm"', "-1", "E406", "greater than 0"),
    ('box = ["5 cm", 0.6]', "", "E401", "outline is missing"),
    ('box = ["5 cm", 0.6]', "box = [1, 1]\npoints = [[0, 0], [1, 1]]", "E404", "both"),
    ('[0, "0.1 m"]]', "[0, 1, 2]]", "E414", "3 components in the plane"),
    ('box = ["5 cm", 0.6]', "bix = [1, 1]", "E405", "Did you mean 'box'"),
]


@pytest.mark.parametrize(("old", "new", "code", "said"), WRONG)
def test_a_mistake_is_told_at_its_line(old: str, new: str, code: str, said: str) -> None:
    assert FILE.count(old) >= 1
    at = FILE.rindex(old)
    text = FILE[:at] + new + FILE[at + len(old) :]
    with pytest.raises(lg.ParseError) as caught:
        lg.loads(text)
    error = caught.value
    assert error.code == code
    assert said in str(error)
    assert error.place is not None and error.place.line is not None
    near = FILE[:at].count("\n") + 1
    assert abs(error.place.line - near) <= 2


def test_every_table_of_hints_is_in_the_published_schema() -> None:
    made = schema()
    table = made["$defs"]["LookTable"]["properties"]
    assert set(table) == {"pose", "kinds", "view", "trail", "hide", "line", "shape"}
    assert "string" in made["$defs"]["LookLineTable"]["properties"]["kind"]["enum"]


@pytest.mark.parametrize("text", ["x" * 5000, "a\u0000", "</svg><script>", "\u202e"])
def test_hostile_names_are_refused_in_few_words(text: str) -> None:
    quoted = "".join(c if c.isalnum() or c in "</> " else f"\\u{ord(c):04X}" for c in text)
    with pytest.raises(lg.ParseError) as caught:
        lg.loads(FILE.replace('trail = ["pole"]', f'trail = ["{quoted}"]'))
    assert len(re.sub(r"\s+", " ", caught.value.what)) < 300


TWO = built_in.system("lecture-3a").to_toml()


def test_a_complete_pose_follows_a_change_of_coordinates() -> None:
    system = lg.loads(TWO + '\n[look]\npose = { x1 = "0.2 m", x2 = "0.5 m" }\nhide = ["x2", "m1"]\n')
    look = changed(system.model, {"x2": "x1 + x2r"}).look
    assert look["pose"] == pytest.approx({"x1": 0.2, "x2r": 0.3}, abs=1e-12)
    assert look["hide"] == ["m1"]


def test_a_pose_of_what_is_gone_is_left_out_and_told(caplog: pytest.LogCaptureFixture) -> None:
    system = lg.loads(TWO + '\n[look]\npose = { x2 = "0.5 m" }\n')
    assert changed(system.model, {"x2": "x1 + x2r"}).look["pose"] == {}
    assert "'x2'" in caplog.text
