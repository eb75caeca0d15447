"""The wheel in an empty environment: TORON_WHEEL names it."""

import os
import re
import subprocess
import venv
from pathlib import Path
from zipfile import ZipFile

import pytest

ROOT = Path(__file__).parents[2]
WHEEL = os.environ.get("TORON_WHEEL")

PROGRAM = """
import numpy as np, toron
yarn = toron.Hyperelastic.from_preset("kevlar-km2-600", units="mm-tonne-s")
print(toron.__file__)
print(*yarn.stress(np.diag([1.02, 1.0, 0.8])).round(2))
"""


@pytest.mark.skipif(WHEEL is None, reason="TORON_WHEEL is not set")
def test_the_licences_come_with_it():
    """Their texts to the letter, and the notices of what the library is linked with, where they are written."""
    with ZipFile(WHEEL) as wheel:
        (metadata,) = (name for name in wheel.namelist() if name.endswith(".dist-info/METADATA"))
        found = {Path(name).name: wheel.read(name) for name in wheel.namelist() if ".dist-info/licenses/" in name}
        declared = re.findall("^License-File: (.*)$", wheel.read(metadata).decode(), flags=re.MULTILINE)
    texts = [ROOT / "LICENSE-MIT", ROOT / "LICENSE-APACHE", *ROOT.glob("THIRD-PARTY.md")]
    assert found == {text.name: text.read_bytes() for text in texts} and sorted(declared) == sorted(found)
    assert not any((ROOT / "python" / text.name).exists() for text in texts)


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
