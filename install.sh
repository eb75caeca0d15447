#!/bin/sh
# Installs libtoron on Linux: static and shared library, headers for C and C++, the source of the Fortran module, what
# pkg-config and CMake find them by, and the licences.
#
#     ./install.sh [--prefix=/usr/local] [--destdir=DIR]
#
# Files go to DIR/PREFIX; the installed tree may be moved. CARGO_TARGET_DIR is where it is built, as for cargo itself.
set -eu
prefix=/usr/local
destdir=
for argument; do
    case $argument in
    --prefix=*) prefix=${argument#*=} ;;
    --destdir=*) destdir=${argument#*=} ;;
    *)
        echo "usage: $0 [--prefix=/usr/local] [--destdir=DIR]" >&2
        exit 2
        ;;
    esac
done
case $prefix in /*) ;; *) prefix=$PWD/$prefix ;; esac
to=$destdir$prefix
cd "$(dirname "$0")"

abi=$(sed -n 's/^#define TORON_ABI_VERSION //p' include/toron.h)
version=$(sed -n 's/^version = "\(.*\)"$/\1/p' Cargo.toml | head -n 1)
soname=libtoron.so.$abi
built=${CARGO_TARGET_DIR:-target}/release

# The build folder's own libtoron.so has no SONAME, so that programs find it there: the shared library is linked a second time with
# one, and in the end the build folder's is made again.
cargo build --release --locked --package toron-c
mkdir -p "$to/include" "$to/lib/pkgconfig" "$to/lib/cmake/toron" "$to/share/doc/toron"
cp "$built/libtoron.a" "$to/lib/"
trap 'cargo build --release --locked --quiet --package toron-c' EXIT
cargo rustc --release --locked --package toron-c --crate-type cdylib -- -C "link-arg=-Wl,-soname,$soname"
cp "$built/libtoron.so" "$to/lib/libtoron.so.$version"
ln -sf "libtoron.so.$version" "$to/lib/$soname"
ln -sf "$soname" "$to/lib/libtoron.so"
cp include/toron.h include/toron.hpp include/toron.f90 "$to/include/"
cp LICENSE-MIT LICENSE-APACHE THIRD-PARTY.md "$to/share/doc/toron/"

cat >"$to/lib/pkgconfig/toron.pc" <<END
prefix=\${pcfiledir}/../..
libdir=\${prefix}/lib
includedir=\${prefix}/include

Name: toron
Description: A transversely isotropic hyperelastic yarn law, and a linear elastic one
Version: $version
Cflags: -I\${includedir}
Libs: -L\${libdir} -ltoron
Libs.private: -lpthread -ldl -lm
END

cat >"$to/lib/cmake/toron/toronConfig.cmake" <<END
# Targets toron::toron (shared) and toron::static; toron_FORTRAN_MODULE is the source of the Fortran module.
get_filename_component(toron_prefix "\${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
set(toron_FORTRAN_MODULE "\${toron_prefix}/include/toron.f90")
if(NOT TARGET toron::toron)
  add_library(toron::toron SHARED IMPORTED)
  set_target_properties(toron::toron PROPERTIES
    IMPORTED_LOCATION "\${toron_prefix}/lib/$soname"
    IMPORTED_SONAME $soname
    INTERFACE_INCLUDE_DIRECTORIES "\${toron_prefix}/include")
  add_library(toron::static STATIC IMPORTED)
  set_target_properties(toron::static PROPERTIES
    IMPORTED_LOCATION "\${toron_prefix}/lib/libtoron.a"
    INTERFACE_INCLUDE_DIRECTORIES "\${toron_prefix}/include"
    INTERFACE_LINK_LIBRARIES "pthread;dl;m")
endif()
END

# A later version will do, as long as its first number is the same (before 1.0 the first two).
cat >"$to/lib/cmake/toron/toronConfigVersion.cmake" <<END
set(PACKAGE_VERSION $version)
string(REGEX MATCH "^(0[.])?[0-9]+" toron_series "\${PACKAGE_VERSION}")
string(REGEX MATCH "^(0[.])?[0-9]+" toron_wanted "\${PACKAGE_FIND_VERSION}")
if(PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION OR NOT toron_series STREQUAL toron_wanted)
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
else()
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  if(PACKAGE_FIND_VERSION VERSION_EQUAL PACKAGE_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
  endif()
endif()
END
echo "toron $version (interface $abi) is in $to"
