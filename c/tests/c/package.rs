//! The Python package passes its own tests, `python/tests`.

use std::path::Path;
use std::process::Command;

use toron_test_support::library::{ROOT, run};
use toron_test_support::python::{PACKAGE, environment};

#[test]
fn the_package_passes_its_tests() {
    let tests = Path::new(ROOT).join("python/tests");
    let python = environment(&tests);
    let wheels = python.ancestors().nth(2).expect("an environment").join("wheels");
    let mut pytest = Command::new(&python);
    pytest.args(["-m", "pytest", "-q", "-p", "no:cacheprovider"]).arg(&tests);
    // The environment of the wheel's test is made without a network.
    pytest.env("PYTHONPATH", &PACKAGE[1]).env("TORON_WHEEL", &PACKAGE[0]);
    pytest.env("PYTHONDONTWRITEBYTECODE", "1").env("PIP_NO_INDEX", "1").env("PIP_FIND_LINKS", wheels);
    let output = run(&mut pytest, "python3");
    let text = String::from_utf8_lossy(&output.stdout);
    println!("{text}");
    assert!(!text.contains("skipped"), "{text}");
}
