"""What docs/fit.md says runs as it stands there."""

import pathlib
import re

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).parents[1]


@pytest.mark.slow
def test_the_manuals_python_runs() -> None:
    text = (ROOT / "docs" / "fit.md").read_text(encoding="utf-8")
    code = "\n".join(re.findall(r"^```python\n(.*?)^```", text, flags=re.M | re.S))
    names: dict[str, object] = {}
    exec(compile(code, "docs/fit.md", "exec"), names)
    sensitivities = names["s"]
    assert np.shape(sensitivities["theta2"]) == (301, 3)  # type: ignore[index]
    found = names["found"]
    for name, value in {"m2": 0.8, "L1": 1.1, "theta1": 0.7, "theta2": 0.4}.items():
        assert abs(found.estimate[name] - value) < 4 * found.std[name]  # type: ignore[attr-defined]
    assert [x.names for x in names["every"].undetermined] == [("m1", "m2"), ("L1", "L2", "g")]  # type: ignore[attr-defined]
    assert names["best"].success  # type: ignore[attr-defined]
    assert abs(names["again"]["theta"][-1]) < 1e-4  # type: ignore[index]
    assert names["tuned"].cost < names["tuned"].first_cost  # type: ignore[attr-defined]
