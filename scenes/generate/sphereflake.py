#!/usr/bin/env python3
"""Writes the sphereflake of scenes/sphereflake.txt with every sphere spelled out.

    sphereflake.py [--depth N] [--size WxH] [--samples N] [--pov] > sphereflake_flat.txt

Depth 5, the default, is 66 430 spheres. --pov writes the same scene for POV-Ray; render it with
    povray +Isphereflake.pov +Osphereflake.png +W1024 +H1024 -D -A
"""
import argparse
import math
import sys

CAMERA = ((0.75, 1.0, 2.45), (0.0, 0.12, 0.0))
FOV = 39.0
BACKGROUND = (0.16, 0.40, 0.78)
AMBIENT = (0.08, 0.09, 0.11)
LIGHTS = (((4, 5, 3), 0.75), ((-5, 3, 2), 0.3), ((-1, 4, -4), 0.3))
MAX_DEPTH = 5
FLAKE = {"diffuse": (0.40, 0.36, 0.30), "specular": 0.6, "shininess": 60, "reflect": (0.5, 0.5, 0.5)}
GROUND = {"diffuse": (0.80, 0.42, 0.20)}
GROUND_HEIGHT = -0.5
RADIUS = 0.5


def rotation_y(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return ((c, 0.0, s), (0.0, 1.0, 0.0), (-s, 0.0, c))


def rotation_z(degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0))


def product(a, b):
    return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)) for i in range(3))


# Where +y of a child goes: six around the waist, three on the crown.
WAIST, CROWN = 90.0, math.degrees(math.acos(math.sqrt(2.0 / 3.0)))
CHILDREN = [product(rotation_y(60 * i), rotation_z(-WAIST)) for i in range(6)]
CHILDREN += [product(rotation_y(30 + 120 * i), rotation_z(-CROWN)) for i in range(3)]


def spheres(depth, center, radius, frame):
    """Yields (center, radius), parents before their children."""
    yield center, radius
    if depth == 0:
        return
    for child in CHILDREN:
        turned = product(frame, child)
        reach = radius * 4.0 / 3.0
        moved = tuple(center[i] + reach * turned[i][1] for i in range(3))
        yield from spheres(depth - 1, moved, radius / 3.0, turned)


def numbers(values):
    return " ".join("%.9g" % value for value in values)


def vector(values):
    return "<" + ", ".join("%.9g" % value for value in values) + ">"


def write_clrt(out, arguments, width, height):
    out.write("# Sphereflake, depth %d, written by scenes/generate/sphereflake.py\n" % arguments.depth)
    out.write("image { size %d %d  samples %d }\n" % (width, height, arguments.samples))
    out.write("camera { position %s  look_at %s  up 0 1 0  fov %g }\n"
              % (numbers(CAMERA[0]), numbers(CAMERA[1]), FOV))
    out.write("render { max_depth %d }\n" % MAX_DEPTH)
    out.write("background %s\nambient %s\n" % (numbers(BACKGROUND), numbers(AMBIENT)))
    for position, intensity in LIGHTS:
        out.write("light point { position %s  intensity %g }\n" % (numbers(position), intensity))
    out.write("material flake phong { diffuse %s  specular %g  shininess %g  reflect %s }\n"
              % (numbers(FLAKE["diffuse"]), FLAKE["specular"], FLAKE["shininess"],
                 numbers(FLAKE["reflect"])))
    out.write("material ground phong { diffuse %s }\n" % numbers(GROUND["diffuse"]))
    identity = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    for center, radius in spheres(arguments.depth, (0.0, 0.0, 0.0), RADIUS, identity):
        out.write("sphere { center %s  radius %.9g  material flake }\n" % (numbers(center), radius))
    out.write("plane { point 0 %g 0  normal 0 1 0  material ground }\n" % GROUND_HEIGHT)


def write_pov(out, arguments, width, height):
    # POV-Ray is left-handed: `right` points to -x. Its angle is the horizontal one, its ambient and
    # diffuse are factors of the pigment. Its levels count the camera ray.
    horizontal = 2.0 * math.degrees(math.atan(math.tan(math.radians(FOV / 2.0)) * width / height))
    out.write("// Sphereflake, depth %d, written by scenes/generate/sphereflake.py\n" % arguments.depth)
    out.write("#version 3.7;\n")
    out.write("global_settings { assumed_gamma 1.0  max_trace_level %d  ambient_light rgb %s }\n"
              % (MAX_DEPTH + 1, vector(AMBIENT)))
    out.write("camera { location %s  sky y  up y  right -x * %.9g  angle %.9g  look_at %s }\n"
              % (vector(CAMERA[0]), width / height, horizontal, vector(CAMERA[1])))
    out.write("background { color rgb %s }\n" % vector(BACKGROUND))
    for position, intensity in LIGHTS:
        out.write("light_source { %s  color rgb %g }\n" % (vector(position), intensity))
    out.write("#declare Flake = texture { pigment { color rgb %s } finish { ambient 1 diffuse 1 phong %g"
              " phong_size %g reflection { rgb %s } } }\n"
              % (vector(FLAKE["diffuse"]), FLAKE["specular"], FLAKE["shininess"],
                 vector(FLAKE["reflect"])))
    identity = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    for center, radius in spheres(arguments.depth, (0.0, 0.0, 0.0), RADIUS, identity):
        out.write("sphere { %s, %.9g texture { Flake } }\n" % (vector(center), radius))
    out.write("plane { y, %g pigment { color rgb %s } finish { ambient 1 diffuse 1 } }\n"
              % (GROUND_HEIGHT, vector(GROUND["diffuse"])))


def main():
    parser = argparse.ArgumentParser(description="Writes the flat sphereflake scene to standard output.")
    parser.add_argument("--depth", type=int, default=5, help="levels below the first sphere (default 5)")
    parser.add_argument("--size", default="1024x1024", help="pixels, WxH (default 1024x1024)")
    parser.add_argument("--samples", type=int, default=1, help="camera samples a pixel (default 1)")
    parser.add_argument("--pov", action="store_true", help="write a POV-Ray scene")
    arguments = parser.parse_args()
    try:
        width, height = (int(part) for part in arguments.size.split("x"))
    except ValueError:
        parser.error("--size wants WxH, such as 1024x1024")
    if width < 1 or height < 1 or arguments.depth < 0 or arguments.samples < 1:
        parser.error("sizes and samples start at 1, depth at 0")
    write = write_pov if arguments.pov else write_clrt
    write(sys.stdout, arguments, width, height)


if __name__ == "__main__":
    main()
