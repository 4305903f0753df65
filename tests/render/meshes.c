#include "meshes.h"

#include <math.h>
#include <unistd.h>

#include "base/vec.h"
#include "support.h"

static FILE *start_file(const char *name, char **path)
{
    char folder[4096];
    assert_non_null(getcwd(folder, sizeof folder));
    *path = text_of("%s/%s", folder, name);
    FILE *file = fopen(*path, "w");
    if (!file)
        fail_msg("cannot write %s", *path);
    return file;
}

char *mesh_write_bumpy(const char *name, u32 n)
{
    const f64 turn = 2 * acos(-1);
    const u32 rings = n / 2;
    char *path;
    FILE *file = start_file(name, &path);
    for (u32 y = 0; y <= rings; y++) {
        for (u32 x = 0; x < n; x++) {
            const f64 a = turn * x / n, b = turn / 2 * y / rings;
            const f64 r = 1 + 0.25 * sin(5 * a) * pow(sin(b), 2) * cos(4 * b);
            fprintf(file, "v %.9g %.9g %.9g\nvt %.9g %.9g\n", r * sin(b) * cos(a), r * cos(b),
                    -r * sin(b) * sin(a), (f64)x / n, 1 - (f64)y / rings);
        }
    }
    for (u32 y = 0; y < rings; y++) {
        for (u32 x = 0; x < n; x++) {
            const u32 pole = y == 0 ? 1 : y * n + x + 1, top = y == 0 ? pole : y * n + (x + 1) % n + 1;
            const u32 low = y + 1 == rings ? rings * n + 1 : (y + 1) * n + x + 1;
            const u32 right = y + 1 == rings ? low : (y + 1) * n + (x + 1) % n + 1;
            if (right != low)
                fprintf(file, "f %u/%u %u/%u %u/%u\n", pole, pole, low, low, right, right);
            if (top != pole)
                fprintf(file, "f %u/%u %u/%u %u/%u\n", pole, pole, right, right, top, top);
        }
    }
    assert_int_equal(fclose(file), 0);
    return path;
}

// ---- soup -----------------------------------------------------------------------------------

static f64 soup_number(u64 *seed, f64 range)
{
    const f64 x = random_in(seed, -range, range);
    return random_unit(seed) < 0.5 ? floor(2 * x) / 2 : x;
}

static Vec3 soup_point(u64 *seed, f64 range)
{
    return (Vec3){soup_number(seed, range), soup_number(seed, range), soup_number(seed, range)};
}

static void write_point(FILE *file, Vec3 p)
{
    fprintf(file, "v %.9g %.9g %.9g\n", p.x, p.y, p.z);
}

static u32 write_apart(FILE *file, u64 *seed, bool thin)
{
    const Vec3 a = soup_point(seed, 1.5);
    const f64 width = thin ? pow(10, random_in(seed, -6, -1)) : 0.75;
    write_point(file, a);
    write_point(file, vec_add(a, soup_point(seed, thin ? 1.5 : 0.75)));
    write_point(file, vec_add(a, vec_scale(soup_point(seed, 1), width)));
    fprintf(file, random_unit(seed) < 0.3 ? "f -3//-1 -2//-2 -1//-3\n" : "f -3 -2 -1\n");
    return 1;
}

// A sheet of two by two squares along two axes, whose inner edges rays along an axis run into.
static u32 write_sheet(FILE *file, u64 *seed)
{
    const Vec3 a = soup_point(seed, 1.5);
    const int axis = (int)(3 * random_unit(seed));
    for (int y = 0; y < 3; y++) {
        for (int x = 0; x < 3; x++) {
            const f64 s = 0.5 * x, t = 0.5 * y;
            write_point(file, vec_add(a, axis == 0 ? (Vec3){0, s, t} : axis == 1 ? (Vec3){t, 0, s}
                                                                                 : (Vec3){s, t, 0}));
        }
    }
    for (int k = 0; k < 4; k++) {
        const int corner = -9 + 3 * (k / 2) + k % 2;
        fprintf(file, "f %d %d %d %d\n", corner, corner + 1, corner + 4, corner + 3);
    }
    return 8;
}

// Triangles about a vertex that they share: a closed pyramid without its base.
static u32 write_fan(FILE *file, u64 *seed)
{
    const Vec3 tip = soup_point(seed, 1.5);
    const f64 start = random_in(seed, 0, 1), radius = random_in(seed, 0.1, 0.75);
    write_point(file, tip);
    for (int k = 0; k < 6; k++) {
        const f64 angle = start + acos(-1) * k / 3;
        write_point(file, vec_add(tip, (Vec3){radius * cos(angle), -0.5, radius * sin(angle)}));
    }
    for (int k = 0; k < 6; k++)
        fprintf(file, "f -7 %d %d\n", k - 6, (k + 1) % 6 - 6);
    return 6;
}

// The path of the MTL file beside an OBJ; the caller's to free.
static char *materials_path(const char *path)
{
    return text_of("%.*s.mtl", (int)(strlen(path) - strlen(".obj")), path);
}

static void write_materials(const char *path)
{
    char *mtl = materials_path(path);
    FILE *file = fopen(mtl, "w");
    if (!file)
        fail_msg("cannot write %s", mtl);
    fprintf(file, "newmtl glassy\nKd 0.25 0.5 0.75\nd 0.25\nnewmtl solid\nKd 0.5 0.25 0.25\n");
    assert_int_equal(fclose(file), 0);
    free(mtl);
}

char *mesh_write_soup(const char *name, u32 triangles, u64 seed)
{
    static const char *const materials[] = {"glassy", "solid", "glassy", "solid", "solid"};
    char *path;
    FILE *file = start_file(name, &path);
    write_materials(path);
    fprintf(file, "mtllib %.*s.mtl\nvn 0 1 0\nvn 1 1 0.5\nvn -0.25 0.5 1\n",
            (int)(strlen(name) - strlen(".obj")), name);
    for (u32 count = 0, k = 0; count < triangles; k++) {
        if (k % 7 == 6)
            fprintf(file, "usemtl %s\n", materials[k / 7 % 5]);
        const u64 before = seed;
        switch (k % 9) {
        case 2: count += write_sheet(file, &seed); break;
        case 4: count += write_fan(file, &seed); break;
        case 6: // the same triangle twice
            count += write_apart(file, &seed, false);
            seed = before;
            count += write_apart(file, &seed, false);
            break;
        default: count += write_apart(file, &seed, k % 2 == 1);
        }
    }
    assert_int_equal(fclose(file), 0);
    return path;
}

void mesh_remove(char *path)
{
    char *mtl = materials_path(path);
    remove(path);
    remove(mtl);
    free(mtl);
    free(path);
}
