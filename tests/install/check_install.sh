#!/usr/bin/env bash
# Install a build into a folder of its own and build users' programs against it, by CMake and by
# pkg-config. "shared" configures a build of shared libraries for that, warnings as errors.
# usage: check_install.sh static|shared ROOT BUILD FOLDER
set -euo pipefail
kind=$1
root=$2
build=$3
folder=$4
rm -rf "$folder/prefix" "$folder/consumer"
mkdir -p "$folder"

if [ "$kind" = shared ]; then
    build=$folder/build
    cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON \
        -DHC_WERROR=ON -DHC_BUILD_BENCH=OFF -DCMAKE_SHARED_LINKER_FLAGS=-Wl,-z,defs >/dev/null
    cmake --build "$build" -- --quiet
fi
cmake --install "$build" --prefix "$folder/prefix" >/dev/null
prefix=$(cd "$folder/prefix" && pwd)
library=$(dirname "$(find "$prefix" -name 'libheightcast.*' | head -n 1)")
export LD_LIBRARY_PATH=$library PKG_CONFIG_PATH=$library/pkgconfig
cd "$folder"

# by CMake
cmake -S "$root/tests/install" -B consumer -G Ninja -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build consumer -- --quiet
(cd consumer && ./consumer && ./core_only && ./picture)

# by pkg-config
source=$root/tests/install
# shellcheck disable=SC2046 # the flags are meant to be split
cc -std=c17 "$source/consumer.c" -o consumer/by_pkg_config \
    $(pkg-config --cflags --libs heightcast-io)
# shellcheck disable=SC2046
cc -std=c17 "$source/picture.c" -o consumer/picture_by_pkg_config \
    $(pkg-config --cflags --libs heightcast-render)
# shellcheck disable=SC2046
c++ -std=c++17 "$source/core_only.cpp" -o consumer/core_by_pkg_config \
    $(pkg-config --cflags --libs heightcast)
(cd consumer && ./by_pkg_config && ./picture_by_pkg_config && ./core_by_pkg_config)

# what a person gets
"$prefix/bin/heightcast" --version
test -s "$prefix/share/man/man1/heightcast.1"
test -s "$prefix/share/heightcast/shaders/heightcast.glsl"

if [ "$kind" = shared ]; then
    readelf -d "$library/libheightcast.so" | grep -q 'SONAME.*\[libheightcast\.so\.[0-9]*\]'
    python3 "$root/scripts/check_api_use.py" --exports "$library/libheightcast.so" \
        "$library/libheightcast-io.so" "$library/libheightcast-render.so"
fi
