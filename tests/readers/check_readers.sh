#!/usr/bin/env bash
# Do other people's programs find in our files what we put there? Those that are not installed are
# left out by name; if all are, the test counts as skipped (77).
# usage: check_readers.sh WRITE_SAMPLES FOLDER
set -euo pipefail
writer=$1
folder=$2
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$folder"
mkdir -p "$folder"
"$writer" "$folder"
cd "$folder"

ran=()
left_out=()

# have NAME COMMAND: true if the command is there
have() {
    if command -v "$2" >/dev/null; then
        ran+=("$1")
        return 0
    fi
    left_out+=("$1")
    return 1
}

fail() {
    echo "check_readers: $*" >&2
    exit 1
}

# same A B: byte for byte
same() {
    cmp "$1" "$2" || fail "$1 and $2 differ"
}

# says WORDS COMMAND...: its output has a line with the words
says() {
    local words=$1
    shift
    "$@" >said.txt 2>&1 || fail "$* failed: $(cat said.txt)"
    grep -qF -- "$words" said.txt || fail "$* does not say \"$words\": $(cat said.txt)"
}

if have ImageMagick convert; then
    gray() { # FILE BITS: its samples, little-endian
        convert "$1" -quiet -depth "$2" -endian LSB gray:read.raw
    }
    for file in field8.png field8.tif field8.pgm height8.png height8.tif height8.dds; do
        gray "$file" 8
        same read.raw "${file%.*}.samples"
    done
    for file in field16.png field16.tif field16.pgm; do
        gray "$file" 16
        same read.raw field16.samples
    done
    # 16-bit samples survive floats exactly
    gray field32.pfm 16
    same read.raw field16.samples
    gray field32.tif 16
    same read.raw field16.samples
    for file in dummer8.png dummer8.tif dummer8.dds; do
        convert "$file" -quiet -depth 8 rgba:read.raw
        same read.raw dummer8.samples
    done
    says "PNG 37x21 16-bit Gray" identify -quiet -format '%m %wx%h %z-bit %[colorspace]\n' \
        field16.png
    says "content=map kind=cone layout=dummer" identify -quiet -format '%[heightcast]\n' \
        dummer8.png
fi

if have tiffinfo tiffinfo; then
    says "ImageDescription: heightcast=1 content=field low=236 high=1076" tiffinfo field16.tif
    says "Predictor: floating point predictor" tiffinfo field32.tif
    says "Sample Format: IEEE floating point" tiffinfo pyramid32.tif
    tiffinfo pyramid16.tif >said.txt 2>/dev/null
    [ "$(grep -c '^=== TIFF directory' said.txt)" -eq 6 ] || fail "pyramid16.tif has not 6 levels"
    says "Image Width: 2 Image Length: 1" tiffinfo -4 pyramid16.tif
fi

if have exrheader exrheader; then
    says "R, 32-bit floating-point" exrheader rg32.exr
    says "A, 32-bit floating-point" exrheader quad32.exr
    says "dataWindow (type box2i): (0 0) - (36 20)" exrheader quad32.exr
    says 'heightcast (type string): "heightcast=1 content=map kind=cone layout=quad' \
        exrheader quad32.exr
fi
# the C++ library reads our file and writes another; both must hold the same
if have exrmaketiled exrmaketiled; then
    for name in rg32 quad32; do
        exrmaketiled -o -t 16 16 -z piz "$name.exr" "$name.tiled.exr" >/dev/null
        "$writer" "$name.exr" "$name.tiled.exr" ||
            fail "$name.exr: exrmaketiled read something else"
    done
fi

if have nvddsinfo nvddsinfo; then
    says "DXGI Format: 49 (R8G8_UNORM)" nvddsinfo rg8.dds
    says "DXGI Format: 35 (R16G16_UNORM)" nvddsinfo pyramid16.dds
    says "Mipmap count: 6" nvddsinfo pyramid16.dds
    says "DXGI Format: 2 (R32G32B32A32_FLOAT)" nvddsinfo quad32.dds
    says "Red mask: 0x00FF0000" nvddsinfo dummer8.dds
fi

if have gdalinfo gdalinfo; then
    says "Origin = (953.750000000000000,2037.250000000000000)" gdalinfo field16.tif
    says "AREA_OR_POINT=Point" gdalinfo field16.tif
    says "NoData Value=-9999" gdalinfo field32.tif
    says "Offset: 236,   Scale:840" gdalinfo field32.tif
fi

if have python3 python3; then
    python3 "$here/check_npy.py" field8 field16 field32 dummer8 rg8 rg16 rg32 quad32 ||
        fail "NPY files are not as they should be"
fi

if have node node; then
    if [ -d "$here/../node/node_modules/ktx-parse" ]; then
        node "$here/../node/check_ktx2.mjs" . dummer8 height8 rg8 rg16 rg32 quad32 \
            pyramid8 pyramid16 pyramid32 || fail "KTX2 files are not as they should be"
    else
        unset 'ran[-1]'
        left_out+=("ktx-parse (npm ci in tests/node)")
    fi
fi

echo "readers: ${ran[*]:-none}; left out: ${left_out[*]:-none}"
[ ${#ran[@]} -gt 0 ] || exit 77
