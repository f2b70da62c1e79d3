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
