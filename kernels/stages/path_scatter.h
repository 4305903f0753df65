// How a path goes on from a hit: what the surface makes of light from a direction, and directions drawn by it.
#ifndef CLRT_KERNELS_STAGES_PATH_SCATTER_H
#define CLRT_KERNELS_STAGES_PATH_SCATTER_H

#include "base/frame.h"
#include "material/brightness.h"
#include "shared/light_table.h"
#include "stages/shade.h"

// What the scene and the command line say about paths.
typedef struct {
    uint techniques;     // LIGHTS_BY_X
    uint light_choices;  // lights that are looked at for each shadow ray
    uint area_materials; // index of the material of the first area light, which is light 0
#if HAS_MANY_LIGHTS
    global const LightTableEntry *table; // one for each light
    uint light_count;
#endif
} PathSettings;

// The parts of a surface's scattering, and the probabilities with which a path follows each. Together they are 1,
// or 0 where the path ends.
typedef struct {
    v3 diffuse;         // of phong and blinn_phong
    vf body, lobe;      // cosine-distributed; about the mirror direction
    vf mirror, through; // without a choice of direction
#if HAS_REFLECT || HAS_TRANSMIT
    Scatter scatter;    // their directions and weights
#endif
} PathParts;

// The surface for light from one direction: the brdf, and the density over solid angle with which path_draw gives
// that direction. Mirrors and clear transmission are in neither.
typedef struct {
    v3 brdf;
    vf density;
} Scattering;

// Share of `mine` in light that is looked for by this density and by `other`, by the power heuristic (Veach and
// Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", 1995). mine > 0.
static inline vf power_heuristic(vf mine, vf other)
{
    const vf ratio = other / mine;
    return (vf)(1.0f) / fma(ratio, ratio, (vf)(1.0f));
}

#if HAS_PBR
static inline void path_parts_pbr(const Hit *hit, PathParts *p)
{
    const PbrLanes *m = &hit->pbr;
    const vf nv = -v3_dot(hit->ns, hit->dir);
    const v3 fresnel = pbr_schlick(pbr_f0(m), 1.0f - nv);
    const v3 body = v3_mul(m->base_color, v3_sub(v3_splat(1.0f), fresnel));
    const vf lobe = (1.0f - pbr_through(m)) * brightness(fresnel);
    const vf scattered = (1.0f - m->metallic) * (1.0f - m->transmit) * brightness(body);
    const vm pbr = hit_is_pbr(hit), rough = m->roughness >= (vf)(PBR_MIRROR);
    // Where the surface is seen from below its normal no normal of the lobe is visible: its light is looked for by
    // the cosine.
    const vm visible = nv > (vf)(PBR_GRAZING);
    p->lobe = pbr ? ((rough & visible) ? lobe : (vf)(0.0f)) : p->lobe;
    p->body = pbr ? ((rough & !visible) ? scattered + lobe : scattered) : p->body;
}
#endif

// last: lanes where only light of area lights and the environment is looked for any more. Where no sky is there the
// lobe alone is followed, for which points of area lights would be drawn badly.
OUTLINE PathParts path_parts(const Hit *hit, const Shading *shading, const PathSettings *path, vm last)
{
    PathParts p;
#if HAS_PBR
    p.diffuse = hit->pbr.base_color; // looked up for all materials
#else
    p.diffuse = hit_diffuse(hit, shading);
#endif
    p.body = brightness(p.diffuse);
    p.lobe = p.mirror = p.through = (vf)(0.0f);
#if HAS_SPECULAR
    p.lobe = brightness(row_real3(&hit->material, MATERIAL_SPECULAR));
#endif
#if HAS_PBR
    path_parts_pbr(hit, &p);
#endif
#if HAS_REFLECT || HAS_TRANSMIT
    p.scatter = scatter_make(hit);
    p.mirror = last ? (vf)(0.0f) : brightness(p.scatter.reflect_weight);
    p.through = last ? (vf)(0.0f) : brightness(p.scatter.transmit_weight);
#endif
#if !HAS_ENVIRONMENT
    if (path->techniques & LIGHTS_BY_LIGHTS)
        p.body = last ? (vf)(0.0f) : p.body;
#endif
    if (!(path->techniques & LIGHTS_BY_SURFACES)) {
        p.body = last ? (vf)(0.0f) : p.body;
        p.lobe = last ? (vf)(0.0f) : p.lobe;
    }
    const vf sum = (p.body + p.lobe) + (p.mirror + p.through);
    const vf inverse = sum > (vf)(0.0f) ? (vf)(1.0f) / sum : (vf)(0.0f);
    p.body = p.body * inverse;
    p.lobe = p.lobe * inverse;
    p.mirror = p.mirror * inverse;
    p.through = p.through * inverse;
    return p;
}

#if HAS_SPECULAR
static inline vm hit_is_blinn(const Hit *hit)
{
    return (row_int(&hit->material, MATERIAL_FLAGS) & (int)MATERIAL_BLINN) != (vi)(0);
}

// The highlights of phong and blinn_phong, normalised (scene language, section 6), and the densities of
// highlight_direction: for phong cos^n about the mirror direction, for blinn_phong cos^n about the normal for the
// vector half-way, whose element of solid angle is that of the direction over 4 V.H.
static inline void add_highlight(const Hit *hit, vf share, v3 dir, Scattering *s)
{
    const v3 specular = row_real3(&hit->material, MATERIAL_SPECULAR), to_eye = v3_neg(hit->dir);
    const vf n = row_real(&hit->material, MATERIAL_SHININESS);
    vf brdf, density;
#if HAS_PHONG
    const vf phong = lobe_phong(hit->ns, dir, to_eye, n);
    const vf round = vf_max(v3_dot(hit->ns, dir), (vf)(0.0f)) * INVERSE_PI;
    brdf = phong * (n + 2.0f) * (0.5f * INVERSE_PI);
    density = n > (vf)(0.0f) ? phong * (n + 1.0f) * (0.5f * INVERSE_PI) : round;
#endif
#if HAS_BLINN
    const v3 sum = v3_add(dir, to_eye);
    const vf blinn = lobe_blinn(hit->ns, dir, to_eye, n), twice = sqrt(v3_dot(sum, sum)); // 2 V.H
    const vf blinn_brdf = blinn * (n + 8.0f) * (0.125f * INVERSE_PI);
    const vf blinn_density = blinn * (n + 1.0f) * (0.25f * INVERSE_PI) / vf_max(twice, (vf)(0x1p-20f));
#if HAS_PHONG
    const vm is_blinn = hit_is_blinn(hit);
    brdf = is_blinn ? blinn_brdf : brdf;
    density = is_blinn ? blinn_density : density;
#else
    brdf = blinn_brdf;
    density = blinn_density;
#endif
#endif
    s->brdf = v3_fma(specular, brdf, s->brdf);
    s->density = share > (vf)(0.0f) ? fma(share, density, s->density) : s->density;
}

// A direction by the highlight; it may lie below the surface. Not valid lanes have none.
static inline v3 highlight_direction(const Hit *hit, vf u, vf turn, vm *valid)
{
    const vf n = row_real(&hit->material, MATERIAL_SHININESS);
    v3 dir;
#if HAS_PHONG
    const v3 mirrored = v3_normalize(reflect_about(hit->dir, hit->ns));
    dir = v3_select(n > (vf)(0.0f), lobe_direction(mirrored, n, u, turn), cosine_direction(hit->ns, u, turn));
#endif
#if HAS_BLINN
    const v3 to_eye = v3_neg(hit->dir), h = lobe_direction(hit->ns, n, u, turn);
    const v3 about = v3_normalize(v3_neg(reflect_about(to_eye, h)));
#if HAS_PHONG
    const vm is_blinn = hit_is_blinn(hit);
    dir = v3_select(is_blinn, about, dir);
    *valid = *valid & (!is_blinn | (v3_dot(to_eye, h) > (vf)(0.0f)));
#else
    dir = about;
    *valid = *valid & (v3_dot(to_eye, h) > (vf)(0.0f));
#endif
#endif
    return dir;
}
#endif

// For directions above the surface.
OUTLINE Scattering path_scattering(const Hit *hit, const PathParts *p, v3 dir)
{
    Scattering s;
    const vf cosine = v3_dot(hit->ns, dir), even = p->body * cosine * INVERSE_PI;
    s.brdf = v3_scale(p->diffuse, (vf)(INVERSE_PI));
    s.density = even;
#if HAS_SPECULAR
    const v3 specular = row_real3(&hit->material, MATERIAL_SPECULAR);
    if (vm_any(brightness(specular) > (vf)(0.0f)))
        add_highlight(hit, p->lobe, dir, &s);
#endif
#if HAS_PBR
    const vm pbr = hit_is_pbr(hit);
    if (vm_any(pbr)) {
        const v3 to_eye = v3_neg(hit->dir);
        const PbrGeometry g = pbr_geometry(&hit->pbr, hit->ns, to_eye, dir);
        s.brdf = v3_select(pbr, pbr_brdf(&hit->pbr, hit->ns, to_eye, dir), s.brdf);
        const vf drawn = p->lobe > (vf)(0.0f) ? fma(p->lobe, pbr_lobe_density(&g), even) : even;
        s.density = pbr ? drawn : s.density;
    }
#endif
    return s;
}

// What a path follows from a hit.
typedef struct {
    v3 dir, weight; // weight: what the throughput is multiplied by
    vf density;     // of dir; 0 where it had no choice
    vm through;     // to the other side
    vm on;
} PathDraw;

// One coordinate of the point chooses the part and then, stretched, what is drawn of it: each part has points that
// are spread as well as all are.
OUTLINE PathDraw path_draw(const Hit *hit, const PathParts *p, SamplePoint point)
{
    PathDraw d;
    const vf body_end = p->body, lobe_end = body_end + p->lobe;
    const vm body = (point.x < body_end) | ((p->lobe + p->mirror) + p->through == (vf)(0.0f));
    const vm lobe = !body & ((point.x < lobe_end) | (p->mirror + p->through == (vf)(0.0f)));
    d.on = (p->body + p->lobe) + (p->mirror + p->through) > (vf)(0.0f);
    d.through = (vm)(0);
    const vf begin = body ? (vf)(0.0f) : body_end, size = body ? p->body : p->lobe;
    const vf inside = (point.x - begin) / (size > (vf)(0.0f) ? size : (vf)(1.0f));
    const vf u = vf_clamp(inside, 0.0f, 1.0f - ROUNDING);
    d.dir = cosine_direction(hit->ns, u, point.y);
#if HAS_SPECULAR || HAS_PBR
    if (vm_any(lobe)) {
        vm valid = d.on;
        v3 about = d.dir;
#if HAS_SPECULAR
        about = highlight_direction(hit, u, point.y, &valid);
#endif
#if HAS_PBR
        const vm pbr = hit_is_pbr(hit);
        about = v3_select(pbr, pbr_lobe_direction(&hit->pbr, hit->ns, v3_neg(hit->dir), u, point.y), about);
        valid = valid | (pbr & d.on);
#endif
        d.dir = v3_select(lobe, about, d.dir);
        d.on = d.on & (!lobe | valid);
    }
#endif
    const vm chosen = body | lobe;
    const vf cosine = v3_dot(hit->ns, d.dir);
    const Scattering s = path_scattering(hit, p, d.dir);
    const vm some = (cosine > (vf)(0.0f)) & (s.density > (vf)(0.0f));
    d.density = s.density;
    d.weight = v3_scale(s.brdf, cosine / (some ? s.density : (vf)(1.0f)));
    d.on = d.on & (some | !chosen);
#if HAS_REFLECT || HAS_TRANSMIT
    const vm mirror = !chosen & ((point.x < lobe_end + p->mirror) | (p->through == (vf)(0.0f)));
    const vm through = !chosen & !mirror;
    const v3 mirrored = v3_scale(p->scatter.reflect_weight, (vf)(1.0f) / (mirror ? p->mirror : (vf)(1.0f)));
    const v3 clear = v3_scale(p->scatter.transmit_weight, (vf)(1.0f) / (through ? p->through : (vf)(1.0f)));
    d.dir = v3_select(mirror, p->scatter.reflect_dir, v3_select(through, p->scatter.transmit_dir, d.dir));
    d.weight = v3_select(mirror, mirrored, v3_select(through, clear, d.weight));
    d.density = chosen ? d.density : (vf)(0.0f);
    d.through = through;
#endif
    return d;
}

#endif
