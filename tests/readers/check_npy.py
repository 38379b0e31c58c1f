#!/usr/bin/env python3
"""Read NAME.npy as NumPy does (with NumPy itself where it is installed) and compare with
NAME.samples."""

import ast
import pathlib
import struct
import sys

try:
    import numpy
except ImportError:
    numpy = None

SIZES = {"|u1": 1, "<u2": 2, "<f4": 4}


def check(name):
    data = pathlib.Path(name + ".npy").read_bytes()
    samples = pathlib.Path(name + ".samples").read_bytes()
    assert data[:8] == b"\x93NUMPY\x01\x00", "magic"
    length = struct.unpack("<H", data[8:10])[0]
    text = data[10 : 10 + length].decode("latin1")
    assert (10 + length) % 64 == 0 and text.endswith("\n"), "alignment"
    assert "# heightcast=1 content=" in text, "metadata"
    header = ast.literal_eval(text)
    assert set(header) == {"descr", "fortran_order", "shape"}, header
    assert not header["fortran_order"], header
    assert header["shape"][:2] == (21, 37), header
    channels = header["shape"][2] if len(header["shape"]) == 3 else 1
    assert len(samples) == 21 * 37 * channels * SIZES[header["descr"]], header
    assert data[10 + length :] == samples, "samples"
    if numpy is not None:
        array = numpy.load(name + ".npy")
        assert array.shape == header["shape"] and array.tobytes() == samples, "numpy"


for argument in sys.argv[1:]:
    try:
        check(argument)
    except AssertionError as error:
        sys.exit(f"check_npy: {argument}.npy: {error}")
