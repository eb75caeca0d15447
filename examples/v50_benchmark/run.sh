#!/bin/sh
# Both series of the benchmark and their comparison. Run it in an empty folder: sh run.sh [path of toron]. Stopped, it goes on where it was.
set -e
scene="$(dirname "$0")/panel.toml"
toron="${1:-toron}"
for law in elastic frictional; do
    restart=
    if [ -e "$law/shots.csv" ]; then restart=--restart; fi
    "$toron" v50 "$scene" --case "$law" --threads 1 -o "$law" $restart
done
"$toron" v50 --analyse elastic/shots.csv --with frictional/shots.csv -o compared
