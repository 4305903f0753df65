#!/usr/bin/env python3
"""make.py: writes the texture files of the golden cases beside itself. Needs nothing but Python.

Every file is small, lopsided in both directions, so that a flip or a swap shows, and of another kind of PNG or HDR.
"""
import math
import os
import struct
import zlib

FOLDER = os.path.dirname(os.path.abspath(__file__))
GREY, RGB, PALETTE, GREY_ALPHA, RGBA = 0, 2, 3, 4, 6
CHANNELS = {GREY: 1, RGB: 3, PALETTE: 1, GREY_ALPHA: 2, RGBA: 4}


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def packed_row(values, depth):
    if depth == 16:
        return b"".join(struct.pack(">H", v) for v in values)
    if depth == 8:
        return bytes(values)
    row, bits, used = bytearray(), 0, 0
    for v in values:
        bits, used = bits << depth | v, used + depth
        if used == 8:
            row.append(bits)
            bits, used = 0, 0
    if used:
        row.append(bits << (8 - used))
    return bytes(row)


ADAM7 = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)]


def write_png(name, width, height, kind, depth, texel, palette=None, alpha=None, interlaced=False):
    """texel(x, y) gives the channels, y from the top."""
    rows = bytearray()
    for x0, y0, dx, dy in ADAM7 if interlaced else [(0, 0, 1, 1)]:
        for y in range(y0, height, dy):
            values = [v for x in range(x0, width, dx) for v in texel(x, y)]
            if values:
                rows += b"\0" + packed_row(values, depth)
    data = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, depth, kind, 0, 0, int(interlaced)))
    if palette:
        data += chunk(b"PLTE", bytes(v for color in palette for v in color))
    if alpha:
        data += chunk(b"tRNS", bytes(alpha))
    data += chunk(b"IDAT", zlib.compress(bytes(rows), 9)) + chunk(b"IEND", b"")
    with open(os.path.join(FOLDER, name), "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + data)


def rgbe(color):
    top = max(color)
    if top < 1e-32:
        return (0, 0, 0, 0)
    mantissa, exponent = math.frexp(top)
    unit = mantissa * 256 / top
    return tuple(int(c * unit) for c in color) + (exponent + 128,)


def runs(values):
    """One component of a scan line: runs of four and more, the rest as they are."""
    out, i = bytearray(), 0
    while i < len(values):
        same = 1
        while i + same < len(values) and same < 127 and values[i + same] == values[i]:
            same += 1
        if same >= 4:
            out += bytes([128 + same, values[i]])
            i += same
            continue
        start = i
        while i < len(values) and i - start < 128 and len(set(values[i:i + 4])) > 1:
            i += 1
        i = max(i, start + 1)
        out += bytes([i - start]) + bytes(values[start:i])
    return bytes(out)


def write_hdr(name, width, height, texel, coded):
    data = b"#?RADIANCE\n# the golden cases\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width)
    for y in range(height):
        row = [rgbe(texel(x, y)) for x in range(width)]
        if coded:
            data += bytes([2, 2, width >> 8, width & 255])
            data += b"".join(runs([texel4[c] for texel4 in row]) for c in range(4))
        else:
            data += b"".join(bytes(texel4) for texel4 in row)
    with open(os.path.join(FOLDER, name), "wb") as file:
        file.write(data)


def level(value, top=255):
    return int(min(1, max(0, value)) * top + 0.5)


def colors(x, y):
    """8 x 6: hue along x, light above, an arrow's corner in white at the top left and one black texel beside."""
    if (x, y) == (0, 0):
        return (255, 255, 255)
    if (x, y) == (1, 0):
        return (0, 0, 0)
    hue = [(230, 40, 30), (230, 150, 20), (220, 220, 40), (60, 190, 50),
           (40, 200, 200), (40, 80, 220), (130, 50, 210), (220, 60, 160)][x]
    return tuple(v * (9 - y) // 9 for v in hue)


def bump(x, y, size, count, steepness):
    """Normals of count x count domes on a square, each with its top a little up and right of its middle."""
    u, v = (x + 0.5) / size * count % 1, (1 - (y + 0.5) / size) * count % 1
    dx, dy = (u - 0.55) * 2, (v - 0.6) * 2
    r = math.hypot(dx, dy)
    if r >= 0.8:
        return (0, 0, 1)
    tilt = steepness * math.sin(r / 0.8 * math.pi) / max(r, 1e-9)
    n = (dx * tilt, dy * tilt, 1)
    length = math.sqrt(sum(c * c for c in n))
    return tuple(c / length for c in n)


def normal_texel(n):
    return tuple(level(c / 2 + 0.5) for c in n)


def grazing(x, y):
    """16 columns of tilts from 0 to 84 degrees, to the right in the upper rows, up in the lower ones."""
    angle = math.radians(x * 5.6)
    across = math.sin(angle)
    return normal_texel((across, 0, math.cos(angle)) if y < 4 else (0, across, math.cos(angle)))


def sky(x, y):
    """32 x 16: blue above, warm at the horizon in the east, brown below, a bright patch high in the south-west."""
    up = math.cos((y + 0.5) / 16 * math.pi)
    east = 0.5 + 0.5 * math.sin((x + 0.5) / 32 * 2 * math.pi)
    if up < 0:
        return (0.12 + 0.1 * east, 0.09, 0.06 + 0.04 * (1 - east))
    if 3 <= y <= 4 and 5 <= x <= 6:
        return (6.0, 5.5, 4.5)
    glow = (1 - up) ** 3
    return (0.15 + 0.8 * glow * east, 0.25 + 0.45 * glow * east, 0.6 + 0.1 * glow)


def sun(x, y):
    """64 x 32: a sky of 0.1 and one texel 10^5 times as bright."""
    return (1e4, 0.9e4, 0.7e4) if (x, y) == (40, 8) else (0.08, 0.1, 0.14) if y < 16 else (0.05, 0.04, 0.03)


def main():
    write_png("colors.png", 8, 6, RGB, 8, colors)
    write_png("alpha.png", 8, 6, RGBA, 8, lambda x, y: colors(x, y) + (40 * y,))
    write_png("deep.png", 5, 3, RGB, 16,
              lambda x, y: (13000 * x + 700, 60000 - 17 * (x + 5 * y), 1000 + 257 * x + 20000 * y))
    write_png("grey1.png", 11, 5, GREY, 1, lambda x, y: ((x * x + 2 * y) % 3 == 0,))
    write_png("grey2.png", 7, 5, GREY, 2, lambda x, y: ((x + 2 * y) % 4,))
    write_png("grey4.png", 9, 5, GREY, 4, lambda x, y: ((2 * x + 3 * y) % 16,), interlaced=True)
    write_png("grey8.png", 6, 5, GREY, 8, lambda x, y: (40 * x + 11 * y,))
    write_png("grey16.png", 6, 5, GREY_ALPHA, 16, lambda x, y: (11000 * x + 1900 * y, 30000))
    entries = [(16 * i, 255 - 9 * i, (i * 67) % 256) for i in range(13)]
    write_png("palette4.png", 13, 3, PALETTE, 4, lambda x, y: ((x + 4 * y) % 13,), palette=entries)
    write_png("palette8.png", 9, 9, PALETTE, 8, lambda x, y: ((x * y + x) % 13,), palette=entries,
              alpha=[0, 128, 255, 20], interlaced=True)
    write_png("bumps.png", 48, 48, RGB, 8, lambda x, y: normal_texel(bump(x, y, 48, 2, 0.9)))
    write_png("steep.png", 48, 48, RGB, 8, lambda x, y: normal_texel(bump(x, y, 48, 2, 3.5)))
    write_png("grazing.png", 16, 8, RGB, 8, grazing)
    # As numbers only the first channel counts; the others would show.
    write_png("metal.png", 4, 4, RGB, 8, lambda x, y: (255 * ((x + y) % 2), 90, 200))
    write_png("rough.png", 8, 4, RGB, 8, lambda x, y: (60 + 26 * x, 255 - 20 * y, 0))
    write_png("closed.png", 6, 6, GREY, 8, lambda x, y: (30 + 20 * x + 24 * y,))
    write_hdr("sky.hdr", 32, 16, sky, True)
    write_hdr("sun.hdr", 64, 32, sun, True)
    write_hdr("quarters.hdr", 4, 2,
              lambda x, y: ([0.8, 0.1, 0.05][(x + y) % 3], [0.1, 0.7, 0.3][x % 3], 0.2 + 0.4 * y), False)


if __name__ == "__main__":
    main()
