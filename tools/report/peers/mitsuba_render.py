"""Renders a scene (scene.py, as JSON) with Mitsuba 3. Runs in an interpreter that can import mitsuba:

    mitsuba_render.py JOB.json

The job names scene, variant, spp, seed, sampler, environment (a PFM whose middle is +z), out (a PFM) and warm: how
many renders follow the first, which also compiles. The last is written. models "clrt" writes clrt's pbr as a BSDF of
its own, so that both renderers show the same picture; "own" takes Mitsuba's `principled`. Prints a line of JSON.
"""
import json
import math
import sys
import time

import drjit as dr
import mitsuba as mi


def rgb(values):
    return {"type": "rgb", "value": list(values)}


def define_pbr():
    """The brdf of section "pbr" of scenes/README.md: Schlick's Fresnel, GGX with Smith's height-correlated masking."""

    class Pbr(mi.BSDF):
        def __init__(self, props):
            mi.BSDF.__init__(self, props)
            self.base = mi.Color3f(*(props[name] for name in ("red", "green", "blue")))
            self.metallic = mi.Float(props["metallic"])
            self.alpha = mi.Float(props["roughness"] ** 2)
            if hasattr(dr, "make_opaque"):
                dr.make_opaque(self.base, self.metallic, self.alpha)
            f0 = ((1.5 - 1) / (1.5 + 1)) ** 2
            self.f0 = f0 + (self.base - f0) * self.metallic
            flags = mi.BSDFFlags.DiffuseReflection | mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide
            self.m_flags = flags
            self.m_components = [flags]

        def distribution(self):
            return mi.MicrofacetDistribution(mi.MicrofacetType.GGX, self.alpha, True)

        def share(self, wi):
            """The probability to sample the specular lobe."""
            fresnel = dr.mean(self.f0 + (1 - self.f0) * (1 - wi.z) ** 5)
            diffuse = (1 - fresnel) * (1 - self.metallic) * dr.mean(self.base)
            return dr.clip(fresnel / (fresnel + diffuse), 0.1, 1)

        def value(self, wi, wo):
            h = dr.normalize(wi + wo)
            a2 = self.alpha * self.alpha
            fresnel = self.f0 + (1 - self.f0) * (1 - dr.clip(dr.dot(wi, h), 0, 1)) ** 5
            # (h.z^2 (a^2 - 1) + 1) without its cancellation.
            d = a2 / (math.pi * dr.square(h.x * h.x + h.y * h.y + h.z * h.z * a2))
            nv, nl = dr.maximum(wi.z, 1e-4), wo.z
            vis = 0.5 / (nl * dr.sqrt(a2 + (1 - a2) * nv * nv) + nv * dr.sqrt(a2 + (1 - a2) * nl * nl))
            return (1 - fresnel) * (1 - self.metallic) * self.base / math.pi + fresnel * d * vis

        def density(self, wi, wo):
            h = dr.normalize(wi + wo)
            share = self.share(wi)
            lobe = self.distribution().pdf(wi, h) / (4 * dr.dot(wo, h))
            return share * lobe + (1 - share) * wo.z / math.pi

        def eval_pdf(self, ctx, si, wo, active=True):
            active &= (si.wi.z > 0) & (wo.z > 0)
            return (dr.select(active, self.value(si.wi, wo) * wo.z, 0),
                    dr.select(active, self.density(si.wi, wo), 0))

        def eval(self, ctx, si, wo, active=True):
            return self.eval_pdf(ctx, si, wo, active)[0]

        def pdf(self, ctx, si, wo, active=True):
            return self.eval_pdf(ctx, si, wo, active)[1]

        def sample(self, ctx, si, sample1, sample2, active=True):
            normal, _ = self.distribution().sample(si.wi, sample2)
            mirrored = 2 * dr.dot(si.wi, normal) * normal - si.wi
            wo = dr.select(sample1 < self.share(si.wi), mirrored, mi.warp.square_to_cosine_hemisphere(sample2))
            value, pdf = self.eval_pdf(ctx, si, wo, active)
            active &= (si.wi.z > 0) & (wo.z > 0) & (pdf > 0)
            bs = mi.BSDFSample3f()
            bs.wo, bs.pdf, bs.eta = wo, dr.select(active, pdf, 0), 1.0
            bs.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
            bs.sampled_component = mi.UInt32(0)
            return bs, dr.select(active, value / pdf, 0)

        def traverse(self, callback):
            pass

        def to_string(self):
            return "Pbr[]"

    mi.register_bsdf("clrt_pbr", lambda props: Pbr(props))


def bsdf(material, models):
    if material["kind"] == "glass":
        return {"type": "dielectric", "int_ior": material["ior"], "ext_ior": 1.0}
    if material["kind"] == "diffuse":
        return {"type": "twosided", "inside": {"type": "diffuse", "reflectance": rgb(material["color"])}}
    if models == "clrt":
        red, green, blue = material["color"]
        return {"type": "clrt_pbr", "red": red, "green": green, "blue": blue, "metallic": material["metallic"],
                "roughness": material["roughness"]}
    return {"type": "principled", "base_color": rgb(material["color"]), "metallic": material["metallic"],
            "roughness": material["roughness"], "eta": 1.5}


def mesh(name, points, faces, properties):
    """Corners are not shared, so that faces are flat."""
    result = mi.Mesh(name, 3 * len(faces), len(faces), props=properties)
    parameters = mi.traverse(result)
    corners = [points[corner] for face in faces for corner in face]
    values = {"vertex_positions": [c for corner in corners for c in corner], "faces": list(range(3 * len(faces)))}
    for key, numbers in values.items():  # the scalar variants have arrays of another type
        parameters[key] = type(parameters[key])(numbers)
    parameters.update()
    return result


def shape(name, given, materials):
    reference = materials[given["material"]]
    if given["kind"] == "sphere":
        return {"type": "sphere", "center": given["center"], "radius": given["radius"], "bsdf": reference}
    T = mi.ScalarTransform4f
    if given["kind"] == "disk":
        tip = [c + n for c, n in zip(given["center"], given["normal"])]
        up = [1, 0, 0] if abs(given["normal"][0]) < 0.5 else [0, 1, 0]
        place = T().look_at(given["center"], tip, up) @ T().scale([given["radius"], given["radius"], 1])
        return {"type": "disk", "to_world": place, "bsdf": reference}
    properties = mi.Properties()
    properties["mesh_bsdf"] = reference
    return mesh(name, given["points"], given["faces"], properties)


def light(given):
    black = {"type": "diffuse", "reflectance": rgb([0, 0, 0])}
    emitter = {"type": "area", "radiance": rgb(given["radiance"])}
    if given["kind"] == "sphere":
        return {"type": "sphere", "center": given["center"], "radius": given["radius"], "emitter": emitter,
                "bsdf": black}
    corner, a, b = given["corner"], given["edge1"], given["edge2"]
    n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    length = math.sqrt(sum(c * c for c in n))
    rows = [[a[k] / 2, b[k] / 2, n[k] / length, corner[k] + (a[k] + b[k]) / 2] for k in range(3)] + [[0, 0, 0, 1]]
    return {"type": "rectangle", "to_world": mi.ScalarTransform4f(rows), "emitter": emitter, "bsdf": black}


def load(job):
    scene, camera = job["scene"], job["scene"]["camera"]
    width, height = scene["size"]
    out = {"type": "scene",
           # clrt's depth counts reflections and Mitsuba's segments, the one to the light included. Both start
           # Russian roulette with the ray of depth 4.
           "integrator": {"type": "path", "max_depth": scene["max_depth"] + 2, "rr_depth": 4},
           "sensor": {"type": "perspective", "fov": camera["fov"], "fov_axis": "y", "near_clip": 0.001,
                      "far_clip": 1e6,
                      "to_world": mi.ScalarTransform4f().look_at(camera["position"], camera["look_at"], camera["up"]),
                      "sampler": {"type": job["sampler"], "sample_count": job["spp"]},
                      "film": {"type": "hdrfilm", "width": width, "height": height, "rfilter": {"type": "box"},
                               "component_format": "float32"}}}
    if job["environment"]:
        intensity = scene["environment"]["intensity"]
        if len(set(intensity)) > 1:
            raise ValueError("a coloured intensity of the environment")
        out["sky"] = {"type": "envmap", "filename": job["environment"], "scale": intensity[0]}
    elif any(scene["background"]):
        out["sky"] = {"type": "constant", "radiance": rgb(scene["background"])}
    materials = {name: mi.load_dict(bsdf(given, job["models"])) for name, given in scene["materials"].items()}
    for k, given in enumerate(scene["shapes"]):
        out[f"shape{k}"] = shape(f"shape{k}", given, materials)
    for k, given in enumerate(scene["lights"]):
        out[f"light{k}"] = light(given)
    return mi.load_dict(out)


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        job = json.load(file)
    mi.set_variant(job["variant"])
    if job["models"] == "clrt":
        define_pbr()
    scene = load(job)
    seconds = []
    for k in range(job["warm"] + 1):
        start, cpu = time.perf_counter(), time.process_time()
        image = mi.render(scene, spp=job["spp"], seed=job["seed"] + 1000 * k)
        dr.eval(image)
        dr.sync_thread()
        seconds.append(time.perf_counter() - start)
        cpu = time.process_time() - cpu
    mi.Bitmap(image).convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, False).write(job["out"])
    print(json.dumps({"version": mi.__version__, "seconds": seconds, "cpu_s": cpu}))


if __name__ == "__main__":
    main()
