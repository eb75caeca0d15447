"""Builds the shared library with cargo, or takes the one that TORON_LIBRARY names, and makes a wheel for any Python of the platform.

A source distribution has the crates of the library, as they are published, in a folder `rust` of its own.
"""

import json
import os
import shutil
import subprocess
import sys
import tarfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.bdist_wheel import bdist_wheel
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
# Where the crate `toron` is: in a source distribution, or in the repository.
ROOT = HERE / "rust/toron" if (HERE / "rust").is_dir() else HERE.parent
CRATES = ["toron", "toron-c-functions", "toron-c"]
sys.path.insert(0, str(HERE))

import interface  # noqa: E402


def version() -> str:
    """The version of the library."""
    for line in (ROOT / "Cargo.toml").read_text(encoding="utf-8").splitlines():
        if line.startswith("version = "):
            return line.split('"')[1]
    sys.exit("Cargo.toml has no version")


def need_cargo(otherwise: str) -> None:
    """Ends where there is no cargo."""
    if not shutil.which("cargo"):
        sys.exit(
            "The package contains a library in Rust, and cargo, which builds it, is not installed. Install Rust 1.89 or later "
            f"(https://rustup.rs){otherwise}."
        )


def shared_library() -> Path:
    """The library to be packed."""
    given = os.environ.get("TORON_LIBRARY")
    if given:
        if not Path(given).is_file():
            sys.exit(f"TORON_LIBRARY is {given}, which is no file; allowed: the absolute path of a libtoron.so that has been built")
        return Path(given)
    need_cargo(", or set TORON_LIBRARY to a libtoron.so that has been built")
    command = ["cargo", "build", "--release", "--locked", "-p", "toron-c", "--message-format=json-render-diagnostics"]
    built = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, check=False)
    if built.returncode != 0:
        sys.exit("cargo build failed")
    for line in built.stdout.splitlines():
        message = json.loads(line)
        if message.get("reason") == "compiler-artifact" and "cdylib" in message["target"]["crate_types"]:
            for name in map(Path, message["filenames"]):
                if name.suffix in (".so", ".dylib", ".dll"):
                    return name
    sys.exit("cargo has built no shared library")


@contextmanager
def licences() -> Iterator[None]:
    """Puts the licence texts, which stand at the root of the repository, beside this file while the wheel is built: those of the package,
    and the notices of what the library has from others.
    """
    texts = [ROOT / "LICENSE-MIT", ROOT / "LICENSE-APACHE", *ROOT.glob("THIRD-PARTY.md")]
    for text in texts:
        shutil.copyfile(text, HERE / text.name)
    try:
        yield
    finally:
        for text in texts:
            (HERE / text.name).unlink()


class BuildWithLibrary(build_py):
    """Adds the library and the module made from its header."""

    def run(self) -> None:
        if not self.editable_mode:
            # Of an earlier build, with modules that may be no more.
            shutil.rmtree(Path(self.build_lib) / "toron", ignore_errors=True)
        super().run()
        package = HERE / "src/toron" if self.editable_mode else Path(self.build_lib) / "toron"
        interface.write(ROOT / "include/toron.h", package / "_interface.py")
        shutil.copyfile(shared_library(), package / "libtoron.so")


def crates(folder: Path) -> None:
    """Writes the crates of the library and a workspace for them."""
    need_cargo("")
    packages = [option for crate in CRATES for option in ("--package", crate)]
    subprocess.run(["cargo", "package", "--quiet", "--no-verify", "--locked", *packages], cwd=ROOT, check=True)
    metadata = subprocess.run(["cargo", "metadata", "--no-deps", "--format-version=1"], cwd=ROOT, stdout=subprocess.PIPE, check=True)
    packed = Path(json.loads(metadata.stdout)["target_directory"]) / "package"
    for crate in CRATES:
        with tarfile.open(packed / f"{crate}-{version()}.crate") as archive:
            archive.extractall(folder, filter="data")
        (folder / f"{crate}-{version()}").rename(folder / crate)
    # Of each crate its own; one for all of them is at the workspace.
    (folder / "toron-c/Cargo.lock").replace(folder / "Cargo.lock")
    paths = "".join(f'{crate} = {{ path = "{crate}" }}\n' for crate in CRATES[:-1])
    workspace = f"[workspace]\nresolver = \"3\"\nmembers = {json.dumps(CRATES)}\n\n[patch.crates-io]\n{paths}"
    workspace += '\n[profile.release]\nlto = "off"\n'
    (folder / "Cargo.toml").write_text(workspace, encoding="utf-8")
    subprocess.run(["cargo", "update", "--quiet", "--workspace"], cwd=folder, check=True)


class SourceDistribution(sdist):
    """Adds what setup.py needs beside it: the crates, and what reads the header."""

    def make_release_tree(self, base_dir: str, files: list[str]) -> None:
        # The tests are those of a repository.
        super().make_release_tree(base_dir, [file for file in files if not file.startswith("tests/")])
        shutil.copyfile(HERE / "interface.py", Path(base_dir) / "interface.py")
        if (HERE / "rust").is_dir():
            shutil.copytree(HERE / "rust", Path(base_dir) / "rust", ignore=shutil.ignore_patterns("target"))
        else:
            (Path(base_dir) / "rust").mkdir()
            crates(Path(base_dir) / "rust")


class PlatformWheel(bdist_wheel):
    """The wheel depends on the platform, but not on the version of Python."""

    def get_tag(self) -> tuple[str, str, str]:
        return "py3", "none", super().get_tag()[2]


class WithLibrary(Distribution):
    def has_ext_modules(self) -> bool:
        return True


with licences():
    commands = {"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel, "sdist": SourceDistribution}
    setup(version=version(), distclass=WithLibrary, cmdclass=commands)
