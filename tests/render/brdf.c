#include "brdf.h"

#include "support.h"

#include <math.h>

#include "base/vec.h"

static const f64 PI = 3.14159265358979323846;

enum { RINGS = 600, SPOKES = 300 }; // of directions: half of a turn, since the other half mirrors it

static Vec3 eye_at(f64 cosine) { return (Vec3){sqrt(1 - cosine * cosine), cosine, 0}; }

static Vec3 direction_about_y(f64 cosine, f64 turn)
{
    const f64 sine = sqrt(fmax(1 - cosine * cosine, 0));
    return (Vec3){sine * cos(turn), cosine, sine * sin(turn)};
}

// (n + 2) / 2pi cos^n about the mirrored eye, by directions of density (n + 1) / 2pi cos^n. All of n = 0 is 1
// / pi.
static f64 phong_albedo(f64 n, f64 cosine)
{
    if (n == 0)
        return 1;
    const f64 sine = sqrt(1 - cosine * cosine);
    f64 sum = 0;
    for (int i = 0; i < RINGS; i++) {
        const f64 about = pow((i + 0.5) / RINGS, 1 / (n + 1));
        for (int k = 0; k < SPOKES; k++) {
            const Vec3 local = direction_about_y(about, (k + 0.5) / SPOKES * PI);
            sum += fmax(local.y * cosine + local.x * sine, 0);
        }
    }
    return (n + 2) / (n + 1) * sum / RINGS / SPOKES;
}

// (n + 8) / 8pi cos^n of the normal and the vector half-way, by those of density (n + 1) / 2pi cos^n: an
// element of directions is 4 V.H of theirs.
static f64 blinn_albedo(f64 n, f64 cosine)
{
    const Vec3 eye = eye_at(cosine);
    f64 sum = 0;
    for (int i = 0; i < RINGS; i++) {
        const f64 about = pow((i + 0.5) / RINGS, 1 / (n + 1));
        for (int k = 0; k < SPOKES; k++) {
            const Vec3 h = direction_about_y(about, (k + 0.5) / SPOKES * PI);
            const f64 vh = vec_dot(eye, h);
            sum += vh > 0 ? fmax(2 * vh * h.y - eye.y, 0) * vh : 0;
        }
    }
    return n == 0 ? 1 : (n + 8) / (n + 1) * sum / RINGS / SPOKES;
}

static f64 schlick(f64 f0, f64 cosine) { return f0 + (1 - f0) * pow(1 - cosine, 5); }

// The lobe by normals of the distribution, whose tail is seen by steps that shrink towards it: the part
// beyond s^4.
static f64 lobe_albedo(f64 roughness, f64 f0, f64 cosine)
{
    const Vec3 eye = eye_at(cosine);
    const f64 a2 = pow(roughness, 4);
    f64 sum = 0;
    for (int i = 0; i < RINGS; i++) {
        const f64 s = (i + 0.5) / RINGS, beyond = pow(s, 4), hy = 1 / sqrt(1 + a2 * (1 - beyond) / beyond);
        for (int k = 0; k < SPOKES; k++) {
            const Vec3 h = direction_about_y(hy, (k + 0.5) / SPOKES * PI);
            const f64 vh = vec_dot(eye, h), nl = 2 * vh * h.y - eye.y;
            if (nl <= 0 || vh <= 0)
                continue;
            const f64 masking =
                nl * sqrt(a2 + (1 - a2) * cosine * cosine) + cosine * sqrt(a2 + (1 - a2) * nl * nl);
            sum += schlick(f0, vh) * 0.5 / masking * nl * 4 * vh / hy * 4 * beyond / s;
        }
    }
    return sum / RINGS / SPOKES;
}

// What Fresnel's share at half-way normals leaves of the cosine's directions.
static f64 body_albedo(f64 f0, f64 cosine)
{
    const Vec3 eye = eye_at(cosine);
    f64 sum = 0;
    for (int i = 0; i < RINGS; i++) {
        for (int k = 0; k < SPOKES; k++) {
            const Vec3 light = direction_about_y(sqrt((i + 0.5) / RINGS), (k + 0.5) / SPOKES * PI);
            sum += 1 - schlick(f0, vec_dot(eye, vec_normalize(vec_add(eye, light))));
        }
    }
    return sum / RINGS / SPOKES;
}

f64 dielectric_reflectance(f64 cosine, f64 ior)
{
    const f64 squared = 1 - (1 - cosine * cosine) / (ior * ior);
    if (squared <= 0)
        return 1;
    const f64 behind = sqrt(squared), s = (cosine - ior * behind) / (cosine + ior * behind),
              p = (ior * cosine - behind) / (ior * cosine + behind);
    return (s * s + p * p) / 2;
}

static f64 pbr_albedo(const Matter *m, f64 cosine)
{
    const f64 f = pow((m->ior - 1) / (m->ior + 1), 2), f0 = f + (m->diffuse - f) * m->metallic;
    const f64 through = m->transmit * (1 - m->metallic), boundary = dielectric_reflectance(cosine, m->ior);
    const f64 body = (1 - m->metallic) * (1 - m->transmit) * m->diffuse;
    const f64 lobe = m->roughness < 0.02 ? schlick(f0, cosine) : lobe_albedo(m->roughness, f0, cosine);
    return (body > 0 ? body * body_albedo(f0, cosine) : 0) + (1 - through) * lobe +
           through * ((1 - boundary) * m->diffuse + boundary);
}

f64 matter_albedo(const Matter *m, f64 cosine)
{
    if (strcmp(m->kind, "pbr") == 0)
        return pbr_albedo(m, cosine);
    const f64 boundary = dielectric_reflectance(cosine, m->ior);
    const f64 highlight = m->specular <= 0                ? 0
                          : strcmp(m->kind, "phong") == 0 ? phong_albedo(m->shininess, cosine)
                                                          : blinn_albedo(m->shininess, cosine);
    const bool total = boundary >= 1 && m->transmit > 0;
    const f64 back = m->fresnel ? (total ? fmax(m->reflect, m->transmit) : m->reflect * boundary)
                                : m->reflect + (total ? m->transmit : 0);
    const f64 through = total ? 0 : m->fresnel ? m->transmit * (1 - boundary) : m->transmit;
    return m->diffuse + m->specular * highlight + back + through;
}

void matter_append(char **text, const char *name, const Matter *m)
{
    if (strcmp(m->kind, "pbr") == 0)
        text_append(
            text, "material %s pbr { base_color %.9g metallic %.9g roughness %.9g transmit %.9g ior %.9g }\n",
            name, m->diffuse, m->metallic, m->roughness, m->transmit, m->ior);
    else
        text_append(text,
                    "material %s %s { diffuse %.9g specular %.9g shininess %.9g reflect %.9g transmit %.9g "
                    "ior %.9g fresnel %s }\n",
                    name, m->kind, m->diffuse, m->specular, m->shininess, m->reflect, m->transmit, m->ior,
                    m->fresnel ? "on" : "off");
}
