"""What docs/constraints.md says runs as it stands there."""

import matplotlib
import pytest

import lagrangian as lg
from test_docs import blocks

matplotlib.use("Agg")


@pytest.fixture(scope="module")
def names(tmp_path_factory: pytest.TempPathFactory) -> dict[str, object]:
    found: dict[str, object] = {}
    code = "\n".join(blocks("docs/constraints.md", "python"))
    exec(compile(code, "docs/constraints.md", "exec"), found)
    return found


@pytest.mark.slow
def test_the_guide_to_constraints_runs(names: dict[str, object]) -> None:
    run, lam, d = names["run"], names["lam"], names["d"]
    assert run.success and run.notices[0].code == "E303"  # type: ignore[attr-defined]
    assert set(lam) == {"loop.x", "loop.y"}  # type: ignore[call-overload]
    assert len(d.minimal.equations) == 2  # type: ignore[attr-defined]


@pytest.mark.slow
def test_what_the_comments_of_the_guide_say_is_so(names: dict[str, object]) -> None:
    pendulum, sleigh, dyn = names["pendulum"], names["sleigh"], names["dyn"]
    assert str(pendulum.derive().constraints.verdict) == "holonomic: #GC = #DDOF = 1"  # type: ignore[attr-defined]
    assert str(sleigh.derive().constraints.verdict).startswith("nonholonomic by 1")  # type: ignore[attr-defined]
    assert names["down"]["no slip"] == pytest.approx(-1.118, abs=5e-4)  # type: ignore[index]
    assert len(dyn.assemblies({"crank": 1.0}, fixed="crank")) == 2  # type: ignore[attr-defined]


@pytest.mark.slow
def test_the_reactions_of_the_guide_balance(names: dict[str, object]) -> None:
    pin, swing = names["pin"], names["swing"]
    assert (pin.force.shape, pin.on, pin.at) == ((1001, 2), "rod 2", "B")  # type: ignore[attr-defined]
    assert swing.reaction("B", on="rod 1").force == pytest.approx(-pin.force)  # type: ignore[attr-defined]
    assert not names["run"].powers["loop"].any()  # type: ignore[attr-defined]


def test_the_guides_file_is_read() -> None:
    (text,) = blocks("docs/constraints.md", "toml")
    coordinates = '[coordinates]\nx = ""\ny = ""\ntheta = ""\n[parameters]\nl = 1\nm = 1\n'
    points = '[points]\nP = ["x", "y"]\ncontact = ["x", "y - l"]\n[[frame]]\nname = "sled"\nangle = "theta"\n'
    body = '[[rigid_body]]\nname = "disc"\nmass = "m"\ninertia = "m"\nat = "P"\n'
    head = f'name = "sled"\n{coordinates}{points}{body}frame = "sled"\n'
    model = lg.loads(head + text).model
    assert [e.name for e in model.constraints] == ["rod", "blade", "no slip"]
