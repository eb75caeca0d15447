#!/bin/sh
# Builds CalculiX from the distribution's source package, with external behaviours, which its own binary lacks. Keeps the
# program in the cache folder and prints its path. Needs no rights: the source entries are those of this machine, in a
# folder of their own. The packages that it needs are installed by ./test.sh.
set -eu
cache="${XDG_CACHE_HOME:-$HOME/.cache}/toron/calculix-$(cksum <"$0" | cut -d ' ' -f 1)"
if [ -x "$cache/ccx" ]; then
    echo "$cache/ccx"
    exit
fi
refuse() {
    echo "CalculiX cannot be built: $1" >&2
    exit 1
}
for tool in apt-get dpkg-source gcc gfortran make nm; do
    command -v "$tool" >/dev/null 2>&1 || refuse "there is no $tool; ./test.sh installs it (Debian, Ubuntu)"
done
echo "building CalculiX, about 3 minutes" >&2
mkdir -p "$cache"
build="$(mktemp -d "$cache/build.XXXXXX")"
trap 'rm -rf "$build"' EXIT
mkdir -p "$build/sources" "$build/lists/partial" "$build/archives/partial"

# Every entry for binary packages becomes one for source packages.
for entries in /etc/apt/sources.list /etc/apt/sources.list.d/*; do
    [ -f "$entries" ] || continue
    case "$entries" in
        *.list) sed -n 's/^[[:space:]]*deb[[:space:]]/deb-src /p' "$entries" >"$build/sources/${entries##*/}" ;;
        *.sources) sed 's/^Types:.*/Types: deb-src/' "$entries" >"$build/sources/${entries##*/}" ;;
    esac
done
apt() {
    apt-get -qq -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts="$build/sources" \
        -o Dir::State::lists="$build/lists" -o Dir::Cache="$build" -o APT::Sandbox::User=root "$@" >&2
}
cd "$build"
apt update || true # one entry without sources is no reason to stop
apt source --download-only calculix-ccx || refuse "the source package calculix-ccx cannot be had from this machine's sources"
dpkg-source --no-check -x calculix-ccx_*.dsc source >/dev/null # apt has checked it

cd source/ccx_*/src
program="$(basename "$(dirname "$PWD")")"
make -s -j "$(nproc)" "$program" LDFLAGS=-ldl FFLAGS="-O2 -w -fopenmp -fallow-argument-mismatch" CFLAGS="-O2 -w \
    -I/usr/include/spooles -DARCH=Linux -DSPOOLES -DARPACK -DMATRIXSTORAGE -DUSE_MT=1 \
    -DCALCULIX_EXTERNAL_BEHAVIOURS_SUPPORT" >make.log 2>&1 ||
    { tail -20 make.log >&2; refuse "see above; ./test.sh installs the libraries that it needs"; }
# Without dlopen it would take the decks without a word, and answer nonsense.
nm -D "$program" | grep -q dlopen || refuse "it has no external behaviours"
mv "$program" "$cache/ccx"
echo "$cache/ccx"
