#!/bin/sh
# The law in FEniCSx, with one process and with two: `run.sh [libtoron.so]`. Needs Debian's or Ubuntu's package python3-dolfinx-real and
# its 249 dependencies, which nothing else in this repository uses, and is therefore not part of ./test.sh.
set -eu
here="$(cd "$(dirname "$0")" && pwd)"
root="$here/../.."
python=/usr/bin/python3
if ! "$python" -c 'import dolfinx, cffi' 2>/dev/null || ! command -v mpirun >/dev/null; then
    echo "please install: apt-get install --no-install-recommends python3-dolfinx-real python3-cffi" >&2
    exit 1
fi
library="${1:-}"
if [ -z "$library" ]; then
    (cd "$root" && cargo build --release --locked -p toron-c)
    library="${CARGO_TARGET_DIR:-$root/target}/release/libtoron.so"
fi
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
"$root/ffi-tests/python/package.sh" "$("$root/ffi-tests/python/environment.sh" "$root/python/tests/requirements.txt")" "$library" "$work" >/dev/null
export PYTHONPATH="$work/site" OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
for processes in 1 2; do
    mpirun --oversubscribe -n "$processes" "$python" "$here/press.py" >"$work/$processes.txt" 2>"$work/log" || { cat "$work/log" >&2; exit 1; }
    cat "$work/$processes.txt"
done
"$python" "$here/check.py" "$work/1.txt" "$work/2.txt"
