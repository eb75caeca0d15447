#!/bin/sh
# Makes the wheel of the package with a library that has been built, and installs it to FOLDER/site; prints the path of the wheel.
# PYTHON has setuptools, cffi and pip. The wheel is made of a copy of the sources, in which nothing of an earlier build is left.
set -eu
[ $# -eq 3 ] || { echo "usage: package.sh PYTHON libtoron.so FOLDER" >&2; exit 2; }
root="$(cd "$(dirname "$0")/../.." && pwd)"
rm -rf "$3/source" "$3/site" "$3/wheel"
mkdir -p "$3/source/python"
cp -r "$root/python/src" "$root/python"/*.py "$root/python/pyproject.toml" "$root/python/README.md" "$3/source/python"
cp -r "$root/include" "$root/Cargo.toml" "$root"/LICENSE-* "$3/source"
[ ! -f "$root/THIRD-PARTY.md" ] || cp "$root/THIRD-PARTY.md" "$3/source"
rm -f "$3/source/python/src/toron/libtoron.so" "$3/source/python/src/toron/_interface.py"
TORON_LIBRARY="$2" "$1" -m pip wheel -q --no-deps --no-build-isolation -w "$3/wheel" "$3/source/python" >&2
"$1" -m pip install -q --no-deps --no-index --target "$3/site" "$3/wheel"/toron_yarn-*.whl >&2
echo "$3"/wheel/toron_yarn-*.whl
