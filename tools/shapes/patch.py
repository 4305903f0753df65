"""Patches, which meshes are made of, and ways to make them: lathes and tubes."""
import math

TURN = 2 * math.pi


class Patch:
    """Points in rows. A quad lies between each two rows and columns, seen from where rows go up and columns
    to the right; `around` joins the last column to the first, `along` the last row to the first."""

    def __init__(self, rows, material=None, around=False, along=False):
        self.rows, self.material, self.around, self.along = rows, material, around, along

    def normals(self):
        """One a point, from its neighbours; at an edge from those that it has."""
        def near(values, i, closed):
            last = len(values) - 1
            if closed:
                return values[i - 1], values[i + 1 if i < last else 0]
            return values[max(i - 1, 0)], values[min(i + 1, last)]

        for i, row in enumerate(self.rows):
            below, above = near(self.rows, i, self.along)
            normals = []
            for j in range(len(row)):
                left, right = near(row, j, self.around)
                normals.append(unit(cross(minus(right, left), minus(above[j], below[j]))))
            if row.count(row[0]) == len(row):  # a pole, where all columns are one point
                normals = [unit(ring_area(above) if row is below else ring_area(below[::-1]))] * len(row)
            yield normals


def minus(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    length = math.hypot(*a)
    return (a[0] / length, a[1] / length, a[2] / length) if length > 1e-12 else (0.0, 0.0, 0.0)


def ring_area(ring):
    """Twice the area of a closed ring, as a vector that points to where it goes round clockwise."""
    total = (0.0, 0.0, 0.0)
    for a, b in zip(ring, ring[1:] + ring[:1]):
        total = minus(total, cross(a, b))
    return total


def lerp(a, b, t):
    return a + (b - a) * t


def smooth(t):
    t = min(max(t, 0.0), 1.0)
    return t * t * (3 - 2 * t)


def pieces(count, of):
    """How many columns and rows share out `count` quads where a row of quads is `of` times as long."""
    columns = max(3, round(math.sqrt(count / of)))
    return columns, max(3, round(count / columns))


def lathe(profile, columns, rows, material=None):
    """Turns a curve, t in 0..1 -> (radius, height), about y; seen from outside where it goes up."""
    points = []
    for i in range(rows + 1):
        radius, height = profile(i / rows)
        radius = radius if abs(radius) > 1e-9 else 0.0  # a pole
        points.append([(radius * math.sin(TURN * j / columns), height, radius * math.cos(TURN * j / columns))
                       for j in range(columns)])
    return Patch(points, material, around=True)


def spline(points):
    """A smooth curve through the points, t in 0..1 (Catmull and Rom)."""
    ends = [points[0], *points, points[-1]]

    def at(t):
        place = min(max(t, 0.0), 1.0) * (len(points) - 1)
        i = min(int(place), len(points) - 2)
        f = place - i
        return tuple(0.5 * (2 * b + (c - a) * f + (2 * a - 5 * b + 4 * c - d) * f * f
                            + (3 * b - a - 3 * c + d) * f ** 3) for a, b, c, d in zip(*ends[i:i + 4]))
    return at


def tube(curve, radius, columns, rows, material=None, closed=False, up=lambda t: (0.0, 0.0, 1.0)):
    """A tube about a curve, t in 0..1 -> point; radius(t, angle). up(t) is never along the curve."""
    points = []
    for i in range(rows if closed else rows + 1):
        t, step = i / rows, 1e-4
        tangent = unit(minus(curve(t + step), curve(t - step)))
        side = unit(cross(up(t), tangent))
        other = cross(tangent, side)
        center = curve(t)
        ring = []
        for j in range(columns):
            angle = TURN * j / columns
            c, s, r = math.cos(angle), math.sin(angle), radius(t, angle)
            ring.append(tuple(center[k] + r * (c * side[k] + s * other[k]) for k in range(3)))
        points.append(ring)
    return Patch(points, material, around=True, along=closed)
