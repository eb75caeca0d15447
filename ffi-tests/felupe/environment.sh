#!/bin/sh
# Makes a Python environment with felupe in the cache folder, unless it is there, and prints the path of its Python.
set -eu
requirements="$(dirname "$0")/requirements.txt"
cache="${XDG_CACHE_HOME:-$HOME/.cache}/toron/felupe-$(cksum <"$requirements" | cut -d ' ' -f 1)"
if [ ! -f "$cache/complete" ]; then
    echo "installing felupe" >&2
    if ! { python3 -m venv --clear "$cache" && "$cache/bin/pip" install -q -r "$requirements"; } >&2; then
        echo "felupe cannot be installed: run ./test.sh, which installs python3-venv (Debian, Ubuntu)" >&2
        exit 1
    fi
    touch "$cache/complete"
fi
echo "$cache/bin/python"
