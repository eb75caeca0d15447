"""The wheel in an empty environment: TORON_WHEEL names it."""

import os
import subprocess
import venv
from pathlib import Path

import pytest

WHEEL = os.environ.get("TORON_WHEEL")

PROGRAM = """
import numpy as np, toron
yarn = toron.Hyperelastic.from_preset("kevlar-km2-600", units="mm-tonne-s")
print(toron.__file__)
print(*yarn.stress(np.diag([1.02, 1.0, 0.8])).round(2))
"""


@pytest.mark.skipif(WHEEL is None, reason="TORON_WHEEL is not set")
def test_in_an_empty_environment(tmp_path):
    wheel = Path(WHEEL)
    assert wheel.name.split("-")[2:4] == ["py3", "none"] and not wheel.name.endswith("any.whl")
    home = tmp_path / "environment"
    venv.create(home, with_pip=True)
    python = str(home / "bin/python")
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "TORON"))}
    subprocess.run([python, "-m", "pip", "install", "-q", str(wheel)], env=clean, check=True)
    output = subprocess.run([python, "-c", PROGRAM], cwd=tmp_path, env=clean, check=True, capture_output=True, text=True).stdout
    where, stress = output.splitlines()
    assert Path(where).is_relative_to(home) and stress.startswith("1998.25 -57.91 -146.75")
