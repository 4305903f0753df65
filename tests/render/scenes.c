#include "scenes.h"

#include "support.h"

const char scene_glass[] =
    "image { size 100 75 samples 4 seed 3 filter mitchell }\n"
    "camera { position P(0.5 2 7) look_at P(0 0.75 0) up D(0 1 0) fov 45 }\n"
    "render { max_depth 6 min_weight 0.01 }\n"
    "ambient 0.125\n"
    "light point { position P(-4 6 5) intensity 0.75 }\n"
    "light point { position P(3 5 2) intensity 0.5 0.375 0.25 }\n"
    "texture tiles checker { colors 0.75 0.25 scale ^1 ^1 }\n"
    "texture bands checker { colors 1 0.25 scale 15 5 }\n"
    "material ground phong { diffuse 0.5 reflect 0.125 }\n"
    "material wall phong { diffuse tiles }\n"
    "material ball phong { diffuse bands specular 0.5 shininess 20 }\n"
    "material glass phong { diffuse 0 specular 0.5 shininess 100 reflect 1\n"
    "    transmit 0.875 1 0.9375 fresnel on }\n"
    "material veil phong { diffuse 0.125 0.25 0.5 transmit 0.5 0.625 0.75 reflect 0.25 ior 1.25 }\n"
    "texture skin image { file \"skin.png\" scale 2 1 }\n"
    "texture dents image { file \"dents.png\" filter nearest }\n"
    "material lamp phong { emission 0.5 0.25 0.125 diffuse skin normal_map dents }\n"
    "material tint phong { diffuse bands transmit 0.25 0.5 0.125 ior 1 }\n"
    "sphere { center P(0 -6400000 0) radius ~6400000 material ground }\n"
    "plane { point P(0 0 -4) normal D(0 0 1) material wall }\n"
    "sphere { center P(-1.5 1 0) radius ~1 material ball }\n"
    "sphere { center P(1 0.75 1.5) radius ~0.75 material glass }\n"
    "sphere { center L(0 0 0) radius ~1 scale 0.5 1.25 0.75 rotate A(0 0 1) 20\n"
    "    translate P(2.75 1.25 -1) material veil }\n"
    "box { center P(-3 0.25 1.5) size ~1 ~0.5 ~1 material lamp }\n"
    "triangle { vertices P(-3 0.5 -3) P(-1 0.5 -3.5) P(-2 3 -3) normals D(0.25 0 1) D(0 0 1) D(0 0.5 1)\n"
    "    material ball }\n"
    "object pair {\n"
    "    sphere { center L(0 0.5 0) radius ~0.5 material glass }\n"
    "    box { center L(0 0.125 0) size ~1.25 ~0.25 ~0.5 }\n"
    "    triangle { vertices L(-1 0.25 0.5) L(1 0.25 0.5) L(0 1 0.75) uvs 0 0 1 0 0.5 1 material ball }\n"
    "}\n"
    "instance pair { rotate A(0 1 0) 30 translate P(0 0 2.5) material lamp }\n"
    "instance pair { scale 0.5 1.5 0.75 rotate A(0.25 1 0) 70 translate P(-0.5 2 -1) }\n"
    "mesh { file \"vase.obj\" scale ~0.75 rotate A(0.5 0 1) 15 translate P(1.875 0.125 2.75)\n"
    "    material ball }\n"
    "mesh { file \"gem.obj\" scale ~0.5 rotate A(1 0 0.25) 20 translate P(-1.5 0.75 3) material glass }\n"
    "object jewels {\n"
    "    mesh { file \"gem.obj\" smooth on scale ~0.5 translate L(-0.5 0.25 0) }\n"
    "    mesh { file \"vase.obj\" smooth off scale ~0.375 translate L(0.375 0 0) material tint }\n"
    "    sphere { center L(0 0.75 0) radius ~0.25 }\n"
    "}\n"
    "instance jewels { rotate A(0 1 0) 20 translate P(-0.25 0 3.75) }\n"
    "instance jewels { scale 1 1.5 0.5 rotate A(0 1 0) 200 translate P(2.5 1.5 0.5) material veil }\n";

const char scene_toys[] =
    "image { size 90 70 }\n"
    "camera { position P(6 5 8) look_at P(0 0.5 0) up D(0 1 0) orthographic ~7 }\n"
    "background 0.25 0.375 0.5\n"
    "ambient 0.125\n"
    "light directional { direction D(-0.5 -1 -0.25) intensity 0.5 }\n"
    "light spot { position P(0 6 3) look_at P(0 0 0) intensity 0.75 inner 20 outer 50 }\n"
    "texture grain checker3d { colors 0.75 0.25 scale ^2 }\n"
    "material wood blinn_phong { diffuse grain specular 0.5 shininess 40 }\n"
    "material mirror phong { diffuse 0.25 reflect 0.5 }\n"
    "texture knit checker3d { colors 0.875 0.125 scale 5 }\n"
    "material wool phong { diffuse knit }\n"
    "disk { center P(0 0 0) normal D(0 1 0) radius ~3 material mirror }\n"
    "tetrahedron { center P(-1.5 0.625 0) size ~1.5 material wood }\n"
    "cylinder { base P(1.5 0 -0.5) top P(1.5 1.5 -0.5) radius ~0.5 caps off material wood }\n"
    "cone { base P(0 0 1.5) top P(0.25 1.25 1.5) radius ~0.625 top_radius ~0.125 material wood }\n"
    "torus { center P(0 1 -1.5) axis D(0.25 1 0.5) major ~0.75 minor ~0.25 material wood }\n"
    "cone { base L(0 0 0) top L(0 1 0) radius ~0.5 scale 1 1.5 0.5 rotate A(0.5 0 1) 25\n"
    "    translate P(-2 0.25 1.25) material mirror }\n"
    "mesh { file \"vase.obj\" scale ~1.25 rotate A(0 1 0) 25 translate P(1.25 0 1.25) material wool }\n"
    "mesh { file \"gem.obj\" scale ~0.625 translate P(-0.75 0.625 2.25) material mirror }\n";

const char scene_studio[] =
    "image { size 92 75 samples 2 filter tent }\n"
    "camera { position P(1 2 6) look_at P(0 0.5 0) up D(0 1 0) fov 40 aperture ~0.125 }\n"
    "render { max_depth 4 ambient_occlusion 2 ~3 environment_samples 3 }\n"
    "ambient 0.125\n"
    "environment { file \"sky.hdr\" intensity 0.5 0.625 0.75 rotate 40 }\n"
    "light point { position P(-3 5 4) intensity 2 }\n"
    "light sphere { center P(-0.5 3 -1.5) radius ~0.5 radiance 4 3 2 samples 2 }\n"
    "light rectangle { corner P(2 3 1) edge1 L(-0.5 0 1) edge2 L(0.75 -0.5 0.25) radiance 6 }\n"
    "material clay phong { diffuse 0.625 reflect 0.125 }\n"
    "material stone pbr { base_color 0.5 0.375 0.25 roughness 0.75 occlusion 0.5 }\n"
    "material gold pbr { base_color 0.875 0.625 0.25 metallic 1 roughness 0.25 }\n"
    "material chrome pbr { base_color 0.75 metallic 1 roughness 0 }\n"
    "texture stains checker { colors 0.5 0.75 0.625  0.75 0.375 0.25 scale 6 3 }\n"
    "material resin pbr { base_color stains roughness 0.125 transmit 0.75 }\n"
    "plane { point P(0 0 0) normal D(0 1 0) material stone }\n"
    "sphere { center P(-1.5 0.75 0) radius ~0.75 material gold }\n"
    "sphere { center P(0 0.5 1.5) radius ~0.5 material resin }\n"
    "box { center P(1.25 0.5 -0.5) size ~1 ~1 ~1 material chrome }\n"
    "sphere { center P(1.25 0.375 1.25) radius ~0.375 material clay }\n"
    "mesh { file \"vase.obj\" terminator on scale ~0.5 rotate A(0 0 1) 20 translate P(-0.5 0.25 2)\n"
    "    material clay }\n"
    "object cup { mesh { file \"vase.obj\" smooth on terminator on scale ~0.5 } }\n"
    "instance cup { scale 1 1.5 0.75 rotate A(0 1 0) 20 translate P(1 0 2.25) material stone }\n"
    "instance cup { scale 0.75 rotate A(1 0 0) 160 translate P(-1.5 1.25 2) material gold }\n";

const char scene_hall[] =
    "image { size 92 72 samples 5 seed 2 filter gaussian }\n"
    "camera { position P(1 2 6) look_at P(0 0.75 0) up D(0 1 0) fov 45 aperture ~0.0625 }\n"
    "render { integrator path max_depth 7 }\n"
    "background 0.125 0.1875 0.25\n"
    "light directional { direction D(-0.5 -1 -0.25) intensity 0.25 }\n"
    "light spot { position P(0 3 3) look_at P(0 0 0) intensity 0.75 inner 20 outer 50 }\n"
    "light point { position P(-2 2.5 1) intensity 0.5 0.25 0.25 }\n"
    "light point { position P(-1 2.5 -1) intensity 0.25 0.5 0.25 }\n"
    "light point { position P(1 2.5 1) intensity 0.25 0.25 0.5 }\n"
    "light point { position P(2 2.5 -1) intensity 0.5 0.5 0.25 }\n"
    "light point { position P(0 2.5 2) intensity 0.25 0.5 0.5 }\n"
    "light sphere { center P(-2.5 1.5 -1) radius ~0.25 radiance 6 5 4 }\n"
    "light rectangle { corner P(1 3 -1) edge1 L(-0.5 0 1) edge2 L(0.75 -0.5 0.25) radiance 4 }\n"
    "texture tiles checker { colors 0.75 0.25 scale ^1 ^1 }\n"
    "texture stains checker { colors 0.5 0.75 0.625  0.75 0.375 0.25 scale 6 3 }\n"
    "material floor phong { diffuse tiles reflect 0.125 }\n"
    "material satin blinn_phong { diffuse 0.25 0.5 0.375 specular 0.375 shininess 24 }\n"
    "material lacquer phong { diffuse 0.5 0.125 0.125 specular 0.25 shininess 80 }\n"
    "material glass phong { diffuse 0 reflect 1 transmit 0.875 1 0.9375 fresnel on }\n"
    "material gold pbr { base_color 0.875 0.625 0.25 metallic 1 roughness 0.25 }\n"
    "material chrome pbr { base_color 0.75 metallic 1 roughness 0 }\n"
    "material resin pbr { base_color stains roughness 0.125 transmit 0.75 }\n"
    "material lamp phong { diffuse 0.5 emission 0.5 0.25 0.125 }\n"
    "plane { point P(0 0 0) normal D(0 1 0) material floor }\n"
    "plane { point P(0 0 -3) normal D(0 0 1) }\n"
    "sphere { center P(-1.5 0.75 0) radius ~0.75 material satin }\n"
    "sphere { center P(0 0.5 1.5) radius ~0.5 material glass }\n"
    "sphere { center P(-0.5 1.75 -0.5) radius ~0.5 material resin }\n"
    "box { center P(1.25 0.5 -0.5) size ~1 ~1 ~1 material chrome }\n"
    "box { center P(2.5 0.25 0.5) size ~0.5 ~0.5 ~0.5 material lamp }\n"
    "mesh { file \"vase.obj\" terminator on scale ~0.5 rotate A(0 0 1) 20 translate P(-0.5 0.25 2)\n"
    "    material lacquer }\n"
    "object cup { mesh { file \"vase.obj\" smooth on terminator on scale ~0.5 } }\n"
    "instance cup { scale 1 1.5 0.75 rotate A(0 1 0) 20 translate P(1 0 2.25) material gold }\n"
    "instance cup { scale 0.75 rotate A(1 0 0) 160 translate P(-1.5 1.25 2) material glass }\n";

// A marked triple at *text, behind its letter and parenthesis; moves *text behind it.
static Vec3 read_triple(const char **text)
{
    Vec3 v;
    char *end;
    v.x = strtod(*text, &end);
    v.y = strtod(end, &end);
    v.z = strtod(end, &end);
    if (*end != ')')
        fail_msg("a mark is broken at '%.20s'", *text);
    *text = end + 1;
    return v;
}

static void append_triple(char **out, char mark, Vec3 v, const SceneMap *map, f64 scale)
{
    // An axis turns with the hand of space: it keeps x where a direction loses it.
    const f64 x = !map->mirrored ? 1 : mark == 'A' ? 1 : -1, yz = map->mirrored && mark == 'A' ? -1 : 1;
    const f64 size = mark == 'P' || mark == 'L' ? scale : 1;
    const Vec3 offset = mark == 'P' ? map->offset : (Vec3){0, 0, 0};
    text_append(out, "%.17g %.17g %.17g", size * x * v.x + offset.x, size * yz * v.y + offset.y,
                size * yz * v.z + offset.z);
}

char *scene_under(const char *marked, const SceneMap *map)
{
    const SceneMap none = {0};
    map = map ? map : &none;
    const f64 scale = map->scale != 0 ? map->scale : 1;
    char *out = NULL;
    text_append(&out, "%s", "");
    for (const char *at = marked; *at;) {
        const char mark = *at;
        if (strchr("PLDA", mark) && at[1] == '(') {
            at += 2;
            append_triple(&out, mark, read_triple(&at), map, scale);
        } else if (mark == '~' || mark == '^') {
            char *end;
            const f64 number = strtod(at + 1, &end);
            text_append(&out, "%.17g", mark == '~' ? number * scale : number / scale);
            at = end;
        } else {
            const size_t plain = 1 + strcspn(at + 1, "PLDA~^");
            text_append(&out, "%.*s", (int)plain, at);
            at += plain;
        }
    }
    return out;
}
