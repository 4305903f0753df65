"""The island: a field of heights."""
import math

from shapes.patch import TURN, cross, minus, smooth, unit

RADIUS = 500.0  # half the edge of the field
SHORE = -3.0    # what lies deeper is left out; the sea is at 0
GRADIENTS = [(math.cos(TURN * k / 64), math.sin(TURN * k / 64)) for k in range(64)]


def gradient(i, j, seed):
    h = (i * 374761393 + j * 668265263 + seed * 974634777) & 0xffffffff
    h = ((h ^ (h >> 13)) * 1274126177) & 0xffffffff
    return GRADIENTS[(h ^ (h >> 16)) & 63]


def fade(f):
    return f * f * f * (f * (6 * f - 15) + 10), 30 * f * f * (f - 1) * (f - 1)


class NoiseRow:
    """Gradient noise (Perlin) of a plane along a line of constant z: what depends on z alone is computed
    once."""

    def __init__(self, z, low, high, seed):
        j = math.floor(z)
        f = z - j
        s, slope = fade(f)
        self.first = math.floor(low)
        self.corners = []
        for i in range(self.first, math.floor(high) + 2):
            ax, az = gradient(i, j, seed)
            bx, bz = gradient(i, j + 1, seed)
            a, b = az * f, bz * (f - 1)
            self.corners.append((ax + s * (bx - ax), a + s * (b - a),
                                 slope * (bx - ax), az + s * (bz - az) + slope * (b - a)))

    def at(self, x):
        """Value, and its derivatives by x and by z."""
        i = math.floor(x)
        f = x - i
        a, b = self.corners[i - self.first], self.corners[i - self.first + 1]
        t = f * f * f * (f * (6 * f - 15) + 10)
        v, w = a[0] * f + a[1], b[0] * (f - 1) + b[1]
        p, q = a[2] * f + a[3], b[2] * (f - 1) + b[3]
        return (v + t * (w - v), a[0] + t * (b[0] - a[0]) + 30 * f * f * (f - 1) * (f - 1) * (w - v),
                p + t * (q - p))


def heights_of_row(z, xs, step):
    """Heights along a row. Waves shorter than twice the step are left out."""
    coast = [(f, w, NoiseRow(z * f + 7.3, xs[0] * f, xs[-1] * f, s))
             for f, w, s in ((0.0052, 0.30, 11), (0.013, 0.13, 12), (0.031, 0.05, 13), (0.11, 0.012, 14))]
    octaves = []
    frequency, weight, seed = 0.0040, 1.0, 21
    while frequency * 2 * step < 1:
        octaves.append((frequency, weight, NoiseRow(z * frequency + 3.1 * seed, xs[0] * frequency,
                                                    xs[-1] * frequency, seed)))
        frequency, weight, seed = frequency * 1.93, weight * 0.535, seed + 1
    heights = []
    for x in xs:
        away = math.hypot(x / 0.93, z / 0.78) / RADIUS
        shape = 0.70 - away + (sum(w * noise.at(x * f)[0] for f, w, noise in coast) if away < 1.3 else 0)
        if shape < -0.12:
            heights.append(-60.0)
            continue
        total, dx, dz = 0.0, 0.0, 0.0
        for f, w, noise in octaves:  # steep places get less of what is finer: valleys fill, ridges stay
            n, nx, nz = noise.at(x * f)
            dx, dz = dx + w * nx, dz + w * nz
            total += w * (1 - 2.2 * abs(n)) / (1 + 0.55 * (dx * dx + dz * dz))
        rise = smooth(shape / 0.6)
        heights.append(shape * 45 + rise * (8 + 92 * max(total, 0.0) * (0.15 + 0.85 * rise)))
    return heights


def grain(i, j):
    """-1 .. 1, without order."""
    return GRADIENTS[(i * 40503 ^ j * 30011 ^ (i * j) >> 3) & 63][0]


def material_of(corners, grain):
    """By height and steepness; grain, -1 .. 1, frays the borders."""
    height = sum(p[1] for p in corners) / 3
    level = abs(unit(cross(minus(corners[1], corners[0]), minus(corners[2], corners[0])))[1])
    frayed = height + 3 * grain
    if height < 2.6 + 0.4 * grain:
        return "sand"
    if height > 105 and level > 0.84 - 0.007 * (frayed - 105):
        return "snow"
    if level < 0.76 - 0.0009 * frayed or frayed > 112:
        return "rock"
    return "meadow" if frayed < 18 or level > 0.965 else "forest"


def field(count):
    """Rows of heights of a field of count x count quads, with the places of their points."""
    step = 2 * RADIUS / count
    xs = [-RADIUS + step * i for i in range(count + 1)]
    return xs, [heights_of_row(z, xs, step) for z in xs]


def quads(rows):
    for i in range(len(rows) - 1):
        for j in range(len(rows) - 1):
            if max(rows[i][j], rows[i][j + 1], rows[i + 1][j], rows[i + 1][j + 1]) > SHORE:
                yield i, j


def write(triangles, writer):
    """An island with mountains, 1000 across, the sea at the height 0."""
    trial = 96
    share = sum(1 for _ in quads(field(trial)[1])) / trial ** 2
    count = max(4, round(math.sqrt(triangles / 2 / share)))
    xs, rows = field(count)
    numbers, faces = {}, {}
    for i, j in quads(rows):
        corners = []
        for k, l in ((i + 1, j), (i + 1, j + 1), (i, j + 1), (i, j)):
            point = (xs[l], rows[k][l], xs[k])
            if (k, l) not in numbers:
                numbers[k, l] = writer.vertex(point)
            corners.append((numbers[k, l], point))
        number, points = zip(*corners)
        first, second = (material_of(three, grain(i, j)) for three in (points[:3], (points[0], *points[2:])))
        if first == second:
            faces.setdefault(first, []).append(number)
        else:
            faces.setdefault(first, []).append(number[:3])
            faces.setdefault(second, []).append((number[0], *number[2:]))
    for material in sorted(faces):
        writer.material(material)
        for face in faces[material]:
            writer.face(face)
