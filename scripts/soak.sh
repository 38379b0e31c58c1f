#!/usr/bin/env bash
# Fire SOAK_RAYS [100000000] rays at fields of every kind and size, and hold the answers of the
# tracers that lose no first hit against the reference: docs/testing.md. SOAK_SEED [1000] is the
# seed of the first round.
set -euo pipefail
cd "$(dirname "$0")/.."
mkdir -p build
cmake --preset release >build/soak.log 2>&1 || { cat build/soak.log; exit 1; }
cmake --build --preset release --target test_agree_soak -- --quiet
exec build/tests/test_agree_soak "${SOAK_RAYS:-100000000}" "${SOAK_SEED:-1000}"
