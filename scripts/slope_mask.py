#!/usr/bin/env python3
"""A mask for heightcast render terrain --mask, from the slopes of a landscape:
   red where it is level and low, green where it is level and high, blue where it is steep, all
   three with soft borders; alpha is 0.

    scripts/slope_mask.py FIELD.npy MASK.png --spacing 74.5,92.5 --rise 840

FIELD: float32 heights 0 .. 1, as heightcast gen and heightcast bake --layout height write them.
"""

import argparse
import ast
import struct
import zlib


def read_npy(path):
    with open(path, "rb") as file:
        data = file.read()
    length = struct.unpack("<H", data[8:10])[0]
    head = ast.literal_eval(data[10:10 + length].decode("latin1"))
    height, width = head["shape"]
    first = 10 + length
    heights = struct.unpack(f"<{width * height}f", data[first:first + 4 * width * height])
    return width, height, heights


def write_png(path, width, height, texels):
    def chunk(name, body):
        return (struct.pack(">I", len(body)) + name + body
                + struct.pack(">I", zlib.crc32(name + body)))
    rows = b"".join(b"\0" + texels[4 * width * y:4 * width * (y + 1)] for y in range(height))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n"
                   + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def smooth(low, high, value):
    x = min(max((value - low) / (high - low), 0.0), 1.0)
    return x * x * (3.0 - 2.0 * x)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("field")
    parser.add_argument("mask")
    parser.add_argument("--spacing", default="1,1", help="world units between samples, X,Y")
    parser.add_argument("--rise", type=float, default=1.0, help="world units from height 0 to 1")
    parser.add_argument("--steep", type=float, default=0.35, help="slope where blue is a half")
    parser.add_argument("--high", type=float, default=0.5, help="height where green is a half")
    choices = parser.parse_args()
    width, height, heights = read_npy(choices.field)
    step_x, step_y = (float(word) for word in choices.spacing.split(","))
    texels = bytearray()
    for y in range(height):
        above, below = max(y - 1, 0), min(y + 1, height - 1)
        for x in range(width):
            left, right = max(x - 1, 0), min(x + 1, width - 1)
            slope_x = ((heights[y * width + right] - heights[y * width + left])
                       / max(right - left, 1) / step_x)
            slope_y = ((heights[below * width + x] - heights[above * width + x])
                       / max(below - above, 1) / step_y)
            slope = choices.rise * (slope_x ** 2 + slope_y ** 2) ** 0.5
            steep = smooth(0.6 * choices.steep, 1.4 * choices.steep, slope)
            high = smooth(choices.high - 0.15, choices.high + 0.15, heights[y * width + x])
            shares = ((1.0 - steep) * (1.0 - high), (1.0 - steep) * high, steep, 0.0)
            texels += bytes(int(255.0 * share + 0.5) for share in shares)
    write_png(choices.mask, width, height, bytes(texels))


if __name__ == "__main__":
    main()
