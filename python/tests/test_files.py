"""Presets in files: what `toron fit` writes is read, in the units of the model; what is wrong in a file is named with it."""

from fractions import Fraction
from pathlib import Path

import pytest

import toron

#: As `toron fit examples/identification/yarn.toml` writes it.
FITTED = """\
name = "kevlar-identified"
source = "Kevlar KM2 600, all data"
units = "mm-tonne-s"
law = "hyperelastic"
density = 1.3514e-9

[properties]
k_el = 82447.03711796744 # 95 %: 80693 to 84201
k_tc = 992.6337758009312 # 95 %: 818.13 to 1204.4
p = 2.177189511216282 # 95 %: 2.0932 to 2.2612
k_td = 630.6996040653812 # 95 %: 593.8 to 667.6
eps_lim = 0.045635661473110205 # 95 %: 0.045196 to 0.046075
alpha = 1.7652840038098718 # 95 %: 1.6818 to 1.8487
beta = 0.0
"""
LAWS = {
    "kevlar-km2-600": toron.Hyperelastic,
    "kevlar-km2-600-linear": toron.LinearElastic,
    "kevlar-km2-600-frictional": toron.Frictional,
}
NAMES = {toron.Hyperelastic: "hyperelastic", toron.LinearElastic: "linear-elastic", toron.Frictional: "frictional"}
UNITS = ("si", "mm-tonne-s", "mm-kg-ms", "cm-g-us", "um-mg-ns", "in-slinch-s", "ft-slug-ms")


@pytest.fixture
def write(tmp_path):
    def make(text: str | bytes) -> Path:
        path = tmp_path / "my-yarn.toml"
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return make


def test_what_fit_writes_is_read_to_the_bit(write):
    path = write(FITTED)
    for name in (path, str(path), bytes(path)):
        yarn = toron.Hyperelastic.from_file(name, units="mm-tonne-s")
        found = dict(yarn.properties)
        assert (found["k_el"], found["k_tc"], found["p"]) == (82447.03711796744, 992.6337758009312, 2.177189511216282)
        assert (found["beta"], found["k_ld"], found["m_1"], yarn.density) == (0.0, 0.0, 1.0, 1.3514e-9)


def test_units_are_converted_with_one_rounding(write):
    path = write(FITTED)
    si = toron.Hyperelastic.from_file(path, "si")
    assert (si.properties["k_el"], si.properties["p"], si.density) == (82447.03711796744 * 1e6, 2.177189511216282, 1.3514e-9 * 1e12)
    inches = toron.Hyperelastic.from_file(path, "in-slinch-s")
    # A slinch is a pound force s²/in, so that the stress is in pounds by square inch.
    psi = Fraction("0.45359237") * Fraction("9.80665") / Fraction("0.0254") ** 2
    assert inches.properties["k_el"] == pytest.approx(float(Fraction(82447.03711796744) * 10**6 / psi), rel=1e-15)


@pytest.mark.parametrize("own", UNITS)
@pytest.mark.parametrize("preset", LAWS)
def test_a_file_in_any_units_is_the_preset_in_any_others(write, preset, own):
    kind = LAWS[preset]
    law = kind.from_preset(preset, own)
    dimension = {row.name: row.unit for row in kind.properties_table()}
    given = "".join(f"{name} = {value!r}\n" for name, value in law.properties.items())
    path = write(f'units = "{own}"\nlaw = "{NAMES[kind]}"\ndensity = {law.density!r}\n[properties]\n{given}')
    for units in UNITS:
        expected, found = kind.from_preset(preset, units), kind.from_file(path, units)
        assert found.density == pytest.approx(expected.density, rel=1e-15)
        for property, value in found.properties.items():
            assert value == pytest.approx(expected.properties[property], rel=1e-15, abs=0), (property, dimension[property], units)
        assert own != units or found == law


def test_what_a_file_leaves_open(write):
    path = write('units = "si"\n[properties]\nk_el = 82e9\np = 2\n')
    with pytest.raises(toron.PropertyError, match=r"my-yarn.toml: property k_tc \(transverse.*\) is missing; allowed: a number from 0"):
        toron.Hyperelastic.from_file(path, "mm-tonne-s")
    yarn = toron.Hyperelastic.from_file(path, "mm-tonne-s", k_tc=1000.0, k_td=650.0, m_1=0.0, m_2=1.0, p=2.5)
    assert dict(yarn.properties) | {"k_el": 82e3, "k_tc": 1000.0, "k_td": 650.0, "p": 2.5, "m_2": 1.0} == yarn.properties
    assert yarn.density is None
    assert toron.Hyperelastic.from_file(path, "si", k_tc=1e9, k_td=1e9, density=1351.0).density == 1351.0
    with pytest.raises(toron.PropertyError, match="^(?!.*my-yarn).*k_td.*-1"):
        toron.Hyperelastic.from_file(path, "si", k_tc=1e9, k_td=-1.0)


YARN = 'units = "si"\n[properties]\n'
WRONG = {
    "key": ('units = "si"\ncolour = 3', "key 'colour' is unknown; allowed: name, source, units"),
    "no units": ('name = "a"', "units is missing"),
    "units": ('units = "mm"', 'system of units "mm".*length-mass-time'),
    "units that are a number": ("units = 3", "units is 3; allowed: text in quotes"),
    "units with a null": ('units = "si\\u0000"', r"units is 'si\\x00'"),
    "name": ('units = "si"\nname = 3', "name is 3; allowed: text in quotes"),
    "law": ('units = "si"\nlaw = "elastic"', "law is 'elastic'; allowed: hyperelastic or linear-elastic or frictional"),
    "law that is a list": ('units = "si"\nlaw = ["hyperelastic"]', "law is .'hyperelastic'.; allowed: hyperelastic or"),
    "other law": ('units = "si"\nlaw = "linear-elastic"', "law is 'linear-elastic'; allowed: 'hyperelastic' for this class"),
    "density": ('units = "si"\ndensity = 0', "density is 0; allowed: a finite number > 0"),
    "density that is inf": ('units = "si"\ndensity = inf', "density is inf; allowed: a finite number > 0"),
    "density that is true": ('units = "si"\ndensity = true', "density is True; allowed: a finite number > 0"),
    "properties": ('units = "si"\nproperties = 3', "properties is 3; allowed: a table"),
    "property": (YARN + "k_elast = 3", "property 'k_elast' is unknown; allowed: k_el k_tc p k_td"),
    "text": (YARN + 'p = "2"', r"property p \(.*\) is '2'; allowed: a number > 1"),
    "value": (YARN + "k_tc = -3.0", r"property k_tc \(transverse compaction stiffness\) is -3.0; allowed: a number from 0 to 1e25"),
    "excluded value": (YARN + "p = 1", r"property p \(.*\) is 1; allowed: a number > 1"),
    "NaN": (YARN + "k_el = nan", r"property k_el \(.*\) is nan"),
    "huge": (YARN + f"k_el = {10**400}", r"property k_el \(.*\) is 10000.*…; allowed"),
    "direction": (YARN + "k_el = 1\nk_tc = 1\np = 2\nk_td = 1\nm_1 = 0", "fibre direction"),
    "twice": (YARN + "p = 2\np = 3", "no TOML: Cannot overwrite"),
    "syntax": ("units = \n", "no TOML: .*line 1"),
    "nested": ("a = " + 20000 * "[", "no TOML"),
    "no text": (b"\xff\xfe", "cannot be read"),
}


@pytest.mark.parametrize("text,message", WRONG.values(), ids=WRONG)
def test_what_is_wrong_in_a_file_is_named_with_it(write, text, message):
    path = write(text)
    with pytest.raises(toron.Error, match=message) as caught:
        toron.Hyperelastic.from_file(path, "mm-tonne-s")
    assert str(caught.value).startswith(f"{path}: ") and isinstance(caught.value, ValueError)


def test_files_that_are_none(write, tmp_path):
    for path, message in (
        (tmp_path / "none.toml", "none.toml: the file cannot be read: No such file or directory"),
        (tmp_path, "the file cannot be read: Is a directory"),
        ("a\0b", "the file cannot be read: embedded null"),
        (3, "path is 3; allowed: the path of a preset's file"),
        (None, "path is None"),
    ):
        with pytest.raises(toron.ArgumentError, match=message):
            toron.Hyperelastic.from_file(path, "si")
    with pytest.raises(toron.ArgumentError, match="^(?!.*my-yarn).*furlong"):
        toron.Hyperelastic.from_file(write(FITTED), "furlong-kg-s")
    with pytest.raises(toron.ArgumentError, match="law is -1"):
        toron.Law.from_file(write(FITTED), "si")
