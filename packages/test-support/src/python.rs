//! The Python package, made with the library as released, for its own tests and for programs that use it in solvers.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{LazyLock, Mutex};

use super::library::{LIBRARY, ROOT, folder, run};

/// The Python of an environment with what `requirements.txt` in this folder lists. It is made if it is not there.
pub fn environment(requirements: &Path) -> PathBuf {
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    let _guard = ONE_AT_A_TIME.lock();
    let mut script = Command::new(Path::new(ROOT).join("ffi-tests/python/environment.sh"));
    let output = run(script.arg(requirements.join("requirements.txt")), "python3-venv");
    PathBuf::from(String::from_utf8(output.stdout).expect("a path").trim())
}

/// The wheel of the package, and the folder to which it is installed.
pub static PACKAGE: LazyLock<[PathBuf; 2]> = LazyLock::new(|| {
    let python = environment(&Path::new(ROOT).join("python/tests"));
    let made = folder("python");
    let mut script = Command::new(Path::new(ROOT).join("ffi-tests/python/package.sh"));
    let output = run(script.arg(python).arg(LIBRARY.join("libtoron.so")).arg(&made), "python3-venv");
    [PathBuf::from(String::from_utf8(output.stdout).expect("a path").trim()), made.join("site")]
});

/// What a program of `ffi-tests/` prints, in the environment of its folder.
pub fn program(name: &str, arguments: &[&str]) -> String {
    let path = Path::new(ROOT).join("ffi-tests").join(name);
    let python = environment(path.parent().expect("a folder"));
    let mut program = Command::new(python);
    let output = run(program.arg(&path).args(arguments).env("PYTHONPATH", &PACKAGE[1]), "python3");
    String::from_utf8(output.stdout).expect("numbers")
}
