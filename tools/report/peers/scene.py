"""Reads a scene file of clrt into plain shapes that other renderers can be given.

What it knows is what the scenes of this comparison are written in: spheres, disks, boxes and triangles with constant
phong and pbr materials, rectangles and spheres of light, a background or an environment, a pinhole camera.
Anything else is an error: a peer must not be given another scene than clrt.
"""
import math
import os
import re

TOKEN = re.compile(r'#[^\n]*|"(?:\\.|[^"\\\n])*"|[{}]|[^\s{}"#]+')
# Properties whose first value is a name.
NAMED = ("filter", "integrator", "tone_map", "encoding", "material", "rotate", "fresnel")


class SceneError(Exception):
    pass


def is_value(word):
    return word[0] in '"+-.0123456789'


def properties_of(words):
    """(name, values) in their order, for the words between two braces."""
    properties = []
    for word in words:
        last = properties[-1] if properties else None
        if last and (is_value(word) or (last[0] in NAMED and not last[1])):
            last[1].append(word)
        else:
            properties.append((word, []))
    return properties


def statements(text):
    """(words before the block, properties) of each statement."""
    words = [match.group(0) for match in TOKEN.finditer(text) if not match.group(0).startswith("#")]
    at = 0
    while at < len(words):
        if words[at] in ("background", "ambient"):
            end = at + 1
            while end < len(words) and is_value(words[end]):
                end += 1
            yield words[at:end], []
            at = end
            continue
        if "{" not in words[at:]:
            raise SceneError("a statement without a block: " + words[at])
        opening = words.index("{", at)
        closing = words.index("}", opening)
        yield words[at:opening], properties_of(words[opening + 1:closing])
        at = closing + 1


def numbers(values):
    return [float(value) for value in values]


def color(values):
    if len(values) == 1 and values[0].startswith('"#'):
        levels = [int(values[0][k:k + 2], 16) / 255 for k in (2, 4, 6)]
        return [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in levels]
    values = numbers(values)
    return values * 3 if len(values) == 1 else values


def rotated(point, axis, degrees):
    """About x, y or z by the right-hand rule."""
    a, b = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    out = list(point)
    out[a], out[b] = c * point[a] - s * point[b], s * point[a] + c * point[b]
    return out


def transformed(points, properties):
    for name, values in properties:
        if name == "translate":
            points = [[p + float(d) for p, d in zip(point, values)] for point in points]
        elif name == "rotate" and values[0] in "xyz":
            points = [rotated(point, values[0], float(values[1])) for point in points]
        elif name in ("scale", "matrix", "rotate"):
            raise SceneError("transform " + name)
    return points


def known(given, allowed, what):
    for name in given:
        if name not in allowed:
            raise SceneError(f"{what}: {name}")


def material(kind, properties):
    given = dict(properties)
    if kind == "pbr":
        known(given, ("base_color", "metallic", "roughness"), kind)
        return {"kind": "pbr", "color": color(given.get("base_color", ["0.8"])),
                "metallic": float(given.get("metallic", ["0"])[0]),
                "roughness": float(given.get("roughness", ["0.5"])[0])}
    known(given, ("diffuse", "reflect", "transmit", "ior", "fresnel"), kind)
    diffuse = color(given.get("diffuse", ["0.8"]))
    if "transmit" not in given and "reflect" not in given:
        return {"kind": "diffuse", "color": diffuse}
    clear = all(given.get(name) == [word] for name, word in (("reflect", "1"), ("transmit", "1"), ("fresnel", "on")))
    if any(diffuse) or not clear:
        raise SceneError("phong that is neither matte nor clear glass")
    return {"kind": "glass", "ior": float(given.get("ior", ["1.5"])[0])}


def box(given):
    if "center" in given:
        center, size = numbers(given["center"]), numbers(given["size"])
        size = size * 3 if len(size) == 1 else size
        low = [c - s / 2 for c, s in zip(center, size)]
        high = [c + s / 2 for c, s in zip(center, size)]
    else:
        low, high = numbers(given["min"]), numbers(given["max"])
    corners = [[(high if k >> axis & 1 else low)[axis] for axis in range(3)] for k in range(8)]
    quads = ((0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6))
    return corners, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]


def shape(kind, properties):
    given = dict(properties)
    out = {"kind": "mesh", "material": given["material"][0]}
    if kind == "sphere":
        known(given, ("center", "radius", "material"), kind)
        out.update(kind="sphere", center=numbers(given["center"]), radius=float(given["radius"][0]))
    elif kind == "disk":
        known(given, ("center", "normal", "radius", "material"), kind)
        out.update(kind="disk", center=numbers(given["center"]), normal=numbers(given["normal"]),
                   radius=float(given["radius"][0]))
    elif kind == "box":
        known(given, ("min", "max", "center", "size", "material", "translate", "rotate"), kind)
        corners, faces = box(given)
        out.update(points=transformed(corners, properties), faces=faces)
    elif kind == "triangle":
        known(given, ("vertices", "material"), kind)
        flat = numbers(given["vertices"])
        out.update(points=[flat[0:3], flat[3:6], flat[6:9]], faces=[(0, 1, 2)])
    else:
        raise SceneError("shape " + kind)
    return out


def light(kind, properties):
    given = dict(properties)
    out = {"kind": kind, "radiance": color(given["radiance"])}
    if kind == "rectangle":
        out.update((name, numbers(given[name])) for name in ("corner", "edge1", "edge2"))
    elif kind == "sphere":
        out.update(center=numbers(given["center"]), radius=float(given["radius"][0]))
    else:
        raise SceneError("light " + kind)
    return out


def environment(properties, folder):
    given = dict(properties)
    known(given, ("file", "intensity"), "environment")
    return {"file": os.path.join(folder, given["file"][0].strip('"')),
            "intensity": color(given.get("intensity", ["1"]))}


def read(path):
    """One JSON-ready object: size, camera, max_depth, background, environment, materials, lights, shapes."""
    scene = {"size": [800, 600], "max_depth": 5, "background": [0, 0, 0], "environment": None,
             "camera": None, "materials": {}, "lights": [], "shapes": []}
    with open(path, encoding="utf-8") as text:
        try:
            for head, properties in statements(text.read()):
                take(scene, head, properties, os.path.dirname(os.path.abspath(path)))
        except (SceneError, KeyError, ValueError) as problem:
            raise SceneError(f"{path}: not known to this comparison: {problem}") from None
    return scene


def add_triangle(shapes, triangle):
    """To the mesh of that material, so that no renderer has a mesh for each."""
    for mesh in shapes:
        if mesh["kind"] == "mesh" and mesh["material"] == triangle["material"]:
            first = len(mesh["points"])
            mesh["points"] += triangle["points"]
            mesh["faces"].append((first, first + 1, first + 2))
            return
    shapes.append(triangle)


def take(scene, head, properties, folder):
    given = dict(properties)
    if head[0] == "image":
        known(given, ("size", "samples", "filter"), "image")
        if given.get("filter", ["box"]) != ["box"]:
            raise SceneError("a filter other than box")
        scene["size"] = [int(v) for v in given["size"]]
    elif head[0] == "camera":
        known(given, ("position", "look_at", "up", "fov"), "camera")
        scene["camera"] = {"position": numbers(given["position"]), "look_at": numbers(given["look_at"]),
                           "up": numbers(given.get("up", ["0", "1", "0"])), "fov": float(given["fov"][0])}
    elif head[0] == "render":
        known(given, ("integrator", "max_depth"), "render")
        scene["max_depth"] = int(given.get("max_depth", ["5"])[0])
    elif head[0] == "background":
        scene["background"] = color(head[1:])
    elif head[0] == "environment":
        scene["environment"] = environment(properties, folder)
    elif head[0] == "material":
        scene["materials"][head[1]] = material(head[2], properties)
    elif head[0] == "light":
        scene["lights"].append(light(head[1], properties))
    elif head[0] == "triangle":
        add_triangle(scene["shapes"], shape("triangle", properties))
    elif head[0] not in ("output", "ambient"):
        scene["shapes"].append(shape(head[0], properties))
