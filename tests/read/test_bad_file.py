"""Model files that are wrong: what the message says, the line and the column it points at."""

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from effort import at_most
from lagrangian.errors import ModelError, ParseError
from lagrangian.read import MAX_BYTES, decode, load, loads
from size import sized

GOOD = """name = "cart"

[coordinates]
x = "cart, from the wall"

[parameters]
m = "1 kg"
k = "40 N/m"

[inputs]
F = "N, on the cart"

[points]
A = ["x", "0"]

[[particle]]
name = "cart"
mass = "m"
at = "A"

[[spring]]
k = "k"
deflection = "x"
"""


CALLS = 10_000_000
"""Of Python functions, that any one of these takes at most."""


def change(old: str, new: str) -> str:
    assert old in GOOD
    return GOOD.replace(old, new, 1)


BAD = [
    # what, text, line, column, fragments
    ("empty", "", 1, 1, ["empty", "lagrangian new pendulum"]),
    ("only comments", "# nothing\n\n", 1, 1, ["empty"]),
    ("no name", GOOD.removeprefix('name = "cart"'), 1, 1, ["the field 'name' is missing"]),
    ("empty name", change('name = "cart"', 'name = ""'), 1, 8, ["name of the system is empty"]),
    ("truncated text", GOOD[: GOOD.index("40 N/m") + 3], 8, None, ["not TOML"]),
    ("truncated list", GOOD[: GOOD.index('"0"]')], 14, None, ["not TOML", "ends too early"]),
    ("truncated header", GOOD + "[[partic", 24, None, ["not TOML"]),
    ("no value", change('m = "1 kg"', "m ="), 7, 4, ["not TOML", "write a value"]),
    ("no quotes", change('k = "40 N/m"', "k = 40 N/m"), 8, None, ["not TOML"]),
    ("unquoted name", change('m = "1 kg"', "m = kg"), 7, 5, ["not TOML", 'put text in quotes: "kg"']),
    ("decimal comma bare", change('m = "1 kg"', "m = 1,5"), 7, None, ["not TOML"]),
    ("decimal comma", change("1 kg", "1,5 kg"), 7, 7, ["parameter 'm'", "cannot read '1,5' as a number", "1.5"]),
    ("unknown unit", change("1 kg", "1 kgg"), 7, 8, ["parameter 'm'", "unknown unit 'kgg'", "Did you mean 'kg'?"]),
    ("no number", change("1 kg", "kg"), 7, 6, ["number is expected first"]),
    ("empty quantity", change("1 kg", ""), 7, 6, ["empty"]),
    ("nan text", change('"1 kg"', '"nan"'), 7, 6, ["finite number (got nan)", "E101"]),
    ("nan", change('"1 kg"', "nan"), 7, 5, ["'m' must be a finite number (got nan)", "E101"]),
    ("inf", change('"1 kg"', "-inf"), 7, 5, ["must be a finite number (got -inf)"]),
    ("true", change('"1 kg"', "true"), 7, 5, ["'m' must be", "got true or false"]),
    ("date", change('"1 kg"', "2020-01-01"), 7, 5, ["got a date or time"]),
    ("list for number", change('"1 kg"', "[1]"), 7, 5, ["parameter 'm'", "(got a list)"]),
    ("huge integer", change('"1 kg"', "9" * 5000), 7, 5, ["too many digits"]),
    ("number for text", change('x = "cart, from the wall"', "x = 3"), 4, 5, ["coordinate 'x'", "(got a number)"]),
    ("unit twice", change('"1 kg"', '{ value = "1 kg", unit = "g" }'), 7, 30, ["unit is given twice"]),
    ("unknown unit in table", change('"1 kg"', '{ value = 1, unit = "kgg" }'), 7, 26, ["unknown unit 'kgg'"]),
    (
        "unknown section",
        GOOD + "[[sprin]]\nk = 1\n",
        24,
        1,
        ["unknown field 'sprin'", "Did you mean 'spring'?", "E405"],
    ),
    (
        "unknown key",
        change("mass = ", "masss = "),
        18,
        1,
        ["particle 'cart'", "unknown field 'masss'", "Did you mean 'mass'?"],
    ),
    ("unknown key in point", change('["x", "0"]', '{ ofset = ["x", "0"] }'), 14, 7, ["point 'A'", "'offset'?"]),
    ("missing key", change('mass = "m"\n', ""), 16, 1, ["particle 'cart'", "the field 'mass' is missing"]),
    ("single bracket", change("[[spring]]", "[spring]"), 21, 2, ["array of tables", "[[spring]] with two brackets"]),
    (
        "duplicate key",
        change('k = "40 N/m"', 'm = "2 kg"'),
        8,
        1,
        ["'parameters.m' is given twice (line 7, line 8)", "E404"],
    ),
    ("duplicate section", GOOD + "[points]\n", 24, 2, ["'points' is given twice (line 13, line 24)"]),
    ("duplicate name", change("F = ", "m = "), 11, 1, ["'m' is defined twice", "line 7", "E404"]),
    (
        "duplicate element",
        GOOD + '[[particle]]\nname = "cart"\nmass = 1\nat = "A"\n',
        24,
        1,
        ["'cart' is taken", "line 16"],
    ),
    ("reserved name", change('x = "cart', 'pi = "cart'), 4, 1, ["'pi' is reserved", "E403"]),
    ("reserved function", change('x = "cart', 'sin = "cart'), 4, 1, ["'sin' is reserved"]),
    ("name no identifier", change('x = "cart', '"a;b" = "cart'), 4, 1, ["not an identifier", "E702"]),
    ("name with newline", change('x = "cart', '"a\\nb" = "cart'), 4, 1, ["not an identifier"]),
    ("name with quotes", change('x = "cart', "'\"; rm -rf' = \"cart"), 4, 1, ["not an identifier"]),
    ("long name", change('x = "cart', "x" * 100 + ' = "cart'), 4, 1, ["100 characters"]),
    ("look-alikes", change('k = "40', '"х" = "40'), 8, 1, ["look alike", "line 4"]),
    (
        "greek and spelled",
        change('m = "1 kg"', 'θ1 = "1 kg"'.replace("θ1", '"θ1"') + '\ntheta1 = "1 kg"'),
        8,
        1,
        ["look alike"],
    ),
    (
        "unknown symbol",
        change('mass = "m"', 'mass = "2*mm"'),
        18,
        11,
        ["mass of particle 'cart'", "unknown symbol 'mm'"],
    ),
    ("misspelled", change('k = "k"', 'k = "kk*2"'), 22, 6, ["k of spring", "unknown symbol 'kk'", "Did you mean 'k'?"]),
    ("value with unit", change('mass = "m"', 'mass = "1 kg"'), 18, 11, ["value with a unit", "[parameters]"]),
    ("hostile", change('mass = "m"', "mass = \"__import__('os').system('true')\""), 18, 20, ["text in quotes", "E701"]),
    ("attribute", change('mass = "m"', 'mass = "m.real"'), 18, 10, ["attribute access"]),
    ("lambda", change('mass = "m"', 'mass = "lambda x: x"'), 18, 9, ["lambda"]),
    ("power tower", change('mass = "m"', 'mass = "9**9**9"'), 18, 9, ["exponent is too large"]),
    ("deep", change('mass = "m"', f'mass = "{"(" * 60}m{")" * 60}"'), 18, 59, ["nested more than 50 deep"]),
    ("escape before the error", change('mass = "m"', 'mass = "\\u006d*mm"'), 18, 16, ["unknown symbol 'mm'"]),
    ("second line of a text", change('mass = "m"', 'mass = """\nm +\n  mm"""'), 20, 3, ["unknown symbol 'mm'"]),
    ("unknown point", change('at = "A"', 'at = "AA"'), 19, 6, ["unknown point 'AA'", "Did you mean 'A'?", "E412"]),
    (
        "unknown point in between",
        GOOD + '[[spring]]\nk = 1\nbetween = ["A", "Q"]\n',
        26,
        17,
        ["unknown point 'Q'", "known: origin, A"],
    ),
    ("same point twice", GOOD + '[[spring]]\nk = 1\nbetween = ["A", "A"]\n', 24, 1, ["same point", "E410"]),
    ("unknown frame", change('["x", "0"]', '{ frame = "B", offset = ["x", "0"] }'), 14, 15, ["unknown frame 'B'"]),
    ("point of one component", change('["x", "0"]', '["x"]'), 14, 5, ["point 'A'", "1 entry", "at least 2"]),
    ("point of four components", change('["x", "0"]', "[1, 2, 3, 4]"), 14, 5, ["4 entries", "at most 3"]),
    ("mixed dimensions", change('["x", "0"]', '["x", "0"]\nB = ["x", "0", "0"]'), 15, 1, ["has 3 components", "E414"]),
    ("text for a point", change('["x", "0"]', '"x, 0"'), 14, 5, ["'A' must be a list or a table"]),
    (
        "list in a point",
        change('["x", "0"]', '["x", ["0"]]'),
        14,
        11,
        ["'A' entry 2 must be text or a number (got a list)"],
    ),
    (
        "point in a circle",
        change('["x", "0"]', '{ from = "A", offset = [1, 0] }'),
        14,
        14,
        ["circle", "point 'A' → point 'A'"],
    ),
    (
        "frame in a circle",
        change("[points]", '[[frame]]\nname = "f"\nangle = 0\nparent = "f"\n[points]'),
        16,
        10,
        ["circle: frame 'f' → frame 'f'", "E413"],
    ),
    (
        "definitions in a circle",
        change("[points]", '[define]\nP = "Q"\nQ = "2*P"\n[points]'),
        14,
        5,
        ["circle: P → Q → P", "E413"],
    ),
    ("definition of itself", change("[points]", '[define]\nP = "P + 1"\n[points]'), 14, 5, ["circle: P → P"]),
    (
        "definition too early",
        change("[points]", '[define]\nP = "Q"\nQ = "x"\n[points]'),
        14,
        5,
        ["'Q', which is defined after it"],
    ),
    ("rate in a point", change('"x", "0"', '"x\'", "0"'), 14, 1, ["contains a rate", "E308"]),
    ("rate in V", GOOD + '[energies]\nV = "m*x\'^2"\n', 25, 1, ["potential energy V contains a rate", "E419"]),
    ("acceleration in T", GOOD + "[energies]\nT = \"m*x''\"\n", 25, 1, ["acceleration", "E418"]),
    (
        "mass that moves",
        change('mass = "m"', 'mass = "m*x"'),
        16,
        1,
        ["particle 'cart'", "depends on the coordinate", "E419"],
    ),
    ("no k", change('k = "k"\n', ""), 21, 1, ["exactly one of k, law and energy", "E416"]),
    ("force on nothing", GOOD + '[[force]]\nvalue = "F"\n', 24, 1, ["acts on nothing", "E412"]),
    (
        "not a coordinate",
        GOOD + '[[generalized_force]]\ncoordinate = "m"\nvalue = 1\n',
        25,
        14,
        ["'m' is not a coordinate"],
    ),
    ("Xi of no coordinate", GOOD + "[energies]\nXi = { y = 1 }\n", 25, None, ["'y' is not a coordinate"]),
    (
        "zero axis",
        change("[points]", '[[frame]]\nname = "f"\nangle = 0\naxis = [0, 0, 0]\n[points]'),
        13,
        1,
        ["(0, 0, 0)", "E409"],
    ),
    ("duration", GOOD + '[simulate]\nduration = "10 m"\n', 25, 12, ["expected a time, got 'm'", "E408"]),
    ("negative duration", GOOD + "[simulate]\nduration = -1\n", 25, 12, ["negative"]),
    (
        "initial of no coordinate",
        GOOD + "[simulate]\ninitial = { xx = 1 }\n",
        25,
        13,
        ["no coordinate 'xx'", "Did you mean 'x'?"],
    ),
    ("simulate key", GOOD + "[simulate]\ndurration = 1\n", 25, 1, ["unknown field 'durration'", "'duration'?"]),
    ("deep brackets", "a = " + "[" * 100_000, 1, 17, ["nested more than 12 deep", "E703"]),
    ("deep keys", "a." * 50_000 + "a = 1", 1, 1, ["more than 12 parts"]),
    ("deep tables", "a = " + "{b = " * 50_000, 1, None, ["nested more than 12 deep"]),
    ("control character", change("1 kg", "1 \x01kg"), 7, None, ["not TOML"]),
    ("one file twice", GOOD + GOOD, 26, 2, ["given twice"]),
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("text", "line", "column", "fragments"), [b[1:] for b in BAD], ids=[b[0] for b in BAD])
def test_message_line_and_caret(text: str, line: int | None, column: int | None, fragments: list[str]) -> None:
    with pytest.raises(ModelError) as caught, at_most(CALLS):
        loads(text, "cart.toml")
    message = str(caught.value)
    for fragment in fragments:
        assert fragment in message
    assert message.startswith("cart.toml")
    assert caught.value.fix
    assert caught.value.code
    place = caught.value.place
    assert place is not None
    if line is not None:
        assert place.line == line
        assert place.text == text.split("\n")[line - 1].replace("\x01", " ")
    if column is not None:
        assert place.column == column


def test_the_good_file_is_good() -> None:
    assert loads(GOOD).model().name == "cart"


@pytest.mark.parametrize(
    ("old", "new", "line", "fragments"),
    [
        ("1 kg", "-1 kg", 16, ["mass m = -1 kg is negative", "E102"]),
        ("1 kg", "0 kg", 16, ["zero", "E103"]),
        ('mass = "m"', "mass = -2", 16, ["negative", "E102"]),
    ],
)
def test_masses_are_refused_where_the_body_is_described(old: str, new: str, line: int, fragments: list[str]) -> None:
    with pytest.raises(ModelError) as caught:
        loads(change(old, new), "cart.toml")
    assert all(f in str(caught.value) for f in fragments)
    assert caught.value.place is not None and caught.value.place.line == line


def test_bytes_that_are_no_model_file(tmp_path: Path) -> None:
    cases = [
        (b'name = "a"\nb = "\xff\xfe"\n', "not UTF-8: the byte 0xff", 2, 6),
        ("name = 'ü'".encode("latin-1"), "not UTF-8", 1, 9),
        (GOOD.encode("utf-16"), "zero byte", 1, None),
        (b"\x7fELF\0\0\0", "zero byte", 1, 1),
        (b"#" * (MAX_BYTES + 1), "larger than", None, None),
    ]
    for number, (data, fragment, line, column) in enumerate(cases):
        file = tmp_path / f"{number}.toml"
        file.write_bytes(data)
        with pytest.raises((ParseError, ModelError)) as caught:
            load(file)
        assert fragment in str(caught.value) and str(file) in str(caught.value)
        assert caught.value.place is not None
        if line is not None:
            assert caught.value.place.line == line
        if column is not None:
            assert caught.value.place.column == column


def test_a_byte_order_mark_and_windows_lines_are_read() -> None:
    assert loads(decode(b"\xef\xbb\xbf" + GOOD.replace("\n", "\r\n").encode(), "x")).model().name == "cart"


def test_files_that_cannot_be_opened(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match="no such file"):
        load(tmp_path / "none.toml")
    with pytest.raises(ModelError, match="a folder"):
        load(tmp_path)
    with pytest.raises(ModelError, match="cannot be read"):
        load("a\0b")
    if os.name == "posix" and os.geteuid() != 0:
        closed = tmp_path / "closed.toml"
        closed.write_text(GOOD)
        closed.chmod(0)
        with pytest.raises(ModelError, match="may not be read"):
            load(closed)


def test_a_whole_message() -> None:
    with pytest.raises(ParseError) as caught:
        loads(change('k = "k"', 'k = "2*kk"'), "cart.toml")
    assert str(caught.value) == (
        "cart.toml:22:8: [E402] k of spring: unknown symbol 'kk'\n"
        '22 | k = "2*kk"\n'
        "   |        ^\n"
        "Fix: Did you mean 'k'?"
    )


PIECES = [
    "[",
    "]",
    "[[",
    "]]",
    "{",
    "}",
    "=",
    '"',
    "'",
    '"""',
    "\\",
    "\n",
    "x",
    "m",
    "spring",
    "name",
    "1",
    "nan",
    ".",
    ",",
    " ",
    "#",
    "θ",
]


@sized(200, 40)
@given(
    st.integers(0, len(GOOD)),
    st.integers(0, 12),
    st.one_of(st.text(max_size=10), st.lists(st.sampled_from(PIECES), max_size=8).map("".join)),
)
def test_a_damaged_file_gives_a_description_or_a_model_error(at: int, length: int, inserted: str) -> None:
    text = GOOD[:at] + inserted + GOOD[at + length :]
    try:
        loads(text, "x.toml").model()
    except ModelError as error:
        assert str(error)


@sized(100, 30)
@given(st.binary(max_size=60))
def test_any_bytes_give_a_model_error(data: bytes) -> None:
    with pytest.raises(ModelError):
        loads(decode(data, "x.toml"), "x.toml")
