"""Reads the pictures that heightcast writes."""

import struct
import zlib


def read_picture(data):
    """(width, height, rows of RGB bytes) of an 8-bit RGB PNG."""
    width, height, depth, colour = struct.unpack_from(">IIBB", data, 16)
    assert (depth, colour) == (8, 2)
    packed, at = b"", 8
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        packed += data[at + 8 : at + 8 + length] if kind == b"IDAT" else b""
        at += length + 12
    raw, stride, rows = zlib.decompress(packed), 3 * width + 1, []
    before = bytes(3 * width)
    for y in range(height):
        line = bytearray(raw[y * stride + 1 : (y + 1) * stride])
        undo_filter(line, before, raw[y * stride])
        rows.append(bytes(line))
        before = line
    return width, height, rows


def undo_filter(line, before, kind):
    for i, value in enumerate(line):
        left = line[i - 3] if i >= 3 else 0
        corner = before[i - 3] if i >= 3 else 0
        up = before[i]
        guess = left + up - corner
        nearest = min((abs(guess - c), n, c) for n, c in enumerate((left, up, corner)))[2]
        line[i] = (value + (0, left, up, (left + up) // 2, nearest)[kind]) & 255
