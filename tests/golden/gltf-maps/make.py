#!/usr/bin/env python3
"""make.py: writes the files of the cases gltf-maps and gltf-glb. Needs nothing but Python.

One scene three times: maps.gltf with a .bin and images beside it; ../gltf-glb/maps.glb with all of it within, its
buffer interleaved and its nodes as matrices; and for the oracle, which reads no glTF, equal.obj with what the nodes do
done here, and images with what the factors do done here, in 16 linear bits.
"""
import json
import math
import os
import struct
import zlib

FOLDER = os.path.dirname(os.path.abspath(__file__))
GLB = os.path.join(FOLDER, "..", "gltf-glb", "maps.glb")
SIZE = 8  # texels of a map, each way


# ---- images -----------------------------------------------------------------------------------

def png(rows, depth):
    """Of rows of texels of one or three levels."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    kind = {1: 0, 3: 2}[len(rows[0][0])]
    packed = b"".join(b"\0" + struct.pack(">%d%s" % (3 ** (kind // 2) * len(row), "BH"[depth // 8 - 1]),
                                          *[v for texel in row for v in texel]) for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), depth, kind, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(packed, 9)) +
            chunk(b"IEND", b""))


def texels(texel):
    """texel(x, y) with y from the top."""
    return [[tuple(int(v) for v in texel(x, y)) for x in range(SIZE)] for y in range(SIZE)]


def linear(level):
    c = level / 255
    return c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4


def times(rows, factors, decode=linear, channels=(0, 1, 2)):
    """16 bits of the channels, decoded and times their factors."""
    return [[tuple(round(65535 * decode(texel[c]) * f) for c, f in zip(channels, factors)) for texel in row]
            for row in rows]


def plain(level):
    return level / 255


def steeper(level):
    return round(65535 * (0.5 + 1.6 * (level / 255 - 0.5)))


def skin(x, y):
    """Lopsided both ways: red grows to the right, green downwards, with a white corner at the top left."""
    return (255, 255, 255) if x + y < 2 else (40 + 30 * x, 30 + 28 * y, 220 - 12 * (x + y))


def packed(x, y):
    """Occlusion, roughness, metallic: each runs its own way."""
    return (255 - 24 * y, 70 + 24 * x, 255 if (x // 2 + y // 3) % 2 else 20)


def bumps(x, y):
    """Normals that lean to the right in the left half, up in the lower one."""
    n = (0.35 * math.cos(x * math.pi / 7), 0.3 * math.sin(y * math.pi / 3.5) + 0.1, 1)
    length = math.sqrt(sum(c * c for c in n))
    return [round((c / length * 0.5 + 0.5) * 255) for c in n]


def glow(x, y):
    return (250, 200 - 20 * x, 90) if (x, y) in ((1, 5), (2, 5), (5, 2), (5, 3), (6, 3)) else (0, 0, 0)


MAPS = {"base": texels(skin), "packed": texels(packed), "bumps": texels(bumps), "glow": texels(glow)}


# ---- geometry ---------------------------------------------------------------------------------

def single(values):
    """As the buffer has them."""
    return tuple(struct.unpack("<f", struct.pack("<f", v))[0] for v in values)


def dome():
    """A bent square with smooth normals; v runs downwards."""
    n, vertices, indices = 6, [], []
    for j in range(n + 1):
        for i in range(n + 1):
            u, v = i / n, j / n
            x, y = 2 * u - 1, 1 - 2 * v
            normal = (0.8 * x, 0.6 * y, 1)
            length = math.sqrt(sum(c * c for c in normal))
            vertices.append((single((x, y, 0.7 - 0.4 * x * x - 0.3 * y * y)),
                             single(c / length for c in normal), single((u, v))))
    for j in range(n):
        for i in range(n):
            a, b = j * (n + 1) + i, (j + 1) * (n + 1) + i
            indices += [a, b, b + 1, a, b + 1, a + 1]
    return vertices, indices


def frame():
    """Four flat bars around the square, with uvs that repeat the maps and an end at a slant."""
    vertices, indices = [], []
    for turn in range(4):
        c, s = ((1, 0), (0, 1), (-1, 0), (0, -1))[turn]
        first = len(vertices)
        for x, y, u, v in ((-1, 1, 0.25, 0.5), (1, 1, 2.25, 0.5), (1.3, 1.3, 2.5, -0.25), (-1.3, 1.3, 0, -0.25)):
            vertices.append((single((c * x - s * y, s * x + c * y, 0)), (0.0, 0.0, 1.0), single((u, v))))
        indices += [first, first + 1, first + 2, first, first + 2, first + 3]
    return vertices, indices


PRIMITIVES = [dome(), frame()]

# Material of each primitive of the two meshes; both meshes have the same vertices.
MESHES = [(0, 1), (2, 3)]


# ---- materials --------------------------------------------------------------------------------

def texture(index, **more):
    return dict({"index": index}, **more)


TURN = {"offset": [0.25, 0.125], "rotation": 0.4, "scale": [1.5, 0.75]}


def turned(index):
    return texture(index, extensions={"KHR_texture_transform": TURN})


BASE, PACKED, BUMPS, GLOW, SHARP = range(5)
MATERIALS = [
    {"name": "all maps", "emissiveTexture": texture(GLOW), "emissiveFactor": [0.5, 0.4, 0.3],
     "normalTexture": texture(BUMPS, scale=1.6), "occlusionTexture": texture(PACKED, strength=0.7),
     "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 2}},
     "pbrMetallicRoughness": {"baseColorTexture": texture(BASE), "baseColorFactor": [0.9, 0.8, 0.7, 1],
                              "metallicRoughnessTexture": texture(PACKED), "metallicFactor": 0.8,
                              "roughnessFactor": 0.9}},
    {"name": "no maps", "pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.5, 0.2, 1], "metallicFactor": 0.6,
                                                 "roughnessFactor": 0.35}},
    {"name": "glass", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.75},
                                     "KHR_materials_ior": {"ior": 1.2}},
     "normalTexture": texture(BUMPS),
     "pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.9, 0.8, 1], "metallicFactor": 0, "roughnessFactor": 0.2}},
    {"name": "turned", "normalTexture": turned(BUMPS), "emissiveFactor": [0.05, 0.02, 0],
     "pbrMetallicRoughness": {"baseColorTexture": turned(SHARP), "metallicFactor": 0, "roughnessFactor": 0.5}},
]


def transformed(uv):
    """What TURN does, counter-clockwise where v runs downwards."""
    (u, v), c, s = (a * b for a, b in zip(uv, TURN["scale"])), math.cos(0.4), math.sin(0.4)
    return c * u + s * v + TURN["offset"][0], c * v - s * u + TURN["offset"][1]


# ---- nodes ------------------------------------------------------------------------------------

def about(axis, degrees):
    """A quaternion x y z w."""
    length, half = math.sqrt(sum(c * c for c in axis)), math.radians(degrees) / 2
    return [math.sin(half) * c / length for c in axis] + [math.cos(half)]


NODES = [
    {"translation": [-1.6, 0.1, 0], "rotation": about((0, 1, 0), 24), "children": [1]},
    {"scale": [1.0, 1.2, 0.8], "rotation": about((1, 0.5, 0.2), -20), "mesh": 0},
    {"translation": [1.5, 0.2, 0.3], "rotation": about((0, 1, 0.2), -25), "scale": [-1.1, 0.9, 1], "mesh": 1},
]
ROOTS = [0, 2]


def matrix(node):
    """Three rows of four: translation after rotation after scale."""
    x, y, z, w = node["rotation"]
    turn = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    scale = node.get("scale", [1, 1, 1])
    return [[turn[r][c] * scale[c] for c in range(3)] + [node.get("translation", [0, 0, 0])[r]] for r in range(3)]


def product(a, b):
    return [[sum(a[r][k] * b[k][c] for k in range(3)) + (a[r][3] if c == 3 else 0) for c in range(4)]
            for r in range(3)]


def placed(index, parent):
    """Pairs of a mesh and its matrix, in the order of the tree."""
    node = NODES[index]
    here = product(parent, matrix(node))
    found = [(node["mesh"], here)] if "mesh" in node else []
    for child in node.get("children", []):
        found += placed(child, here)
    return found


def carried(m, n):
    """A normal by the cofactors, which are the inverse transpose times the determinant."""
    rows = [m[r][:3] for r in range(3)]
    cofactors = [[rows[(r + 1) % 3][(c + 1) % 3] * rows[(r + 2) % 3][(c + 2) % 3] -
                  rows[(r + 1) % 3][(c + 2) % 3] * rows[(r + 2) % 3][(c + 1) % 3] for c in range(3)] for r in range(3)]
    determinant = sum(rows[0][c] * cofactors[0][c] for c in range(3))
    out = [math.copysign(1, determinant) * sum(cofactors[r][c] * n[c] for c in range(3)) for r in range(3)]
    length = math.sqrt(sum(c * c for c in out))
    return [c / length for c in out], determinant < 0


# ---- the oracle's files -----------------------------------------------------------------------

def write(name, data):
    with open(os.path.join(FOLDER, name), "wb") as file:
        file.write(data)


def write_equal():
    """One OBJ for each material, so that the scene gives it."""
    identity = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]
    for mesh, m in [pair for root in ROOTS for pair in placed(root, identity)]:
        for material, (vertices, indices) in zip(MESHES[mesh], PRIMITIVES):
            lines = []
            for p, n, uv in vertices:
                normal, mirrored = carried(m, n)
                u, v = transformed(uv) if material == 3 else uv
                lines.append("v " + " ".join("%.12g" % sum(m[r][c] * (p + (1,))[c] for c in range(4))
                                             for r in range(3)))
                lines.append("vn " + " ".join("%.12g" % c for c in normal))
                lines.append("vt %.12g %.12g" % (u, 1 - v))
            for i in range(0, len(indices), 3):
                corners = [k + 1 for k in indices[i:i + 3]]
                if mirrored:
                    corners = [corners[0], corners[2], corners[1]]
                lines.append("f " + " ".join("%d/%d/%d" % (k, k, k) for k in corners))
            write("equal-%d.obj" % material, ("\n".join(lines) + "\n").encode())
    write("equal-base.png", png(times(MAPS["base"], (0.9, 0.8, 0.7)), 16))
    write("equal-closed.png", png(times(MAPS["packed"], (1,), lambda level: 1 - 0.7 * (1 - level / 255), (0,)), 16))
    write("equal-bumps.png", png([[(steeper(r), steeper(g), 257 * b) for r, g, b in row] for row in MAPS["bumps"]], 16))
    write("equal-rough.png", png(times(MAPS["packed"], (0.9,), plain, (1,)), 16))
    write("equal-metal.png", png(times(MAPS["packed"], (0.8,), plain, (2,)), 16))
    write("equal-glow.png", png(times(MAPS["glow"], (1.0, 0.8, 0.6)), 16))


# ---- glTF -------------------------------------------------------------------------------------

class Buffer:
    def __init__(self):
        self.data, self.views, self.accessors = b"", [], []

    def view(self, data, **more):
        self.data += bytes(-len(self.data) % 4)
        self.views.append(dict({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)}, **more))
        self.data += data
        return len(self.views) - 1

    def accessor(self, view, kind, component, values, offset=0):
        entry = {"bufferView": view, "componentType": component, "count": len(values), "type": kind}
        if offset:
            entry["byteOffset"] = offset
        if kind == "VEC3":
            entry["min"], entry["max"] = [[f(v[c] for v in values) for c in range(3)] for f in (min, max)]
        self.accessors.append(entry)
        return len(self.accessors) - 1

    def vertices(self, vertices, interleaved):
        """The accessors of positions, normals and uvs."""
        columns = [[vertex[k] for vertex in vertices] for k in range(3)]
        kinds = ("VEC3", "VEC3", "VEC2")
        if not interleaved:
            return [self.accessor(self.view(b"".join(struct.pack("<%df" % len(v), *v) for v in column)), kind, 5126,
                                  column) for column, kind in zip(columns, kinds)]
        view = self.view(b"".join(struct.pack("<8f", *(p + n + uv)) for p, n, uv in vertices), byteStride=32)
        return [self.accessor(view, kind, 5126, column, 12 * k)
                for k, (column, kind) in enumerate(zip(columns, kinds))]


def document(within):
    """The parts of the file that holds all, or of the one with files beside it."""
    buffer, primitives = Buffer(), []
    for vertices, indices in PRIMITIVES:
        position, normal, uv = buffer.vertices(vertices, within)
        code, component = ("B", 5121) if within else ("H", 5123)
        view = buffer.view(struct.pack("<%d%s" % (len(indices), code), *indices))
        primitives.append({"attributes": {"POSITION": position, "NORMAL": normal, "TEXCOORD_0": uv},
                           "indices": buffer.accessor(view, "SCALAR", component, indices)})
    nodes = NODES
    if within:
        nodes = [dict({k: node[k] for k in ("children", "mesh") if k in node},
                      matrix=[row[c] for c in range(4) for row in matrix(node) + [[0, 0, 0, 1]]]) for node in NODES]
        images = [{"mimeType": "image/png", "bufferView": buffer.view(png(rows, 8))} for rows in MAPS.values()]
    else:
        # A blank in a name is written so in a URI.
        images = [{"uri": "base%20color.png"}] + [{"uri": name + ".png"} for name in list(MAPS)[1:]]
    return {
        "asset": {"version": "2.0", "generator": "make.py"}, "scene": 0, "scenes": [{"nodes": ROOTS}], "nodes": nodes,
        "extensionsUsed": ["KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_transmission",
                           "KHR_texture_transform"],
        "meshes": [{"primitives": [dict(p, material=m) for p, m in zip(primitives, mesh)]} for mesh in MESHES],
        "materials": MATERIALS, "accessors": buffer.accessors, "bufferViews": buffer.views, "images": images,
        "samplers": [{"wrapS": 10497, "wrapT": 10497, "magFilter": 9729, "minFilter": 9729}, {"magFilter": 9728}],
        "textures": [{"source": 0, "sampler": 0}, {"source": 1, "sampler": 0}, {"source": 2}, {"source": 3},
                     {"source": 0, "sampler": 1}],
    }, buffer.data


def write_gltf():
    tree, data = document(False)
    tree["buffers"] = [{"byteLength": len(data), "uri": "maps.bin"}]
    write("maps.gltf", (json.dumps(tree, indent=1) + "\n").encode())
    write("maps.bin", data)
    for name, rows in MAPS.items():
        write("base color.png" if name == "base" else name + ".png", png(rows, 8))


def write_glb():
    tree, data = document(True)
    data += bytes(-len(data) % 4)
    tree["buffers"] = [{"byteLength": len(data)}]
    text = json.dumps(tree, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    write(GLB, struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


if __name__ == "__main__":
    write_equal()
    write_gltf()
    write_glb()
