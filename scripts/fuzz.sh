#!/usr/bin/env bash
# Fuzz each file reader for FUZZ_SECONDS [60], from its seed corpus; new inputs and crashes stay in
# build/fuzz/found/.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${FUZZ_SECONDS:-60}
names=(tests/fuzz/corpus/*)
names=("${names[@]##*/}")
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target "${names[@]/#/fuzz_}" -- --quiet
failed=()
for name in "${names[@]}"; do
    found=build/fuzz/found/$name
    mkdir -p "$found/new"
    echo "== $name for $seconds s"
    "build/fuzz/tests/fuzz/fuzz_$name" -max_total_time="$seconds" -rss_limit_mb=2048 -timeout=20 \
        -print_final_stats=1 -artifact_prefix="$found/" "$found/new" "tests/fuzz/corpus/$name" \
        2>"$found/log" || failed+=("$name")
    grep -E 'stat::number_of_executed_units|ERROR|SUMMARY' "$found/log" || true
done
if [ ${#failed[@]} -gt 0 ]; then
    echo "fuzz: failed: ${failed[*]} (inputs and logs are in build/fuzz/found)" >&2
    exit 1
fi
