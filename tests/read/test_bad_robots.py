"""Robots' files that are wrong or hostile: what the message says, and the line at which it points."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from robot_texts import TWO, chain, joint, link, robot

import lagrangian as lg
from effort import at_most
from lagrangian.errors import ModelError, ParseError
from lagrangian.read.robots import markup
from size import sized

CALLS = 10_000_000
"""Of Python functions, that any one of these takes at most."""

EXPANDING = "".join(f'<!ENTITY a{k} "{f"&a{k - 1};" * 10}">' for k in range(1, 9))


def change(old: str, new: str, count: int = 1) -> str:
    assert old in TWO
    return TWO.replace(old, new, count)


BAD = [
    # markup
    ("<robot", "[E701] this is not XML", 1),
    ("<robot name='a'>\n<link></robot>", "this is not XML: mismatched tag", 2),
    ("<robot>\x01</robot>", "this is not XML", 1),
    ('<!DOCTYPE robot SYSTEM "http://example.org/x.dtd">\n<robot/>', "[E701] a document type is not read", 1),
    (f'<!DOCTYPE r [<!ENTITY a0 "ha">{EXPANDING}]><robot name="&a8;"/>', "a document type is not read", 1),
    ("<robot>\n&secret;</robot>", "this is not XML: undefined entity", 2),
    ("<a>" * 70 + "</a>" * 70, "[E703] elements are nested more than 64 deep", 1),
    ("<robot" + "".join(f" a{k}='1'" for k in range(201)) + "/>", "[E703] an element has more than 200 attributes", 1),
    ("<html>\n</html>", "[E405] <html>: the outermost element is <html>, which is not a robot's", 1),
    # links and joints
    ("<robot name='a'>\n</robot>", "[E401] robot 'a': the robot has no links", 1),
    (change('<link name="base">', '<link name="base2">'), "there is no link 'base'", 5),
    (change('<link name="base">', "<link>"), "[E401] <link>: the attribute 'name' is missing", 3),
    (change("</robot>", '<link name="base"/></robot>'), "two links named 'base' (the other in line 3)", 8),
    (
        change("</robot>", '<link name="loose"/></robot>'),
        "[E404] link 'loose': 2 links have no parent: 'base', 'loose'",
        8,
    ),
    (change('parent link="base"', 'parent link="link2"'), "the links carry each other in a circle", 7),
    (
        change('parent link="base"', 'parent link="link1"'),
        "[E410] joint 'joint1': joint 'joint1' joins link 'link1' to",
        5,
    ),
    (
        change('"link1"/><child link="link2"', '"base"/><child link="link1"'),
        "is the child of two joints (the other is 'joint1')",
        7,
    ),
    (change('<parent link="base"/>', ""), "[E401] joint 'joint1': <parent> is missing", 5),
    (change('name="joint2"', 'name="joint1"'), "two joints named 'joint1' (the other in line 5)", 7),
    (change('type="revolute"', 'type="revolut"'), "[E405] joint 'joint1': there is no joint of type 'revolut'", 5),
    (TWO.replace('type="revolute"', 'type="fixed"'), "[E201] link 'base': nothing in the robot moves", 3),
    (change('<axis xyz="0 1 0"/>', '<axis xyz="0 0 0"/>'), "[E409] <axis>: the axis of joint 'joint1' is (0, 0, 0)", 5),
    (change('<axis xyz="0 1 0"/>', '<axis xyz="0 1"/>'), "[E414] <axis>: 'xyz' has 2 entries", 5),
    (change("<axis", '<axis xyz="1 0 0"/><axis'), "[E404] <axis>: there are two <axis> in joint 'joint1'", 5),
    (
        change("<axis", '<dynamics damping="-1"/><axis'),
        "[E406] <dynamics>: the damping of joint 'joint1' is negative",
        5,
    ),
    (change("<axis", '<mimic joint="joint3"/><axis'), "[E402] joint 'joint1': it follows the joint 'joint3', which", 5),
    (change("<axis", '<mimic joint="joint1"/><axis'), "joints follow each other in a circle: joint1 → joint1", 5),
    # numbers
    (
        change('mass value="1.5"', 'mass value="-1.5"'),
        "[E102] <mass>: the mass of link 'link1' is negative (-1.5 kg)",
        4,
    ),
    (change('mass value="1.5"', 'mass value="0"'), "[E103] <mass>: link 'link1' has an inertia, and its mass is 0", 4),
    (change('mass value="1.5"', 'mass value="nan"'), "[E101] <mass>: 'value' must be finite (got 'nan')", 4),
    (change('mass value="1.5"', 'mass value="1e999"'), "[E101] <mass>: 'value' must be finite (got '1e999')", 4),
    (change('mass value="1.5"', 'mass value="1,5"'), "[E406] <mass>: 'value' is '1,5', not a number", 4),
    (change('mass value="1.5"', 'mass value="${m}"'), "'value' is '${m}', which is not a number", 4),
    (change('mass value="1.5"', "mass"), "[E401] <mass>: the attribute 'value' is missing", 4),
    (change('<mass value="1.5"/>', ""), "[E401] <inertial>: <mass> is missing", 4),
    (change('iyy="0.01"', 'iyy="-0.5"'), "its inertia is not positive semidefinite", 6),
    (change('lower="-3"', 'lower="low"'), "[E406] <limit>: 'lower' is 'low', not a number", 5),
]


@pytest.mark.parametrize(("text", "said", "line"), BAD, ids=[said[:50] for _, said, _ in BAD])
def test_the_message_names_the_mistake_and_its_line(text, said, line):
    with pytest.raises(ModelError) as caught, at_most(CALLS):
        lg.loads(text, name="bad.urdf").model  # noqa: B018
    assert said in str(caught.value)
    assert f"bad.urdf:{line}" in str(caught.value) or f"(bad.urdf, line {line})" in str(caught.value)


def test_the_number_of_elements_is_limited(monkeypatch):
    monkeypatch.setattr(markup, "MAX_TAGS", 20)
    with pytest.raises(ParseError, match="more than 20 elements"):
        lg.loads("<robot>" + "<link/>" * 20 + "</robot>")


def test_a_moving_link_at_the_end_needs_mass():
    text = robot(
        "light",
        link("base"),
        link("arm"),
        link("hand"),
        joint("a", "revolute", "base", "arm"),
        joint("b", "fixed", "arm", "hand"),
    )
    with pytest.raises(ParseError, match="nothing that it moves has mass: link 'arm' and what it carries") as caught:
        lg.loads(text)
    assert caught.value.place is not None and caught.value.place.line == 6


def test_an_inertia_that_no_body_has_is_a_notice():
    system = lg.loads(change('ixx="0.02"', 'ixx="0.2"'), name="arm.urdf")
    assert any(n.code == "E105" and "arm.urdf, line 4" in n.where for n in system.notices)


@pytest.mark.slow
def test_longest_chains_are_read_and_longer_ones_refused():
    one = ("1", "0.1 0 0")
    assert len(lg.loads(chain("long", [one] * 100, [{"xyz": "0.1 0 0"}] * 100)).model.bodies) == 100
    with pytest.raises(ParseError, match="more than 100 links one after the other"):
        lg.loads(chain("longer", [one] * 101, [{"xyz": "0.1 0 0"}] * 101))


PIECES = st.sampled_from(
    [
        "<",
        ">",
        "/",
        '"',
        "=",
        "&",
        "<link",
        "<joint",
        "</robot>",
        "<!--",
        "]]>",
        "<![CDATA[",
        "<?",
        "\x00",
        "\ud7ff",
        "é",
        "nan",
        "1e400",
        "-",
        "0",
        "e",
        " ",
        "link1",
        "base",
        'name="base"',
        "<mimic joint='joint2'/>",
        "<!ENTITY a 'b'>",
        "&#x0;",
        "&lt;",
    ]
)


@sized(2000, 60)
@given(st.lists(st.tuples(st.integers(0, len(TWO)), st.integers(0, 12), PIECES), min_size=1, max_size=4))
def test_broken_texts_are_read_or_refused_with_a_place(cuts):
    text = TWO
    for at, length, piece in cuts:
        text = text[:at] + piece + text[at + length :]
    with at_most(CALLS):
        try:
            lg.loads(text, name="broken.urdf")
        except ParseError as error:
            assert error.place is not None and error.place.line is not None
        except ModelError as error:
            assert error.place is not None


@sized(1000, 30)
@given(st.text("ab<>/='\"&!?[]-: \n\x00é", max_size=60))
def test_any_text_after_the_first_sign_is_read_or_refused(text):
    with at_most(CALLS), pytest.raises(ModelError):
        lg.loads("<" + text)
