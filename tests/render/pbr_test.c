// The formulas of pbr materials against the scene language in double: a thousand tilted disks, each with a
// material of its own, under a light that shines from one direction, each seen by one pixel from straight above.
#include <math.h>

#include "support.h"

enum { SIDE = 32, DISKS = SIDE * SIDE };

static const f64 PI = 3.14159265358979323846;

typedef struct Disk {
    Vec3 normal; // unit
    Vec3 base;
    f64 metallic, roughness, transmit, ior;
} Disk;

static const Vec3 to_light = {0.6, 0, 0.8};

// The brdf times the cosine, by the formulas as they stand in the scene language.
static Vec3 expected(const Disk *d, Vec3 n)
{
    const Vec3 v = {0, 0, 1}, l = to_light, h = vec_normalize(vec_add(l, v));
    const f64 nl = vec_dot(n, l), nv = fmax(vec_dot(n, v), 1e-4), nh = vec_dot(n, h), vh = vec_dot(v, h);
    if (nl <= 0)
        return (Vec3){0, 0, 0};
    const f64 a = d->roughness * d->roughness, a2 = a * a, m = d->transmit * (1 - d->metallic);
    const f64 edge = (d->ior - 1) / (d->ior + 1), f = edge * edge, t = nh * nh * (a2 - 1) + 1;
    const f64 distribution = a2 / (PI * t * t), schlick = pow(1 - vh, 5);
    const f64 vis = 0.5 / (nl * sqrt(a2 + (1 - a2) * nv * nv) + nv * sqrt(a2 + (1 - a2) * nl * nl));
    const f64 lobe = d->roughness < 0.02 ? 0 : (1 - m) * distribution * vis;
    const f64 base[3] = {d->base.x, d->base.y, d->base.z};
    f64 out[3];
    for (int c = 0; c < 3; c++) {
        const f64 f0 = f + d->metallic * (base[c] - f), fresnel = f0 + (1 - f0) * schlick;
        out[c] = nl * ((1 - fresnel) * (1 - d->metallic) * (1 - d->transmit) * base[c] / PI + fresnel * lobe);
    }
    return (Vec3){out[0], out[1], out[2]};
}

// About the half-way direction, so that narrow lobes are met, and everywhere.
static Disk disk_make(u64 *seed, u32 i)
{
    const Vec3 half = vec_normalize(vec_add(to_light, (Vec3){0, 0, 1}));
    const f64 spread = i % 2 ? pow(10, random_in(seed, -3.5, -1)) : 0.7;
    Disk d = {.metallic = i % 5 == 0 ? 1 : i % 5 == 1 ? 0 : random_unit(seed),
              .roughness = i % 7 == 0 ? 0.0199 : i % 7 == 1 ? 0.0201 : random_in(seed, 0.02, 1),
              .transmit = i % 3 ? 0 : random_unit(seed),
              .ior = random_in(seed, 1, 2.5)};
    d.base = (Vec3){random_unit(seed), random_unit(seed), random_unit(seed)};
    const Vec3 off = {random_in(seed, -1, 1), random_in(seed, -1, 1), random_in(seed, -1, 1)};
    d.normal = vec_normalize(vec_add(half, vec_scale(off, spread)));
    return d;
}

static char *scene_of(const Disk *disks)
{
    char *text = text_of("image { size %d %d }\ncamera { position %g %g 10 look_at %g %g 0 orthographic %d }\n"
                         "ambient 0\nrender { max_depth 0 shadows off }\n"
                         "light directional { direction %.17g %.17g %.17g }\n",
                         SIDE, SIDE, SIDE / 2.0, SIDE / 2.0, SIDE / 2.0, SIDE / 2.0, SIDE, -to_light.x,
                         -to_light.y, -to_light.z);
    for (int i = 0; i < DISKS; i++) {
        const Disk *d = &disks[i];
        text_append(&text,
                    "material m%d pbr { base_color %.9g %.9g %.9g metallic %.9g roughness %.9g transmit %.9g "
                    "ior %.9g }\ndisk { center %g %g 0 normal %.17g %.17g %.17g radius 0.4 material m%d }\n",
                    i, d->base.x, d->base.y, d->base.z, d->metallic, d->roughness, d->transmit, d->ior,
                    i % SIDE + 0.5, SIDE - 0.5 - i / SIDE, d->normal.x, d->normal.y, d->normal.z, i);
    }
    return text;
}

// What rounding the normal to floats may change: the farthest of moves by one rounding each way.
static f64 spread_of(const Disk *d, Vec3 value)
{
    f64 most = 0;
    for (int k = 0; k < 8; k++) {
        const f64 e = 0x1p-23;
        const Vec3 move = {k & 1 ? e : -e, k & 2 ? e : -e, k & 4 ? e : -e};
        const Vec3 other = expected(d, vec_normalize(vec_add(d->normal, move)));
        most = fmax(most, fmax(fabs(other.x - value.x), fmax(fabs(other.y - value.y), fabs(other.z - value.z))));
    }
    return most;
}

static void test_formulas(void **state)
{
    Device *device = *state;
    Disk disks[DISKS];
    u64 seed = 1;
    for (u32 i = 0; i < DISKS; i++)
        disks[i] = disk_make(&seed, i);
    char *text = scene_of(disks);
    Picture picture = render_text(device, text, NULL);
    free(text);
    f64 worst = 0;
    u32 lit = 0, bright = 0;
    for (int i = 0; i < DISKS; i++) {
        const Disk *d = &disks[i];
        const f32 *rgb = pixel_at(&picture, (u32)i % SIDE, (u32)i / SIDE);
        const Vec3 value = expected(d, d->normal);
        const f64 size = fmax(value.x, fmax(value.y, value.z));
        if (d->normal.z < 0.05 || vec_dot(d->normal, to_light) < 1e-3)
            continue; // seen from the side or hardly lit: the pixel may see nothing
        const f64 allowed = 1e-5 * size + spread_of(d, value);
        const f64 off = fmax(fabs(rgb[0] - value.x), fmax(fabs(rgb[1] - value.y), fabs(rgb[2] - value.z)));
        worst = fmax(worst, off / allowed);
        lit++;
        bright += size > 10;
        if (!(off <= allowed))
            fail_msg("disk %d: %g %g %g in place of %.9g %.9g %.9g (roughness %g)", i, rgb[0], rgb[1], rgb[2],
                     value.x, value.y, value.z, d->roughness);
    }
    print_message("%u disks, %u of them brighter than 10; worst error %.2f of what is allowed\n", lit, bright, worst);
    assert_true(lit > DISKS / 2 && bright > 20);
    picture_destroy(&picture);
}

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_formulas, device)};
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
