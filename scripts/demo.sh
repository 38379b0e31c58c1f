#!/usr/bin/env bash
# Bake real elevations and a made texture in all layouts, verify them, draw them, cast rays at them,
# fly over them and walk on them; into out/demo.
set -euo pipefail
cd "$(dirname "$0")/.."
program=build/heightcast
out=out/demo
checked=2000 # texels of each map
rays=20000   # of each method
mkdir -p $out

# The number that NAME has in the JSON object in FILE.
figure() {
    sed -n "s/^[^\"]*\"$1\":[[:space:]]*\([-+0-9.e]*\).*/\1/p" "$2" | head -n 1
}

# What goes on, on a terminal.
doing() {
    if [ -t 2 ]; then
        printf '\r\033[K%s' "$*" >&2
    fi
}

row() {
    printf '%-28s %-9s %8s %8s %8s %8s %9s\n' "$@"
}

layout() {
    sed -n 's/.*"layout":[[:space:]]*"\([^"]*\)".*/\1/p' $out/bake.json
}

# scaled FACTOR FORMAT NAME FILE: a figure as people read it
scaled() {
    awk -v x="$(figure "$3" "$4")" "BEGIN { printf \"$2\", $1 * x }"
}

# bake MAP OPTION...: bake from $field, verify what has safe cones, print a row of the table
bake() {
    local map=$1 texels="-" kept="-"
    shift
    doing "baking $map"
    $program bake "$field" "$out/$map" "${load[@]}" --overwrite --json -q "$@" >$out/bake.json
    if grep -q '"map":[[:space:]]*"cone"' $out/bake.json && [ "$(layout)" != height ]; then
        doing "verifying $map"
        $program verify "$out/$map" --heights "$field" "${load[@]}" --texels $checked --json -q \
            >$out/verify.json
        texels=$(figure texels_checked $out/verify.json)
        kept=$(scaled 1 %.4f mean_kept $out/verify.json)
    fi
    doing ""
    row "$map" "$(layout)" "$(scaled 1000 %.1f load $out/bake.json)" \
        "$(scaled 1000 %.1f bake $out/bake.json)" "$(scaled 1000 %.1f save $out/bake.json)" \
        "$texels" "$kept"
}

# all_layouts NAME FIELD OPTION...: the options say how to load the field
all_layouts() {
    local name=$1 field=$2
    local load=("${@:3}")
    bake "${name}_dummer.png" --layout dummer --bits 8
    bake "${name}_rg_16.png" --layout rg --bits 16
    bake "${name}_rg.exr" --layout rg
    bake "${name}_diamond.exr" --cones l1
    bake "${name}_quad.exr" --cones quad
    bake "${name}_aniso.exr" --cones aniso
    bake "${name}_height.tif" --layout height
    bake "${name}_gradient.npy" --map gradient
    bake "${name}_pyramid.ktx2" --map pyramid
    bake "${name}_bounds.dds" --map bounds
    bake "${name}_relaxed.exr" --map relaxed
    bake "${name}_quick_improved.exr" --layout rg --method quick-improved
}

# pictures NAME FIELD OPTION...
pictures() {
    local name=$1 field=$2
    local load=("${@:3}")
    doing "drawing $name"
    $program show "$out/${name}_rg.exr" --out "$out/${name}_height_and_ratio.png" --overwrite -q
    $program show "$out/${name}_quad.exr" --out "$out/${name}_quadrants.png" --overwrite -q
    # Of wide cones a little less is a lot; up to 0.2 the picture shows where cones got narrow.
    for method in exact quick-improved; do
        $program bake "$field" "$out/${name}_$method.exr" "${load[@]}" --method $method \
            --max-ratio 0.2 --overwrite -q
    done
    $program compare "$out/${name}_exact.exr" "$out/${name}_quick-improved.exr" \
        --diff "$out/${name}_less_in_quick_improved.png" --overwrite -q >/dev/null
    doing ""
}

start=$SECONDS
$program gen cobbles $out/cobbles.png --size 512x512 --seed 1 --overwrite -q
row "map, in $out" layout "load ms" "bake ms" "save ms" checked "mean kept"
for task in all_layouts pictures; do
    $task jacksboro data/jacksboro_fault_dem.pgm --range data
    $task cobbles $out/cobbles.png --wrap uv
done
rm $out/bake.json $out/verify.json

doing "casting rays"
place=(--range data --space local --spacing 74.5,92.5)
$program trace data/jacksboro_fault_dem.pgm "${place[@]}" --eye 15000,-35000,5000 \
    --at 15000,-14000,0 --size 1280x720 --picture $out/jacksboro_view.png --overwrite -q
for tour in fly walk; do
    doing "drawing the terrain: $tour"
    $program render terrain data/jacksboro_fault_dem.pgm --spacing 74.5,92.5 --tour $tour \
        --objects data/jacksboro_objects.txt --out $out/terrain_$tour.png --overwrite -q
done
doing ""
cat <<END

$rays rays of all sorts at the real elevations, and what each method loses of the first hits:

END
$program verify data/jacksboro_fault_dem.pgm --range data --rays $rays

if [ -t 1 ]; then
    $program show $out/jacksboro_rg.exr
fi
cat <<END

checked: texels compared with brute force; none was wider than it may be. mean kept: their ratios,
relative to brute force, on average; 8 and 16 bits round down. What quick-improved keeps of them is
why exact cones are worth having.
lost: hits behind the surface, or none; too early: before it, or where nothing is. fast, safe and
maxmip may do neither; the others are given a fifth of a sample and 1/256 of the height.
Pictures, made in $((SECONDS - start)) s:
END
ls $out/terrain_*.png $out/*view.png $out/*height_and_ratio.png $out/*quadrants.png \
    $out/*quick_improved.png
