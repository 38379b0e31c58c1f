#!/usr/bin/env bash
# Compile each public header alone, twice in a row, as C17 and as C++17, with every compiler there
# is.
# usage: check_headers.sh ROOT FOLDER
set -euo pipefail
root=$1
folder=$2
mkdir -p "$folder"
compiled=0
failed=0

# compile COMPILER LANGUAGE STANDARD HEADER
compile() {
    local source="$folder/alone.$2"
    printf '#include <heightcast/%s>\n#include <heightcast/%s>\n' "$4" "$4" >"$source"
    compiled=$((compiled + 1))
    if ! "$1" "-std=$3" -x "$2" -fsyntax-only -Wall -Wextra -Wpedantic -Wconversion -Wshadow \
        -Werror -I"$root/include" "$source"; then
        echo "$4 does not stand alone: $1 -std=$3"
        failed=$((failed + 1))
    fi
}

for header in "$root"/include/heightcast/*.h; do
    for compiler in gcc clang; do
        if command -v $compiler >/dev/null; then
            compile $compiler c c17 "$(basename "$header")"
        fi
    done
    for compiler in g++ clang++; do
        if command -v $compiler >/dev/null; then
            compile $compiler c++ c++17 "$(basename "$header")"
        fi
    done
done
echo "$compiled compilations, $failed failed"
[ $compiled -gt 0 ] && [ $failed -eq 0 ]
