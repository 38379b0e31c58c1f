#!/usr/bin/env bash
# Compile the shaders with the reference compiler: every method, both languages, both kinds of
# maps; and see that it would complain.
# usage: check_shaders.sh ROOT FOLDER
set -euo pipefail
shaders=$1/shaders
folder=$2
if ! command -v glslangValidator >/dev/null; then
    echo "glslangValidator is missing"
    exit 77
fi
mkdir -p "$folder"
compiled=0
failed=0
scene=relief
details= # "detail dig" before a terrain that has them

head_of() {
    if [ "$1" = es ]; then
        printf '#version 300 es\nprecision highp float;\nprecision highp int;\n'
        printf 'precision highp sampler2D;\n'
    else
        printf '#version 430 core\n'
    fi
}

# check NAME STAGE: $folder/NAME compiles
check() {
    compiled=$((compiled + 1))
    if ! glslangValidator -S "$2" "$folder/$1" >"$folder/log"; then
        echo "$1:"
        cat "$folder/log"
        failed=$((failed + 1))
    fi
}

# fragment NAME LANGUAGE DEFINE...: what is drawn is $scene
fragment() {
    local name=$1 language=$2 define file
    shift 2
    {
        head_of "$language"
        for define in "$@"; do
            printf '#define %s\n' "$define"
        done
        cat "$shaders/heightcast.glsl"
        for file in $details; do
            cat "$shaders/$file.glsl"
        done
        [ $scene = relief ] || cat "$shaders/ground.glsl"
        cat "$shaders/$scene.frag"
    } >"$folder/$name"
}

for language in core es; do
    for stage in screen bodies ground; do
        { head_of $language && cat "$shaders/$stage.vert"; } >"$folder/$language-$stage.vert"
        check $language-$stage.vert vert
    done
    for method in SAFE MAXMIP QDM PARALLAX LINEAR RELIEF OCCLUSION CONE_FIXED CONE_LOOP CONE_EXACT \
        RELAXED ROBUST QUICK PDM FAST; do
        scene=terrain
        fragment $language-bodies-$method.frag $language "HC_METHOD HC_$method" BODIES
        check $language-bodies-$method.frag frag
        details="detail dig"
        for how in SAFE STEPS; do
            for part in RAYS BODIES; do
                fragment $language-detail-$how-$part-$method.frag $language \
                    "HC_METHOD HC_$method" DETAILS HC_DETAIL_$how $part
                check $language-detail-$how-$part-$method.frag frag
            done
        done
        details=
        fragment $language-polygons-$method.frag $language "HC_METHOD HC_$method" POLYGONS
        check $language-polygons-$method.frag frag
        for scene in terrain relief; do
            fragment $language-$scene-$method.frag $language "HC_METHOD HC_$method"
            check $language-$scene-$method.frag frag
        done
        if [ $language = core ]; then
            fragment gather-$method.frag core "HC_METHOD HC_$method" HC_GATHER
            check gather-$method.frag frag
        fi
    done
    fragment gather-dummer.frag core "HC_METHOD HC_CONE_LOOP" HC_GATHER HC_DUMMER
    check gather-dummer.frag frag
    scene=terrain
    for method in SAFE MAXMIP QDM FAST; do
        fragment $language-steps-$method.frag $language "HC_METHOD HC_$method" HC_STEPS \
            HC_OPEN_SIDES
        check $language-steps-$method.frag frag
        details="detail dig"
        fragment $language-detail-steps-$method.frag $language "HC_METHOD HC_$method" HC_STEPS \
            HC_OPEN_SIDES DETAILS
        check $language-detail-steps-$method.frag frag
        details=
    done
    scene=relief
    fragment $language-sparse.frag $language "HC_METHOD HC_FAST" HC_SPARSE
    check $language-sparse.frag frag
    fragment $language-diamond.frag $language "HC_METHOD HC_SAFE" "HC_CONE_CHANNELS 1"
    check $language-diamond.frag frag
    for method in PARALLAX LINEAR RELIEF OCCLUSION CONE_FIXED CONE_LOOP CONE_EXACT QUICK; do
        fragment $language-dummer-$method.frag $language "HC_METHOD HC_$method" HC_DUMMER
        check $language-dummer-$method.frag frag
    done
done

# search NAME L2 SIDED: behind bake.comp stands bake_$part.comp
search() {
    {
        head_of core
        printf '#define HC_BAKE HC_%s\n#define HC_L2 %s\n#define HC_SIDED %s\n' "$@"
        cat "$shaders/bake.comp" "$shaders/bake_$part.comp"
    } >"$folder/$1-$2-$3.comp"
    check "$1-$2-$3.comp" comp
}

for sides in "0 0" "0 1" "1 0" "1 1"; do
    part=search
    for name in BRUTE EXACT UPDATE GEMS; do
        # shellcheck disable=SC2086 # two words
        search $name $sides
    done
    part=quick
    # shellcheck disable=SC2086
    search QUICK $sides
done
part=samples
for name in PYRAMID FAMILIES BOUNDS GRADIENT RATIOS CELLS ROUNDING; do
    search $name 1 0
done

fragment wrong.frag core "HC_METHOD HC_SAFE" HC_DUMMER
if glslangValidator -S frag "$folder/wrong.frag" >"$folder/log"; then
    echo "wrong.frag compiles"
    failed=$((failed + 1))
fi
echo "$compiled compilations, $failed failed"
[ $failed -eq 0 ]
