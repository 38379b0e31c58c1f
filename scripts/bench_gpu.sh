#!/usr/bin/env bash
# Measure baking on the GPU of this machine, and keep the table under its name in bench/results.
# usage: bench_gpu.sh [SIZES]     e.g. 256,512,1024; without: 256 to 8192
set -euo pipefail
cd "$(dirname "$0")/.."
sizes=${1:-256,512,1024,2048,4096,8192}
table=$(mktemp)
trap 'rm -f "$table"' EXIT

echo "\$ heightcast bench bake --backend gl --sizes $sizes" >"$table"
build/heightcast bench bake --backend gl --sizes "$sizes" | tee -a "$table"

# "NVIDIA GeForce RTX 4090/PCIe/SSE2" -> nvidia_geforce_rtx_4090; what is in brackets says which
# driver
name=$(sed -n 's/^gpu  *//p' "$table" | head -n 1 | sed 's/ *[(/].*//' |
    tr '[:upper:]' '[:lower:]' | tr -c 'a-z0-9\n' '_')
cp "$table" "bench/results/bake_gl_$name.txt"
echo "kept in bench/results/bake_gl_$name.txt"
