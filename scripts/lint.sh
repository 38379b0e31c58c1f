#!/usr/bin/env bash
# Layers, layout and, where it is installed, clang-tidy.
set -euo pipefail
cd "$(dirname "$0")/.."
failed=0

python3 scripts/check_layers.py || failed=1

# Layouts differ between versions; the project's is that of 14.
format=$(command -v clang-format-14 || command -v clang-format)
git ls-files '*.c' '*.h' | xargs "$format" --dry-run --Werror || failed=1

texts=('*.c' '*.h' '*.inc' '*.cpp' '*.glsl' '*.frag' '*.vert' '*.comp' '*.sh' '*.py' '*.mjs'
    '*.cmake' '*CMakeLists.txt')
if git ls-files "${texts[@]}" | xargs grep -nP '^.{101,}$|\t|[ \r]$'; then
    echo "lint: lines over 100 columns, tabs, blanks at the end"
    failed=1
fi

if command -v clang-tidy >/dev/null; then
    cmake --preset clang -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >/dev/null
    git ls-files 'src/*.c' 'tools/*.c' 'examples/*.c' |
        xargs clang-tidy -p build/clang --quiet 2>/dev/null || failed=1
fi
exit $failed
