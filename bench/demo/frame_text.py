#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A frame of tangency-dem (VTK XML, arrays appended and compressed) as text, an item a line.

Usage: frame_text.py FRAME.vtp: what particles.awk reads.
"""
import re
import struct
import sys
import zlib

CODES = {"Float64": "d", "Float32": "f", "Int32": "i"}


def array_at(appended, offset, order):
    """The bytes of an array: counts of 8 bytes, then its blocks."""
    blocks, size, last = struct.unpack_from(f"{order}3Q", appended, offset)
    lengths = struct.unpack_from(f"{order}{blocks}Q", appended, offset + 24)
    place = offset + 24 + 8 * blocks
    parts = []
    for length in lengths:
        parts.append(zlib.decompress(appended[place:place + length]))
        place += length
    return b"".join(parts)


with open(sys.argv[1], "rb") as file:
    head, appended = file.read().split(b'<AppendedData encoding="raw">\n_', 1)
order = ">" if b'byte_order="BigEndian"' in head else "<"
for tag in re.findall(r"<DataArray [^>]*>", head.decode()):
    name, kind = re.search(r'Name="([^"]*)"', tag)[1], re.search(r'type="([^"]*)"', tag)[1]
    components = re.search(r'NumberOfComponents="(\d+)"', tag)
    width = int(components[1]) if components else 1
    bytes_of = array_at(appended, int(re.search(r'offset="(\d+)"', tag)[1]), order)
    numbers = [number for (number,) in struct.iter_unpack(order + CODES[kind], bytes_of)]
    print(f'<DataArray Name="{"points" if name == "Points" else name}">')
    for k in range(0, len(numbers), width):
        print(*numbers[k:k + width])
    print("</DataArray>")
