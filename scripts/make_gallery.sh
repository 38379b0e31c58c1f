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

edge="--depth 0.4 --camera 1.5,-2.4,1.3 --at 0,0,-0.1 --fov 45 --size 400x267"
for how in wall discard clamp; do
    # shellcheck disable=SC2086
    relief edge_$how $work/tile.npy $edge --edge $how
done

# The 2006 paper: its three marchers, with dark outlines where steps were too few; its map.
low="--camera -0.9,-2.4,0.75 --at 0,-0.1,-0.1 --fov 40 --size 400x240"
while read -r method steps; do
    # shellcheck disable=SC2086 # the options are meant to be split
    relief paper_$method $work/cobbles.npy --edge discard --depth 0.3 $low --method "$method" \
        --steps "$steps"
done <<'END'
cone-fixed 10
cone-loop 20
cone-exact 256
END
$program bake $work/tile.npy $work/dummer.png --layout dummer --wrap uv --overwrite -q
$program show $work/dummer.png --out $gallery/paper_map.png --overwrite -q

# The 2022 paper: what quick maps give away, and what does not converge on them in 20 steps.
for method in exact quick quick-improved quick-naive-centre quick-centre; do
    $program bake $work/cobbles.npy $work/$method.exr --wrap uv --method $method --max-ratio 1 \
        --overwrite -q
done
for method in quick quick-improved; do
    $program compare $work/exact.exr $work/$method.exr --diff $gallery/less_in_$method.png \
        --overwrite -q >/dev/null
done
for method in quick quick-improved quick-naive-centre quick-centre; do
    relief unconverged_$method $work/$method.exr --edge discard --method quick --steps 20 \
        --view unconverged --shadows off --size 400x267
done

# Steps, and what is lost.
relief steps_safe $work/cobbles.npy --edge discard --view steps --top 40 --size 400x267
relief steps_maxmip $work/cobbles.npy --edge discard --view steps --top 40 --size 400x267 \
    --method maxmip
relief missed_cone-fixed $work/cobbles.npy --edge discard --method cone-fixed --view missed \
    --size 400x267
relief error_cone-fixed $work/cobbles.npy --edge discard --method cone-fixed --view error \
    --size 400x267
# Terrain: the real elevations from the air, on foot and out of a valley; figures of the 2009 paper.
terrain() {
    local name=$1
    shift
    $program render terrain data/jacksboro_fault_dem.pgm --spacing 74.5,92.5 \
        --out $gallery/terrain_$name.png --overwrite -q "$@"
}

for tour in fly walk; do
    terrain $tour --tour $tour --size 960x540 --objects data/jacksboro_objects.txt
done
for tour in up orbit; do
    terrain $tour --tour $tour --size 480x270
done
for tour in fly walk; do
    terrain crossings_$tour --tour $tour --method maxmip --view crossings --size 480x270
done
near=(--eye 10900,-14600,800 --at 10300,-15300,500 --above 120 --colours plain --haze 1e30
    --size 400x300)
terrain near_steps "${near[@]}" --surface steps
terrain near_blocky "${near[@]}" --blocky
terrain near_smooth "${near[@]}"
for texels in 1024 4096; do
    terrain map_$texels --shadow-map $texels --size 480x270 --objects data/jacksboro_objects.txt
done
for colours in elevation slope; do
    terrain $colours --colours $colours --size 480x270
done
terrain missed --method cone-loop --view missed --size 480x270

# Details, as the RaycastTerrain sample lays them over its terrain, where slopes say so.
$program gen fbm $work/turf.npy --size 128 --seed 4 --overwrite -q
$program gen cobbles $work/stones.npy --size 128 --seed 2 --overwrite -q
$program gen ridged $work/rock.npy --size 256 --seed 5 --overwrite -q
$program bake data/jacksboro_fault_dem.pgm $work/heights.npy --layout height --range data \
    --overwrite -q
scripts/slope_mask.py $work/heights.npy $work/mask.png --spacing 74.5,92.5 --rise 840 --steep 0.3
valley=(--eye 12600,-13800,800 --at 10300,-15300,420 --above 90)
details=(--detail $work/turf.npy,260,14 --detail $work/stones.npy,260,20
    --detail $work/rock.npy,700,70 --mask $work/mask.png --detail-fade 2500:7000)
terrain detail "${valley[@]}" "${details[@]}" --size 960x540
terrain detail_none "${valley[@]}" --size 400x225
terrain detail_steps "${valley[@]}" "${details[@]}" --size 400x225 --detail-method steps \
    --detail-steps 8
terrain detail_missed "${valley[@]}" "${details[@]}" --size 400x225 --detail-method steps \
    --detail-steps 8 --view missed --samples 1
ls $gallery/*.png
