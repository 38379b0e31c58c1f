#!/usr/bin/env bash
# Compare what PROGRAM prints with the golden FILE; with UPDATE=1 write FILE instead.
# usage: [UPDATE=1] check.sh PROGRAM FILE
set -euo pipefail
printed=$("$1")
if [ "${UPDATE:-0}" = 1 ]; then
    printf '%s\n' "$printed" >"$2"
fi
diff -u "$2" - <<<"$printed"
