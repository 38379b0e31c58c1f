#!/usr/bin/env python3
"""Write the sample files beside this script with other people's tools: ImageMagick's convert,
GDAL's gdal_translate, OpenEXR's exrmaketiled; EXR, NPY and tagged PNG by hand. Only needed to add
one: the files are kept in the repository.

Samples, with x to the right and y downwards:
  37 x 21  wide(x, y) = 1000 + 37 * x + 411 * y      byte(x, y) = 3 * x + 5 * y
  5 x 3    the small ones: the same formulas
"""

import os
import pathlib
import struct
import subprocess
import tempfile
import zlib

HERE = pathlib.Path(__file__).parent
W, H = 37, 21
SMALL = (5, 3)


def wide(x, y):
    return 1000 + 37 * x + 411 * y


def byte(x, y):
    return 3 * x + 5 * y


def grid(function, size=(W, H)):
    return [function(x, y) for y in range(size[1]) for x in range(size[0])]


def run(*words):
    subprocess.run([str(word) for word in words], check=True, stdout=subprocess.DEVNULL)


def envi(folder, name, code, data_type, values, size=(W, H), bands=1):
    """A raw file with an ENVI header, which gdal_translate reads."""
    path = folder / name
    path.write_bytes(struct.pack(f"<{len(values)}{code}", *values))
    path.with_suffix(".hdr").write_text(
        f"ENVI\nsamples = {size[0]}\nlines = {size[1]}\nbands = {bands}\nheader offset = 0\n"
        f"file type = ENVI Standard\ndata type = {data_type}\ninterleave = bip\nbyte order = 0\n"
    )
    return path


def tiffs(folder):
    place = ["-a_ullr", 500, 1000, 500 + 10 * W, 1000 - 20 * H]
    u8 = envi(folder, "u8.bin", "B", 1, grid(byte))
    u16 = envi(folder, "u16.bin", "H", 12, grid(wide))
    i16 = envi(folder, "i16.bin", "h", 2, [-9999 if i == 40 else v - 5000
                                           for i, v in enumerate(grid(wide))])
    u32 = envi(folder, "u32.bin", "I", 13, [v * 100000 for v in grid(wide)])
    i32 = envi(folder, "i32.bin", "i", 3, [(v - 5000) * 100000 for v in grid(wide)])
    f32 = envi(folder, "f32.bin", "f", 4, [v / 8 - 100.5 for v in grid(wide)])
    f64 = envi(folder, "f64.bin", "d", 5, [v / 3 for v in grid(wide)])
    rgb = envi(folder, "rgb.bin", "H", 12, [v + k for v in grid(wide) for k in (0, 10, 20)],
               bands=3)
    tiff = ["gdal_translate", "-q", "-of", "GTiff"]
    tile = ["-co", "TILED=YES", "-co", "BLOCKXSIZE=16", "-co", "BLOCKYSIZE=16"]
    lines = ["-co", "BLOCKYSIZE=4"]
    run(*tiff, *tile, "-co", "COMPRESS=DEFLATE", "-co", "PREDICTOR=2", *place, u16,
        HERE / "tiles_u16.tif")
    run(*tiff, *lines, "-co", "COMPRESS=LZW", u8, HERE / "strips_lzw_u8.tif")
    run(*tiff, "-co", "PHOTOMETRIC=MINISWHITE", u8, HERE / "white_is_zero_u8.tif")
    run(*tiff, "-a_nodata", -9999, "-mo", "AREA_OR_POINT=Point", *place, "-co", "COMPRESS=DEFLATE",
        i16, HERE / "nodata_point_i16.tif")
    run(*tiff, "-co", "ENDIANNESS=BIG", "-co", "COMPRESS=DEFLATE", u32, HERE / "big_endian_u32.tif")
    run(*tiff, "-co", "BIGTIFF=YES", "-co", "COMPRESS=DEFLATE", i32, HERE / "bigtiff_i32.tif")
    run(*tiff, *tile, "-co", "COMPRESS=DEFLATE", "-co", "PREDICTOR=3", f32,
        HERE / "tiles_predictor3_f32.tif")
    run(*tiff, *lines, "-co", "COMPRESS=DEFLATE", f64, HERE / "strips_f64.tif")
    run(*tiff, "-co", "INTERLEAVE=BAND", "-co", "COMPRESS=DEFLATE", *lines, rgb,
        HERE / "planes_rgb_u16.tif")
    run(*tiff, "-co", "INTERLEAVE=PIXEL", "-co", "COMPRESS=DEFLATE", *tile, rgb,
        HERE / "tiles_rgb_u16.tif")
    run(*tiff, "-co", "PIXELTYPE=SIGNEDBYTE", "-co", "COMPRESS=PACKBITS", u8,
        HERE / "strips_i8.tif")
    small = envi(folder, "small.bin", "f", 4, [v / 8 for v in grid(wide, SMALL)], SMALL)
    run("gdal_translate", "-q", "-of", "AAIGrid", "-a_ullr", 500, 1000, 550, 970, "-a_nodata", -1,
        small, HERE / "grid.asc")
    for name in HERE.glob("grid.asc.aux.xml"):
        name.unlink()
    for name in HERE.glob("grid.prj"):
        name.unlink()


def pngs(folder):
    w, h = SMALL
    grey = folder / "grey.pgm"
    grey.write_bytes(b"P5 5 3 65535\n" + struct.pack(">15H", *grid(wide, SMALL)))
    low = folder / "low.pgm"
    colour = folder / "colour.ppm"
    colours = bytes(v + k for v in grid(byte, SMALL) for k in (0, 40, 80))
    colour.write_bytes(b"P6 5 3 255\n" + colours)
    plain = ["convert", "-define", "png:exclude-chunks=all"]

    def png(source, name, *options):
        run(*plain, source, *options, HERE / name)

    png(grey, "grey16.png")
    png(grey, "interlaced16.png", "-interlace", "PNG")
    png(colour, "rgb8.png", "-define", "png:color-type=2")
    png(colour, "palette.png", "-define", "png:color-type=3")
    for bits in (1, 2, 4):
        n = 2**bits - 1
        low.write_bytes(f"P5 5 3 {n}\n".encode() + bytes((x + y) % (n + 1) for y in range(h)
                                                         for x in range(w)))
        png(low, f"grey{bits}.png", "-define", f"png:bit-depth={bits}", "-define",
            "png:color-type=0")
    profile = b"any name\0\0" + zlib.compress(bytes(100) + "sRGB built-in".encode("utf-16-be"))
    for name, tag in ("srgb.png", (b"sRGB", b"\0")), ("icc_srgb.png", (b"iCCP", profile)):
        rows = b"".join(b"\0" + bytes(byte(x, y) for x in range(w)) for y in range(h))
        chunks = [(b"IHDR", struct.pack(">IIBBBBB", w, h, 8, 0, 0, 0, 0)), tag,
                  (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
        (HERE / name).write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(
            struct.pack(">I", len(data)) + key + data + struct.pack(">I", zlib.crc32(key + data))
            for key, data in chunks))
    clear = folder / "clear.png"
    run("convert", colour, "-transparent", "rgb(3,43,83)", clear)
    run("convert", clear, "-define", "png:exclude-chunks=bkgd,chrm,date,gama,srgb,text",
        "PNG8:" + str(HERE / "palette_alpha.png"))
    run("convert", grey, "-endian", "MSB", HERE / "grey.pfm")


def half(value):
    return struct.pack("<e", value)


def exr(name, channels, lines, window=(0, 0), order=0):
    """Uncompressed scan lines; channels: [(name, type)], type 0 uint, 1 half, 2 float;
    lines[y][channel] are samples."""
    def attribute(key, kind, data):
        return key + b"\0" + kind + b"\0" + struct.pack("<i", len(data)) + data

    width, height = len(lines[0][0]), len(lines)
    listed = b"".join(key + b"\0" + struct.pack("<iB3xii", kind, 0, 1, 1) for key, kind in channels)
    x0, y0 = window
    box = struct.pack("<4i", x0, y0, x0 + width - 1, y0 + height - 1)
    header = struct.pack("<II", 20000630, 2)
    header += attribute(b"channels", b"chlist", listed + b"\0")
    header += attribute(b"compression", b"compression", b"\0")
    header += attribute(b"dataWindow", b"box2i", box)
    header += attribute(b"displayWindow", b"box2i", box)
    header += attribute(b"lineOrder", b"lineOrder", bytes([order]))
    header += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    header += attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0))
    header += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0"
    pack = {0: lambda v: struct.pack("<I", v), 1: half, 2: lambda v: struct.pack("<f", v)}
    chunks = []
    for y, line in enumerate(lines):
        data = b"".join(b"".join(pack[kind](v) for v in row)
                        for (_, kind), row in zip(channels, line))
        chunks.append(struct.pack("<ii", y0 + y, len(data)) + data)
    at = len(header) + 8 * height
    stored = chunks if order == 0 else chunks[::-1]
    offsets = {}
    for chunk in stored:
        offsets[chunk[:4]] = at
        at += len(chunk)
    table = b"".join(struct.pack("<Q", offsets[chunk[:4]]) for chunk in chunks)
    (HERE / name).write_bytes(header + table + b"".join(stored))


def exrs(folder):
    w, h = SMALL

    def rows(function):
        return [[function(x, y) for x in range(w)] for y in range(h)]

    v = rows(lambda x, y: wide(x, y) / 8192)
    exr("half.exr", [(b"Y", 1)], [[line] for line in v])
    exr("float_z_window.exr", [(b"Z", 2)], [[line] for line in v], window=(-7, 11), order=1)
    exr("uint.exr", [(b"Y", 0)], [[line] for line in rows(wide)])
    exr("mixed_bgr.exr", [(b"B", 1), (b"G", 2), (b"R", 1), (b"other", 2)],
        [[[q / 4 for q in line], [q / 2 for q in line], line, [9.0] * w] for line in v])
    exr("uint_and_half.exr", [(b"G", 0), (b"R", 1)], [[[1] * w, line] for line in v])
    exr("five_others.exr", [(bytes([c]), 1) for c in b"CDEFH"], [[line] * 5 for line in v])
    strips = folder / "strips.exr"
    global HERE
    kept, HERE = HERE, folder
    exr("strips.exr", [(b"Y", 2)],
        [[[wide(x, y) / 8192 for x in range(W)]] for y in range(H)])
    HERE = kept
    run("exrmaketiled", "-o", "-t", 16, 16, "-z", "zip", strips, HERE / "tiles.exr")
    for packing in "rle", "pxr24", "b44", "dwaa":
        run("exrmaketiled", "-o", "-t", 32, 32, "-z", packing, strips,
            HERE / f"tiles_{packing}.exr")
    run("exrmaketiled", "-m", "-t", 16, 16, "-z", "piz", strips, HERE / "tiles_mips.exr")


def npys():
    def npy(name, descr, fortran, shape, code, values, version=1):
        text = f"{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}"
        prefix = 10 if version == 1 else 12
        text += " " * (-(prefix + len(text) + 1) % 64) + "\n"
        length = struct.pack("<H" if version == 1 else "<I", len(text))
        (HERE / name).write_bytes(b"\x93NUMPY" + bytes([version, 0]) + length + text.encode()
                                  + struct.pack(code[0] + str(len(values)) + code[1], *values))

    w, h = SMALL
    values = grid(wide, SMALL)
    columns = [wide(x, y) for x in range(w) for y in range(h)]
    npy("big_endian_f8.npy", ">f8", False, (h, w), ">d", [v / 3 for v in values])
    npy("fortran_u2.npy", "<u2", True, (h, w), "<H", columns)
    npy("version2_i2.npy", "<i2", False, (h, w), "<h", [v - 2000 for v in values], version=2)
    npy("rgb_u1.npy", "|u1", False, (h, w, 3), "<B",
        [v + k for v in grid(byte, SMALL) for k in (0, 40, 80)])
    npy("complex.npy", "<c8", False, (h, w), "<f", values + values)
    npy("one_axis_f4.npy", "<f4", False, (15,), "<f", values)


def plain_texts():
    w, h = SMALL
    (HERE / "plain.pgm").write_text(
        "P2 # a comment\n# and another\n5\n3 2000\n"
        + "\n".join(map(str, grid(wide, SMALL))) + "\n")
    (HERE / "plain.ppm").write_text(
        "P3 5 3 255 " + " ".join(str(v + k) for v in grid(byte, SMALL) for k in (0, 40, 80)))
    (HERE / "maxval_1000.pgm").write_bytes(
        b"P5\n5 3\n1000\n" + struct.pack(">15H", *[10 * v for v in grid(byte, SMALL)]))


os.environ["SOURCE_DATE_EPOCH"] = "0"
with tempfile.TemporaryDirectory() as made:
    tiffs(pathlib.Path(made))
    pngs(pathlib.Path(made))
    exrs(pathlib.Path(made))
    npys()
    plain_texts()
