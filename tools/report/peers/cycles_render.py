"""Renders a scene (scene.py, as JSON) with Blender's Cycles, on the CPU, and nothing trades bias for noise:

    blender -b --factory-startup --python cycles_render.py -- JOB.json

The job names scene, spp, seed, environment (the scene's own file), out (a PFM) and exr (where Blender leaves its
own file). Prints a line of JSON. x y z of a scene become -y, z, -x of Blender, whose middle of the sky is +x.
"""
import array
import json
import sys
import time

import bpy
from mathutils import Matrix, Vector


def turned(v):
    return Vector((-v[2], -v[0], v[1]))


def material(name, given):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    out = nodes.new("ShaderNodeOutputMaterial")
    if given["kind"] == "pbr":
        node = nodes.new("ShaderNodeBsdfPrincipled")
        node.distribution = "GGX"
        values = {"Base Color": (*given["color"], 1), "Metallic": given["metallic"], "Roughness": given["roughness"],
                  "Specular": 0.5, "Sheen": 0, "Clearcoat": 0}
    elif given["kind"] == "glass":
        node = nodes.new("ShaderNodeBsdfGlass")
        node.distribution = "SHARP"
        values = {"Color": (1, 1, 1, 1), "IOR": given["ior"]}
    else:
        node = nodes.new("ShaderNodeBsdfDiffuse")
        values = {"Color": (*given["color"], 1), "Roughness": 0}
    for key, value in values.items():
        node.inputs[key].default_value = value
    made.node_tree.links.new(node.outputs[0], out.inputs["Surface"])
    return made


def add(name, mesh, made, place=None):
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    thing.material_slots[0].link = "OBJECT"
    thing.material_slots[0].material = made
    if place is not None:
        thing.matrix_world = place
    return thing


def unit_sphere():
    """Cycles has no spheres but meshes; this one is fine enough that its outline is within a tenth of a pixel."""
    import bmesh
    mesh = bpy.data.meshes.new("sphere")
    build = bmesh.new()
    bmesh.ops.create_uvsphere(build, u_segments=192, v_segments=96, radius=1)
    build.to_mesh(mesh)
    build.free()
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.materials.append(None)
    return mesh


def disk(given):
    import bmesh
    mesh = bpy.data.meshes.new("disk")
    build = bmesh.new()
    bmesh.ops.create_circle(build, cap_ends=True, segments=512, radius=given["radius"])
    build.to_mesh(mesh)
    build.free()
    mesh.materials.append(None)
    rotation = turned(given["normal"]).to_track_quat("Z", "Y").to_matrix().to_4x4()
    return mesh, Matrix.Translation(turned(given["center"])) @ rotation


def shapes(scene):
    materials = {name: material(name, given) for name, given in scene["materials"].items()}
    sphere = unit_sphere()
    for k, given in enumerate(scene["shapes"]):
        made = materials[given["material"]]
        if given["kind"] == "sphere":
            place = Matrix.Translation(turned(given["center"])) @ Matrix.Scale(given["radius"], 4)
            add(f"shape{k}", sphere, made, place)
        elif given["kind"] == "disk":
            mesh, place = disk(given)
            add(f"shape{k}", mesh, made, place)
        else:
            mesh = bpy.data.meshes.new(f"shape{k}")
            mesh.from_pydata([turned(p) for p in given["points"]], [], given["faces"])
            mesh.materials.append(None)
            add(f"shape{k}", mesh, made)


def light(k, given):
    """Of a radiance: a lamp of the power that it sends out."""
    if given["kind"] != "rectangle":
        raise ValueError("a light that is not a rectangle")
    a, b = turned(given["edge1"]), turned(given["edge2"])
    lamp = bpy.data.lights.new(f"light{k}", "AREA")
    lamp.shape, lamp.size, lamp.size_y = "RECTANGLE", a.length, b.length
    strength = max(given["radiance"])
    lamp.energy = strength * a.length * b.length * 3.141592653589793
    lamp.color = [c / strength for c in given["radiance"]]
    lamp.cycles.max_bounces = 1024
    thing = bpy.data.objects.new(f"light{k}", lamp)
    bpy.context.scene.collection.objects.link(thing)
    x, z = a.normalized(), -a.cross(b).normalized()  # a lamp shines along its -z
    place = Matrix((x, z.cross(x), z)).transposed().to_4x4()
    thing.matrix_world = Matrix.Translation(turned(given["corner"]) + (a + b) / 2) @ place
    thing.visible_camera = True


def world(scene, environment):
    made = bpy.data.worlds.new("world")
    bpy.context.scene.world = made
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    background = nodes["Background"]
    if environment:
        image = bpy.data.images.load(environment)
        image.colorspace_settings.name = "Linear"
        sky = nodes.new("ShaderNodeTexEnvironment")
        sky.image, sky.interpolation = image, "Linear"
        links.new(sky.outputs["Color"], background.inputs["Color"])
        background.inputs["Strength"].default_value = scene["environment"]["intensity"][0]
    else:
        background.inputs["Color"].default_value = (*scene["background"], 1)
    made.cycles.max_bounces = 1024


def settings(job, scene):
    s = bpy.context.scene
    s.render.engine = "CYCLES"
    c = s.cycles
    c.device, c.samples, c.seed = "CPU", job["spp"], job["seed"]
    c.use_adaptive_sampling = c.use_denoising = False
    c.sample_clamp_direct = c.sample_clamp_indirect = c.blur_glossy = c.light_sampling_threshold = 0
    c.caustics_reflective = c.caustics_refractive = True
    depth = scene["max_depth"]
    c.max_bounces = c.diffuse_bounces = c.glossy_bounces = c.transmission_bounces = depth
    c.transparent_max_bounces = 8
    c.min_light_bounces = min(depth, 3)
    c.pixel_filter_type = "BOX"
    s.render.resolution_x, s.render.resolution_y = scene["size"]
    s.render.resolution_percentage = 100
    s.render.use_persistent_data = False
    s.render.image_settings.file_format = "OPEN_EXR"
    s.render.image_settings.color_depth = "32"
    s.render.image_settings.exr_codec = "NONE"
    s.render.image_settings.color_mode = "RGB"
    s.view_settings.view_transform = "Raw"


def camera(given, size):
    lens = bpy.data.cameras.new("camera")
    lens.sensor_fit, lens.angle = "VERTICAL", given["fov"] * 3.141592653589793 / 180
    lens.clip_start, lens.clip_end = 0.001, 1e6
    thing = bpy.data.objects.new("camera", lens)
    bpy.context.scene.collection.objects.link(thing)
    eye, target = turned(given["position"]), turned(given["look_at"])
    w = (eye - target).normalized()
    u = turned(given["up"]).cross(w).normalized()
    place = Matrix((u, w.cross(u), w)).transposed().to_4x4()
    thing.matrix_world = Matrix.Translation(eye) @ place
    bpy.context.scene.camera = thing


def write_pfm(path, exr):
    image = bpy.data.images.load(exr)
    width, height = image.size
    pixels = array.array("f", bytes(16 * width * height))
    image.pixels.foreach_get(pixels)
    del pixels[3::4]
    with open(path, "wb") as out:  # both have the bottom row first
        out.write(b"PF\n%d %d\n-1.0\n" % (width, height))
        pixels.tofile(out)


def main():
    with open(sys.argv[sys.argv.index("--") + 1], encoding="utf-8") as file:
        job = json.load(file)
    scene = job["scene"]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    settings(job, scene)
    camera(scene["camera"], scene["size"])
    world(scene, job["environment"])
    shapes(scene)
    for k, given in enumerate(scene["lights"]):
        light(k, given)
    bpy.context.scene.render.filepath = job["exr"]
    start, cpu = time.perf_counter(), time.process_time()
    bpy.ops.render.render(write_still=True)
    seconds, cpu = time.perf_counter() - start, time.process_time() - cpu
    write_pfm(job["out"], job["exr"])
    print("\n" + json.dumps({"version": bpy.app.version_string, "operator_seconds": seconds, "cpu_s": cpu}))


if __name__ == "__main__":
    main()
