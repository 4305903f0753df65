#!/usr/bin/env python3
"""Writes the textures of scenes/textures: surfaces and three environments, each by a formula.

    textures.py FOLDER

The same command makes the same pixels. Surfaces repeat without a seam. A normal map has its x along u and its y
along v, upward in the picture. An environment is a map of latitude and longitude, looking along -z in its middle.
"""
import math
import os
import struct
import sys
import zlib


# Noise on a lattice, hashed, so that a file never depends on a generator of random numbers.

def hashed(*keys):
    """0 to 1 for whole numbers."""
    h = 0x9E3779B9
    for key in keys:
        h = (h ^ (key & 0xFFFFFFFF)) * 0x85EBCA6B & 0xFFFFFFFF
        h = (h ^ h >> 13) * 0xC2B2AE35 & 0xFFFFFFFF
        h ^= h >> 16
    return h / 0xFFFFFFFF


def smooth(t):
    return t * t * (3 - 2 * t)


def clamp(x, low=0.0, high=1.0):
    return min(max(x, low), high)


def step(low, high, x):
    return smooth(clamp((x - low) / (high - low)))


def mix(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def noise2(x, y, period_x, period_y, seed):
    """Value noise, 0 to 1, of whole periods."""
    i, j = math.floor(x), math.floor(y)
    s, t = smooth(x - i), smooth(y - j)
    a, b = (hashed(p % period_x, j % period_y, seed) for p in (i, i + 1))
    c, d = (hashed(p % period_x, (j + 1) % period_y, seed) for p in (i, i + 1))
    return (a + (b - a) * s) * (1 - t) + (c + (d - c) * s) * t


def noise3(p, seed):
    i = [math.floor(x) for x in p]
    t = [smooth(x - k) for x, k in zip(p, i)]
    total = 0.0
    for corner in range(8):
        at = [k + (corner >> axis & 1) for axis, k in enumerate(i)]
        weight = 1.0
        for axis in range(3):
            weight *= t[axis] if corner >> axis & 1 else 1 - t[axis]
        total += weight * hashed(*at, seed)
    return total


def fractal3(p, octaves, seed):
    total, amplitude = 0.0, 0.5
    for octave in range(octaves):
        total += amplitude * noise3([x * 2 ** octave for x in p], seed + octave)
        amplitude /= 2
    return total / (1 - 0.5 ** octaves)


# Files.

def encode(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def write_png(path, rows, channels):
    """Rows of levels from the top, filtered by differences to the left, which serves smooth surfaces."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    lines = []
    for row in rows:
        flat = [level for pixel in row for level in pixel]
        left = [0] * channels + flat[:-channels]
        lines.append(bytes([1]) + bytes((a - b) & 255 for a, b in zip(flat, left)))
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2 if channels == 3 else 0, 0, 0, 0)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                  chunk(b"IDAT", zlib.compress(b"".join(lines), 9)) + chunk(b"IEND", b""))


def rgbe(color):
    largest = max(color)
    if largest < 1e-32:
        return bytes(4)
    exponent = math.frexp(largest)[1]
    return bytes([min(int(math.ldexp(c, 8 - exponent)), 255) for c in color] + [exponent + 128])


def run_lengths(plane):
    """The new run-length form of Radiance: runs of four or more, and what lies between."""
    out, literal, i = bytearray(), bytearray(), 0

    def flush():
        for k in range(0, len(literal), 128):
            out.append(len(literal[k:k + 128]))
            out.extend(literal[k:k + 128])
        literal.clear()
    while i < len(plane):
        run = 1
        while i + run < len(plane) and run < 127 and plane[i + run] == plane[i]:
            run += 1
        if run >= 4:
            flush()
            out.extend((128 + run, plane[i]))
        else:
            literal.extend(plane[i:i + run])
        i += run
    flush()
    return bytes(out)


def write_hdr(path, width, height, radiance):
    """radiance takes a direction; rows from the top, v = acos(y) / pi."""
    with open(path, "wb") as out:
        out.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
        for y in range(height):
            polar = math.pi * (y + 0.5) / height
            line = []
            for x in range(width):
                azimuth = 2 * math.pi * ((x + 0.5) / width - 0.5)
                line.append(rgbe(radiance((math.sin(polar) * math.sin(azimuth), math.cos(polar),
                                           -math.sin(polar) * math.cos(azimuth)))))
            out.write(bytes([2, 2, width >> 8, width & 255]))
            for channel in range(4):
                out.write(run_lengths(bytes(texel[channel] for texel in line)))


def colors(size, color):
    """color takes u and v; its linear value is stored sRGB-encoded."""
    return [[tuple(round(255 * clamp(encode(clamp(c)))) for c in color((x + 0.5) / size, 1 - (y + 0.5) / size))
             for x in range(size)] for y in range(size)]


def normals(size, height, depth):
    """height takes u and v, 0 to 1; depth is that of 1 in units of the texture's side."""
    field = [[height((x + 0.5) / size, 1 - (y + 0.5) / size) for x in range(size)] for y in range(size)]
    rows = []
    for y in range(size):
        row = []
        for x in range(size):
            du = (field[y][(x + 1) % size] - field[y][x - 1]) * depth * size / 2
            dv = (field[y - 1][x] - field[(y + 1) % size][x]) * depth * size / 2
            length = math.sqrt(du * du + dv * dv + 1)
            row.append(tuple(round(127.5 + 127.5 * c / length) for c in (-du, -dv, 1)))
        rows.append(row)
    return rows


# Surfaces.

def brick_at(u, v):
    """Column and row of the brick, and how deep inside it the point lies, in heights of a brick."""
    rows, columns = 8, 4
    row = math.floor(v * rows)
    across = u * columns + (0.5 if row % 2 else 0)
    column = math.floor(across) % columns
    across, up = across % 1, v * rows % 1
    wave = 0.03 * (noise2(u * 32, v * 32, 32, 32, 5) - 0.5)
    return column, row, min(min(across, 1 - across) * 2, min(up, 1 - up)) + wave


def brick_color(u, v):
    column, row, inside = brick_at(u, v)
    pick = hashed(column, row, 1)
    body = mix((0.36, 0.115, 0.065), (0.50, 0.21, 0.12), pick)
    body = mix(body, (0.20, 0.085, 0.065), 0.8 if hashed(column, row, 2) > 0.82 else 0)
    grain = 0.7 * noise2(u * 64, v * 64, 64, 64, 3) + 0.3 * noise2(u * 170, v * 170, 170, 170, 4)
    mortar = (0.40 + 0.1 * grain, 0.37 + 0.1 * grain, 0.32 + 0.1 * grain)
    return mix(mortar, tuple(c * (0.75 + 0.5 * grain) for c in body), step(0.06, 0.11, inside))


def brick_height(u, v):
    column, row, inside = brick_at(u, v)
    rough = 0.75 * noise2(u * 48, v * 48, 48, 48, 6) + 0.25 * noise2(u * 120, v * 120, 120, 120, 7)
    return step(0.04, 0.17, inside) * (0.8 + 0.2 * hashed(column, row, 8)) + 0.22 * rough


def plank_at(u, v):
    """Number of the plank, where its point lies along and across the grain, and the depth inside it."""
    planks = 4
    plank = math.floor(v * planks)
    return plank, u + hashed(plank, 20), v * planks % 1, min(v * planks % 1, 1 - v * planks % 1)


def wood_color(u, v):
    plank, along, across, inside = plank_at(u, v)
    # The rings of a trunk, cut along it: wide in the middle, and drawn out.
    bend = noise2(along * 3, across * 2, 3, 64, 21 + plank) + 0.3 * noise2(along * 8, across * 5, 8, 64, 31 + plank)
    ring = (5.5 * abs(across - 0.3 - 0.4 * hashed(plank, 22)) + 2.2 * bend) % 1
    ring = step(0, 0.75, ring) * (1 - step(0.88, 1, ring))
    fibre = noise2(along * 24, across * 90, 24, 360, 41 + plank)
    color = mix((0.43, 0.225, 0.095), (0.26, 0.115, 0.042), ring)
    color = tuple(c * (0.84 + 0.22 * fibre) * (0.82 + 0.36 * hashed(plank, 23)) for c in color)
    return mix((0.03, 0.015, 0.008), color, step(0.004, 0.022, inside))


def tile_at(u, v):
    """A point in its tile, -1 to 1, four tiles in the texture."""
    return 4 * (u % 0.5) - 1, 4 * (v % 0.5) - 1


def tile_inside(u, v):
    x, y = tile_at(u, v)
    return 1 - max(abs(x), abs(y))


def tile_color(u, v):
    x, y = tile_at(u, v)
    radius, angle = math.hypot(x, y), math.atan2(y, x)
    edge = 0.012
    petals = 0.62 * abs(math.cos(2 * angle)) ** 0.55
    blue, deep, yellow, white = (0.05, 0.16, 0.42), (0.015, 0.05, 0.20), (0.72, 0.42, 0.06), (0.80, 0.78, 0.72)
    color = mix(blue, white, step(-edge, edge, radius - petals))
    color = mix(color, deep, step(-edge, edge, petals - 0.10 - radius))
    color = mix(yellow, color, step(-edge, edge, radius - 0.15))
    corner = math.hypot(1 - abs(x), 1 - abs(y))
    ring = abs(corner - 0.42)
    color = mix(deep, color, step(0.045 - edge, 0.045 + edge, ring))
    color = mix(yellow, color, step(-edge, edge, corner - 0.24))
    diamond = abs(abs(x) + abs(y) - 0.98) if corner > 0.46 else 1.0
    color = mix(blue, color, step(0.02 - edge, 0.02 + edge, diamond))
    return mix((0.42, 0.40, 0.36), color, step(0.03, 0.045, tile_inside(u, v)))


def tile_height(u, v):
    return step(0.02, 0.10, tile_inside(u, v))


def tile_roughness(size):
    return [[(round(255 * (0.75 - 0.67 * step(0.03, 0.06, tile_inside((x + 0.5) / size, (y + 0.5) / size)))),)
             for x in range(size)] for y in range(size)]


def hammered_height(u, v):
    """Dents about scattered centres: the lowest of the bowls that reach a point."""
    cells = 9
    x, y = u * cells, v * cells
    nearest = 9.0
    for j in range(math.floor(y) - 1, math.floor(y) + 2):
        for i in range(math.floor(x) - 1, math.floor(x) + 2):
            a = i + 0.15 + 0.7 * hashed(i % cells, j % cells, 51)
            b = j + 0.15 + 0.7 * hashed(i % cells, j % cells, 52)
            nearest = min(nearest, (a - x) ** 2 + (b - y) ** 2)
    return nearest


# Environments.

SUN = (-0.62, 0.62, -0.30)
NOON_SUN = (-0.62, 0.75, 0.42)


def normalized(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def sky(direction):
    x, y, z = direction
    cosine = sum(a * b for a, b in zip(direction, normalized(SUN)))
    if y < 0:
        near = mix((0.30, 0.30, 0.29), (0.13, 0.12, 0.10), step(0, 0.5, -y))
        return mix((0.62, 0.64, 0.66), near, step(0, 0.06, -y))
    blue = mix((0.72, 0.80, 0.90), (0.10, 0.22, 0.52), 1 - (1 - y) ** 2.2)
    glow = 1.6 * max(cosine, 0) ** 90 + 0.45 * max(cosine, 0) ** 8
    blue = tuple(c + glow * w for c, w in zip(blue, (1.0, 0.86, 0.66)))
    # Clouds on a plane above, thinner towards the horizon where they would crowd.
    at = (x / (y + 0.16) * 1.1 + 3.1, 0.5, z / (y + 0.16) * 1.1 + 7.7)
    cover = step(0.46, 0.68, fractal3(at, 5, 61)) * step(0.02, 0.22, y)
    lit = 0.80 + 0.75 * max(cosine, 0) ** 6 - 0.25 * fractal3([3 * c for c in at], 3, 71)
    color = mix(blue, (1.12 * lit, 1.08 * lit, 1.04 * lit), 0.9 * cover)
    angle = math.degrees(math.acos(clamp(cosine, -1, 1)))
    sun = 2600 * (1 - step(0.6, 2.4, angle))
    return tuple(c + sun * w for c, w in zip(color, (1.0, 0.88, 0.70)))


def room(direction):
    """A dim room with a window at the left, a lamp's screen behind the viewer and a bright ceiling."""
    x, y, z = direction
    wall = mix((0.10, 0.085, 0.07), (0.24, 0.215, 0.19), step(-0.6, 0.9, y))
    azimuth, height = math.degrees(math.atan2(x, -z)), math.degrees(math.asin(clamp(y, -1, 1)))
    frame = step(-98, -93, azimuth) * (1 - step(-40, -35, azimuth)) * step(0, 4, height) * (1 - step(48, 52, height))
    bars = step(1.2, 2.6, abs(azimuth + 66)) * step(1.2, 2.6, abs(height - 27))
    window = frame * bars
    lamp = step(112, 118, azimuth) * (1 - step(146, 152, azimuth)) * step(8, 14, height) * (1 - step(44, 50, height))
    color = mix(wall, (4.2, 4.7, 5.4), window)
    return mix(color, (3.4, 2.5, 1.6), lamp)


def noon(direction):
    """A cloudless sky of rings about the zenith, over grey ground; the sun, five degrees wide, has a glow about it.

    Rows are constant but for the glow, which leaves the run-length form little to store.
    """
    y = direction[1]
    if y < 0:
        color = mix((0.50, 0.53, 0.56), (0.22, 0.21, 0.19), step(0, 0.35, -y))
    else:
        color = mix((0.62, 0.70, 0.80), (0.12, 0.25, 0.56), 1 - (1 - y) ** 2.5)
    cosine = sum(a * b for a, b in zip(direction, normalized(NOON_SUN)))
    angle = math.degrees(math.acos(clamp(cosine, -1, 1)))
    light = 0.9 * (1 - step(0, 13, angle)) ** 3 + 100 * (1 - step(2.3, 2.7, angle))
    return tuple(c + light * w for c, w in zip(color, (1.0, 0.90, 0.76)))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.strip())

    def path(name):
        return os.path.join(sys.argv[1], name)
    write_png(path("bricks.png"), colors(512, brick_color), 3)
    write_png(path("bricks_normal.png"), normals(512, brick_height, 0.018), 3)
    write_png(path("wood.png"), colors(512, wood_color), 3)
    write_png(path("tiles.png"), colors(512, tile_color), 3)
    write_png(path("tiles_normal.png"), normals(256, tile_height, 0.02), 3)
    write_png(path("tiles_roughness.png"), tile_roughness(256), 1)
    write_png(path("hammered_normal.png"), normals(256, hammered_height, 0.05), 3)
    write_hdr(path("sky.hdr"), 256, 128, sky)
    write_hdr(path("room.hdr"), 128, 64, room)
    write_hdr(path("noon.hdr"), 1024, 512, noon)


if __name__ == "__main__":
    main()
