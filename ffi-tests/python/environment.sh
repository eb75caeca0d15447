#!/bin/sh
# Makes a Python environment with the packages of a requirements file in the cache folder, unless it is there, and prints the path
# of its Python. Its wheels stay beside it, so that other environments can be made of them without a network.
set -eu
[ $# -eq 1 ] && [ -f "$1" ] || { echo "usage: environment.sh requirements.txt" >&2; exit 2; }
cache="${XDG_CACHE_HOME:-$HOME/.cache}/toron/python-$(cat "$0" "$1" | cksum | cut -d ' ' -f 1)"
if [ ! -f "$cache/complete" ]; then
    echo "installing what $1 lists" >&2
    if ! {
        python3 -m venv --clear "$cache" &&
            "$cache/bin/pip" wheel -q -w "$cache/wheels" -r "$1" &&
            "$cache/bin/pip" install -q --no-index --find-links "$cache/wheels" -r "$1"
    } >&2; then
        echo "what $1 lists cannot be installed: run ./test.sh, which installs python3-venv (Debian, Ubuntu)" >&2
        exit 1
    fi
    touch "$cache/complete"
fi
echo "$cache/bin/python"
