#!/usr/bin/env bash
# Everything that must hold before a change lands, build by build; docs/testing.md says what each is
# for. Stops at the first failure.
set -euo pipefail
cd "$(dirname "$0")/.."
mkdir -p build

stage= # the build at work
lines=()
trap 'if [ $? -ne 0 ]; then echo "make test: failed in stage: $stage" >&2; fi' EXIT

# run PRESET [PREFIX...]: configure, build and test it; PREFIX is put before ctest
run() {
    stage=$1
    shift
    local start=$SECONDS log="build/test-$stage.log"
    echo "== $stage"
    cmake --preset "$stage" >"$log" 2>&1 || { cat "$log"; return 1; }
    cmake --build --preset "$stage" -- --quiet
    "$@" ctest --preset "$stage" --output-on-failure --no-tests=error -j "$(nproc)" | tee "$log"
    lines+=("$(printf '%-16s %4d s  %s' "$stage" $((SECONDS - start)) \
        "$(grep 'tests passed' "$log")")")
}

# A KTX2 reader that is not ours; the test `readers` says so if it is missing.
if [ ! -d tests/node/node_modules/ktx-parse ] && command -v npm >/dev/null; then
    npm ci --prefix tests/node --silent --no-fund --no-audit || true
fi

# Some kernels place memory where older thread sanitizers do not expect it; switch that off if we
# may.
fixed=()
if setarch -R true 2>/dev/null; then
    fixed=(setarch -R)
fi

run release
run sanitize
run thread-sanitize "${fixed[@]}"
run scalar
run clang
stage=summary

echo
printf '%s\n' "${lines[@]}"
grep -h 'tests passed' build/test-release.log
