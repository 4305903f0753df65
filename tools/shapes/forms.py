"""The shapes that are made of patches: number of triangles -> patches."""
import math

from shapes.patch import TURN, Patch, cross, lathe, lerp, minus, pieces, smooth, spline, tube, unit


def knot(triangles):
    """A cable of five strands, laid as a trefoil knot; about 6 across."""
    strands = 5
    columns, rows = pieces(triangles / 2 / strands, 38)

    def core(t):
        a = TURN * t
        radius = 2 + 0.85 * math.cos(3 * a)
        return radius * math.cos(2 * a), radius * math.sin(2 * a), 0.85 * math.sin(3 * a)

    def away(number):
        """From the core to the strand."""
        def at(t):
            step, a = 1e-4, TURN * t
            first = (math.cos(3 * a) * math.cos(2 * a), math.cos(3 * a) * math.sin(2 * a), math.sin(3 * a))
            second = cross(unit(minus(core(t + step), core(t - step))), first)
            turn = TURN * (number / strands + 16 * t)
            return tuple(math.cos(turn) * x + math.sin(turn) * y for x, y in zip(first, unit(second)))
        return at

    def strand(number):
        outward = away(number)
        return lambda t: tuple(c + 0.27 * o for c, o in zip(core(t), outward(t)))

    return [tube(strand(n), lambda t, angle: 0.165, columns, rows, "strand_%d" % (n + 1), True, away(n))
            for n in range(strands)]


def ball(triangles):
    """A sphere of radius 1 with dents and lumps."""
    columns, rows = pieces(triangles / 2, 0.5)
    waves = []
    state = 12345
    for k in range(24):
        numbers = []
        for _ in range(4):
            state = (state * 1103515245 + 12345) % 2 ** 31
            numbers.append(state / 2 ** 30 - 1)
        frequency = 2.5 * 1.17 ** k
        if 8 * frequency > columns:
            break  # too fine for so few
        waves.append((*(frequency * d for d in unit(numbers[:3])), math.pi * numbers[3], 0.22 / frequency))

    def point(i, j):
        latitude, longitude = math.pi * (i / rows - 0.5), TURN * j / columns
        c = math.cos(latitude) if 0 < i < rows else 0.0
        d = (c * math.sin(longitude), math.sin(latitude), c * math.cos(longitude))
        r = 1 + sum(a * (1 - 2 * abs(math.sin(x * d[0] + y * d[1] + z * d[2] + w)))
                    for x, y, z, w, a in waves)
        return d[0] * r, d[1] * r, d[2] * r

    return [Patch([[point(i, j) for j in range(columns)] for i in range(rows + 1)], "ball", around=True)]


def gear(triangles):
    """A wheel of 18 teeth, of radius 1 and thickness 0.3, about z."""
    teeth, half, bore = 18, 0.15, 0.28
    columns = teeth * 8 * max(1, round(triangles / (teeth * 8 * 2 * 12)))

    def tooth(j):
        place = j * teeth / columns % 1
        return 0.8 + 0.2 * smooth((0.38 - abs(place - 0.5)) / 0.2)

    def ring(radius, z):
        at = radius if callable(radius) else lambda j: radius
        return [(at(j) * math.cos(TURN * j / columns), at(j) * math.sin(TURN * j / columns), z)
                for j in range(columns)]

    profile = ((bore, half), (0.40, half), (0.44, half / 2), (0.70, half / 2), (0.74, half), (tooth, half))
    patches = []
    for (inner, low), (outer, high) in zip(profile, profile[1:]):
        patches.append(Patch([ring(outer, high), ring(inner, low)], "face", around=True))
        patches.append(Patch([ring(inner, -low), ring(outer, -high)], "face", around=True))
    patches.append(Patch([ring(tooth, -half), ring(tooth, half)], "teeth", around=True))
    patches.append(Patch([ring(bore, half), ring(bore, -half)], "bore", around=True))
    return patches


def pot(triangles):
    """A pot with a spout, a handle and a lid; 1 high, the spout towards +x."""
    scale = math.sqrt(triangles / 9000)
    n = lambda count: max(4, round(count * scale))
    belly = spline([(0.36, 0.03), (0.44, 0.06), (0.585, 0.22), (0.62, 0.38), (0.55, 0.56), (0.40, 0.685),
                    (0.335, 0.72), (0.33, 0.745)])
    body = lathe(lambda t: belly(0.12 + 0.88 * t), n(72), n(26), "glaze")
    foot = lathe(spline([(0.0, 0.02), (0.30, 0.02), (0.33, 0.0), (0.40, 0.0), (0.42, 0.02),
                         belly(0.12)]), n(72), n(8), "foot")
    rim = lathe(spline([(0.33, 0.745), (0.338, 0.76), (0.325, 0.775), (0.30, 0.765), (0.29, 0.74)]),
                n(72), n(5), "foot")
    lid = lathe(spline([(0.31, 0.762), (0.30, 0.785), (0.20, 0.835), (0.08, 0.862), (0.05, 0.875)]),
                n(64), n(10), "glaze")
    knob = lathe(spline([(0.05, 0.875), (0.048, 0.89), (0.085, 0.93), (0.075, 0.975), (0.03, 0.998),
                         (0.0, 1.0)]), n(32), n(10), "foot")
    spout_curve = spline([(0.46, 0.27, 0.0), (0.68, 0.33, 0.0), (0.79, 0.48, 0.0), (0.86, 0.62, 0.0),
                          (0.98, 0.72, 0.0)])
    taper = lambda wide, narrow: lambda t, angle: lerp(wide, narrow, math.sqrt(t))
    spout, inner = (tube(spout_curve, taper(wide, narrow), n(28), n(24), "glaze")
                    for wide, narrow in ((0.135, 0.052), (0.115, 0.04)))
    inner.rows.reverse()
    lip = Patch([spout.rows[-1], inner.rows[0]], "foot", around=True)
    handle_curve = spline([(-0.47, 0.60, 0.0), (-0.70, 0.65, 0.0), (-0.90, 0.56, 0.0), (-0.88, 0.36, 0.0),
                           (-0.72, 0.24, 0.0), (-0.53, 0.20, 0.0)])
    handle = tube(handle_curve, lambda t, angle: 0.048 + 0.012 * math.cos(2 * angle), n(20), n(36), "glaze")
    return [body, foot, rim, lid, knob, spout, inner, lip, handle]


def vase(triangles):
    """A vase with a wall of glass, 1 high; its surface is closed."""
    columns, rows = pieces(triangles / 2, 1.4)
    # Up the outside, over the rim, down the inside: a closed curve from the axis to the axis.
    profile = spline([(0.0, 0.0), (0.10, 0.0), (0.19, 0.004), (0.215, 0.025), (0.19, 0.06), (0.24, 0.16),
                      (0.325, 0.32), (0.335, 0.46), (0.26, 0.62), (0.15, 0.75), (0.135, 0.83), (0.18, 0.93),
                      (0.255, 0.99), (0.265, 1.0), (0.258, 1.005), (0.235, 0.985), (0.155, 0.92),
                      (0.105, 0.83), (0.12, 0.75), (0.23, 0.61), (0.30, 0.46), (0.29, 0.33), (0.21, 0.18),
                      (0.10, 0.105), (0.0, 0.09)])

    wall = lathe(profile, columns, rows, "glass")
    for row in wall.rows:  # flutes that wind about it
        for j, (x, y, z) in enumerate(row):
            depth = 0.035 * smooth(y / 0.1) * smooth((1 - y) / 0.2)
            wave = 1 + depth * math.sin(12 * (TURN * j / columns + 1.1 * y))
            row[j] = (x * wave, y, z * wave)
    return [wall]


def tumbler(triangles):
    """A straight drinking glass with a thick bottom, 1 high; its surface is closed."""
    columns, rows = pieces(triangles / 2, 1.2)
    profile = spline([(0.0, 0.012), (0.12, 0.010), (0.24, 0.0), (0.285, 0.012), (0.30, 0.05), (0.32, 0.25),
                      (0.36, 0.62), (0.397, 0.97), (0.397, 0.993), (0.388, 1.0), (0.379, 0.993), (0.375, 0.97),
                      (0.338, 0.62), (0.300, 0.25), (0.285, 0.16), (0.24, 0.128), (0.12, 0.122), (0.0, 0.12)])
    return [lathe(profile, columns, rows, "glass")]


def goblet(triangles):
    """A wine glass on a stem, 1 high; its surface is closed."""
    columns, rows = pieces(triangles / 2, 2.0)
    profile = spline([(0.0, 0.015), (0.10, 0.008), (0.22, 0.0), (0.245, 0.006), (0.235, 0.018), (0.12, 0.032),
                      (0.045, 0.06), (0.026, 0.13), (0.022, 0.25), (0.026, 0.37), (0.06, 0.43), (0.17, 0.50),
                      (0.255, 0.60), (0.275, 0.70), (0.25, 0.84), (0.212, 0.985), (0.211, 0.996), (0.206, 1.0),
                      (0.201, 0.996), (0.201, 0.985), (0.238, 0.84), (0.262, 0.70), (0.242, 0.605), (0.16, 0.515),
                      (0.06, 0.455), (0.0, 0.445)])
    return [lathe(profile, columns, rows, "glass")]


def bloom(triangles):
    """The six petals of a tulip, 1 high, open above; sheets without thickness."""
    columns = max(2, round(math.sqrt(triangles / 12 / 1.6)))
    rows = max(3, round(triangles / 12 / columns))
    cup = spline([(0.03, 0.0), (0.22, 0.05), (0.36, 0.28), (0.37, 0.52), (0.31, 0.76), (0.30, 1.0)])
    patches = []
    for petal in range(6):
        inner = petal % 2
        points = []
        for i in range(rows + 1):
            t = i / rows
            width = 0.70 * math.sqrt(max(0.02, math.sin(math.pi * (0.18 + 0.82 * t)))) * (1 - 0.25 * t ** 4)
            radius, height = cup(t)
            row = []
            for j in range(columns + 1):
                s = (2 * j / columns - 1) * width
                angle = TURN * petal / 6 + s
                bulge = 1 - 0.1 * inner - 0.12 * s * s * (1 - t) + 0.05 * math.sin(4.3 * s + 5 * t + petal)
                y = height * (0.96 + 0.05 * inner) - 0.08 * s * s * t
                row.append((bulge * radius * math.sin(angle), y, bulge * radius * math.cos(angle)))
            points.append(row)
        patches.append(Patch(points, "petal"))
    return patches


def stalk(triangles):
    """The stem and the leaves of a tulip, 1 high, without the bloom."""
    scale = math.sqrt(triangles / 160)
    n = lambda count: max(3, round(count * scale))
    stem = tube(spline([(0.0, 0.0, 0.0), (0.01, 0.4, 0.006), (0.0, 0.8, 0.004), (0.0, 1.0, 0.0)]),
                lambda t, angle: 0.022, n(5), n(4), "leaf")
    patches = [stem]
    for turn, length, lean in ((0.3, 0.95, 0.38), (2.5, 0.85, 0.52), (4.5, 0.72, 0.30)):
        columns, rows = max(2, round(2 * scale)), n(8)
        c, s = math.cos(turn), math.sin(turn)
        points = []
        for i in range(rows + 1):
            t = i / rows
            out, up = lean * t ** 1.7 + 0.02, length * (t - 0.28 * lean * t ** 3)
            width = 0.085 * max(0.04, math.sin(math.pi * (0.12 + 0.88 * t))) ** 0.8
            row = []
            for j in range(columns + 1):
                x = (2 * j / columns - 1) * width
                z = out - 0.5 * abs(x)  # folded along its middle
                row.append((c * x + s * z, up, c * z - s * x))
            points.append(row)
        patches.append(Patch(points, "leaf"))
    return patches
