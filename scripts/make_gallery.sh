#!/usr/bin/env bash
# The pictures of docs/gallery, drawn by the program itself. docs/gallery/README.md shows them with
# their commands.
set -euo pipefail
cd "$(dirname "$0")/.."
program=build/heightcast
gallery=docs/gallery
work=out/gallery
mkdir -p $work $gallery

# draw NAME FIELD BAKE_OPTION...
draw() {
    local name=$1 field=$2
    shift 2
    $program bake "$field" "$work/$name.exr" --overwrite -q "$@"
    $program show "$work/$name.exr" --out "$gallery/$name.png" --overwrite -q
}

$program gen cobbles $work/cobbles.npy --size 512x512 --seed 1 --overwrite -q
draw jacksboro data/jacksboro_fault_dem.pgm --range data
draw cobbles $work/cobbles.npy --wrap uv
draw jacksboro_quad data/jacksboro_fault_dem.pgm --range data --cones quad
for method in exact quick-improved; do
    $program bake data/jacksboro_fault_dem.pgm $work/$method.exr --range data --method $method \
        --max-ratio 0.2 --overwrite -q
done
$program compare $work/exact.exr $work/quick-improved.exr \
    --diff $gallery/jacksboro_less_in_quick.png --overwrite -q >/dev/null
$program trace data/jacksboro_fault_dem.pgm --range data --space local --spacing 74.5,92.5 \
    --eye 15000,-35000,5000 --at 15000,-14000,0 --picture $gallery/jacksboro_view.png \
    --overwrite -q

# relief NAME FIELD OPTION...
relief() {
    local name=$1 field=$2
    shift 2
    $program render relief "$field" --out $gallery/$name.png --overwrite -q "$@"
}

$program gen cobbles $work/tile.npy --size 256 --seed 1 --overwrite -q
relief relief data/jacksboro_fault_dem.pgm
for body in cylinder sphere torus; do
    relief relief_$body $work/tile.npy --object $body --size 640x480
done
ls $gallery/*.png
