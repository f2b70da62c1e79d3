"""Pictures as SVG: well-formed, at the places of the scene's formula, within the frame, safe with any name."""

import re
from math import cos, pi, sin
from xml.etree import ElementTree

import pytest

from hand_scenes import HOSTILE, TURN, carts, hostile, pendulum
from lagrangian.page.palette import LIGHT
from lagrangian.write.scene_svg import data_element, number, pair_text, scene_svg

SVG = "{http://www.w3.org/2000/svg}"
SCENES = {"pendulum": pendulum, "carts": carts, "hostile": hostile}


def parsed(text: str) -> ElementTree.Element:
    return ElementTree.fromstring(text.removeprefix('<?xml version="1.0" encoding="UTF-8"?>\n'))


def group(root: ElementTree.Element, element: str) -> ElementTree.Element:
    return next(g for g in root.iter(f"{SVG}g") if element in g.get("data-element", "").split(" "))


@pytest.mark.parametrize("embedded", [False, True])
@pytest.mark.parametrize("name", SCENES)
def test_it_is_well_formed_and_has_only_elements_that_draw(name: str, embedded: bool) -> None:
    root = parsed(scene_svg(SCENES[name](), embedded=embedded))
    allowed = {"svg", "title", "desc", "style", "rect", "g", "path", "circle", "text", "tspan"}
    assert {x.tag.removeprefix(SVG) for x in root.iter()} <= allowed
    assert not [key for x in root.iter() for key in x.attrib if key.startswith("on") or key in ("href", "id")]


def test_a_document_says_what_is_seen() -> None:
    root = parsed(scene_svg(pendulum()))
    assert root.get("role") == "img"
    assert root[0].tag == f"{SVG}title" and root[0].text == "simple pendulum"
    assert root[1].tag == f"{SVG}desc" and root[1].text == "a mass m on a rod that turns about a fixed pin"


def test_parts_lie_where_the_scene_says() -> None:
    root = parsed(scene_svg(pendulum()))
    bob = group(root, "bob").find(f"{SVG}circle")
    assert bob is not None
    assert float(bob.get("cx", "")) == pytest.approx(115 + 150 * sin(TURN), abs=0.006)
    assert float(bob.get("cy", "")) == pytest.approx(62 + 150 * cos(pi / 6), abs=0.006)
    rod = group(root, "rod").find(f"{SVG}path")
    assert rod is not None and rod.get("d") == f"M115 62L190 {number(62 + 75 * 3**0.5)}"


def test_groups_carry_roles_kinds_and_elements() -> None:
    root = parsed(scene_svg(pendulum()))
    bob = group(root, "bob")
    assert bob.get("class") == "glyph kind-ball role-body"
    assert bob.get("data-element") == "bob link\u00a02"


def test_a_label_is_letters_with_subscripts() -> None:
    root = parsed(scene_svg(pendulum()))
    halo, ink = [x for x in root.iter(f"{SVG}text") if "".join(x.itertext()) == "θ1"]
    assert halo.get("aria-hidden") == "true" and ink.get("fill") == LIGHT.line("coordinate")
    letter, sub = ink
    assert letter.get("font-style") == "italic" and sub.get("font-style") is None
    assert float(sub.get("font-size", "")) < 15 and float(sub.get("dy", "")) > 0


def test_a_label_on_a_body_has_a_halo_of_its_colour() -> None:
    halo = parsed(scene_svg(carts())).find(f".//{SVG}text")
    assert halo is not None and halo.get("class") == "halo on-body" and halo.get("fill") == LIGHT.body


def test_later_layers_are_drawn_later() -> None:
    groups = [g.get("data-element") for g in parsed(scene_svg(pendulum())).iter(f"{SVG}g")]
    assert groups[:5] == [None, None, "gravity", "rod", "bob link\u00a02"]


def test_styles_reach_nothing_outside_of_the_picture() -> None:
    style = parsed(scene_svg(pendulum(), embedded=True)).findtext(f"{SVG}style") or ""
    inner = re.sub(r"@media[^{]*\{(.*?\})\}", r"\1", style)
    selectors = [s for rule in re.findall(r"([^{}]+)\{", inner) for s in rule.split(",")]
    assert len(selectors) > 10 and all(s.startswith(".lagrangian-scene") for s in selectors)


def test_both_schemes_have_colours_and_the_attributes_are_those_of_the_light_one() -> None:
    text = scene_svg(pendulum())
    assert "prefers-color-scheme:dark" in text and 'stroke="#1d2328"' in text
    assert "currentColor" not in text and "url(" not in text


@pytest.mark.parametrize("embedded", [False, True])
def test_hostile_names_stay_text(embedded: bool) -> None:
    text = scene_svg(hostile(), embedded=embedded)
    assert "<script" not in text and "<img" not in text and "\x00" not in text and "\u202e" not in text
    root = parsed(text)
    assert root.findtext(f"{SVG}title") == HOSTILE[0]
    assert max(len("".join(x.itertext())) for x in root.iter(f"{SVG}text")) < 100
    assert all(re.fullmatch(r"[A-Za-z0-9 _-]+", g.get("class", "")) for g in root.iter(f"{SVG}g"))


@pytest.mark.parametrize(
    ("x", "text"), [(0.0, "0"), (-0.001, "0"), (1.5, "1.5"), (100.0, "100"), (-0.126, "-0.13"), (1e6, "1000000")]
)
def test_numbers_are_short(x: float, text: str) -> None:
    assert number(x) == text


def test_pairs_need_no_space_before_a_minus_sign() -> None:
    assert pair_text([1, -2, 3.25]) == "1-2 3.25"


def test_names_of_elements_are_separated_by_spaces() -> None:
    assert data_element(("link 2", "bob")) == "link\u00a02 bob"
