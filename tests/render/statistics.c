#include "statistics.h"

enum { BLOCK = 10 }; // pixels

static const f64 SIGNIFICANCE = 0.01, PASS_SHARE = 0.9975;

f64 sidak_threshold(f64 n) { return -expm1(log1p(-SIGNIFICANCE) / n); }

f64 normal_p(f64 z) { return isnan(z) ? 0 : erfc(fabs(z) * sqrt(0.5)); }

// Abramowitz and Stegun, "Handbook of Mathematical Functions", 26.7.3 and 26.7.4.
f64 student_p(f64 t, u32 dof)
{
    const f64 angle = atan(fabs(t) / sqrt(dof)), sine = sin(angle), cosine = cos(angle);
    const bool odd = dof % 2 == 1;
    f64 term = odd ? cosine : 1, sum = 0;
    for (u32 k = odd ? 3 : 2; k <= dof; k += 2) {
        sum += term;
        term *= cosine * cosine * (k - 1) / k;
    }
    const f64 inside = odd ? (angle + sine * sum) * 0.63661977236758134 : sine * sum;
    return isnan(t) ? 0 : fmax(1 - inside, 0);
}

void verdict_add(Verdicts *verdicts, const char *what, Estimate found, f64 expected, f64 most)
{
    // Where an estimate has no variance the rounding of floats is left.
    const f64 error = hypot(found.error, 1e-6 * fabs(expected) + 1e-12), z = (found.mean - expected) / error;
    print_message("%-52s %11.6g +- %7.1g, exact %11.6g, z %5.2f\n", what, found.mean, found.error, expected,
                  z);
    if (!(fabs(found.mean - expected) <= most))
        fail_msg("%s: %.9g is not within %.3g of %.9g", what, found.mean, most, expected);
    if (verdicts->count++ == 0 || normal_p(z) < verdicts->smallest_p) {
        verdicts->smallest_p = normal_p(z);
        verdicts->z = z;
        snprintf(verdicts->worst, sizeof verdicts->worst, "%s", what);
    }
}

void verdicts_end(const Verdicts *verdicts)
{
    assert_true(verdicts->count > 0);
    const f64 threshold = sidak_threshold(verdicts->count);
    print_message("%u values; the worst z is %.2f, of '%s': p %.2g, threshold %.2g\n", verdicts->count,
                  verdicts->z, verdicts->worst, verdicts->smallest_p, threshold);
    if (!(verdicts->smallest_p > threshold))
        fail_msg("%s: %.1f standard errors off, p %.2g of %.2g", verdicts->worst, verdicts->z,
                 verdicts->smallest_p, threshold);
}

Seeds seeds_render(Device *device, const Layout *layout, u32 first, u32 count)
{
    Seeds seeds = {.width = layout->params.width, .height = layout->params.height, .count = count};
    seeds.rgb = render_with_seeds(device, layout, first, count);
    return seeds;
}

void seeds_destroy(Seeds *seeds)
{
    free(seeds->rgb);
    memset(seeds, 0, sizeof *seeds);
}

typedef struct Difference {
    f64 mean, error; // of b - a
    f64 size;        // mean of a
} Difference;

// Of `count` pairs, one a picture, `stride` apart.
static Difference difference_of(const f32 *a, const f32 *b, u32 count, size_t stride)
{
    f64 sum = 0, squares = 0, size = 0;
    for (u32 k = 0; k < count; k++) {
        sum += (f64)b[k * stride] - (f64)a[k * stride];
        size += (f64)a[k * stride];
    }
    const f64 mean = sum / count;
    for (u32 k = 0; k < count; k++) {
        const f64 off = (f64)b[k * stride] - (f64)a[k * stride] - mean;
        squares += off * off;
    }
    return (Difference){mean, sqrt(squares / count / (count - 1)), size / count};
}

typedef struct Part {
    u32 left, top, width, height;
} Part;

// Of the means of all values of the part, one a picture.
static Difference difference_of_means(const Seeds *a, const Seeds *b, Part part)
{
    const size_t values = 3 * (size_t)a->width * a->height;
    const f64 count = 3 * (f64)part.width * part.height;
    f32 *means = calloc(2 * (size_t)a->count, sizeof *means);
    assert_non_null(means);
    for (u32 k = 0; k < a->count; k++) {
        f64 sums[2] = {0, 0};
        for (u32 y = part.top; y < part.top + part.height; y++) {
            const size_t row = k * values + 3 * (size_t)a->width * y;
            for (size_t i = row + 3 * (size_t)part.left; i < row + 3 * (size_t)(part.left + part.width);
                 i++) {
                sums[0] += (f64)a->rgb[i];
                sums[1] += (f64)b->rgb[i];
            }
        }
        means[k] = (f32)(sums[0] / count);
        means[a->count + k] = (f32)(sums[1] / count);
    }
    const Difference difference = difference_of(means, means + a->count, a->count, 1);
    free(means);
    return difference;
}

// Student's t; the rounding of floats is left where pictures have no variance.
static f64 student_t(const Difference *d) { return d->mean / hypot(d->error, 2e-6 * fabs(d->size) + 1e-12); }

static void expect_same_blocks(const Seeds *a, const Seeds *b, const char *what)
{
    const u32 columns = (a->width + BLOCK - 1) / BLOCK, rows = (a->height + BLOCK - 1) / BLOCK;
    const f64 threshold = sidak_threshold((f64)columns * rows);
    f64 worst = 0;
    for (u32 k = 0; k < columns * rows; k++) {
        const u32 left = k % columns * BLOCK, top = k / columns * BLOCK;
        const Part part = {left, top, a->width - left < BLOCK ? a->width - left : BLOCK,
                           a->height - top < BLOCK ? a->height - top : BLOCK};
        const Difference d = difference_of_means(a, b, part);
        const f64 t = student_t(&d);
        worst = fabs(t) > fabs(worst) ? t : worst;
        if (!(student_p(t, a->count - 1) > threshold))
            fail_msg("%s: the block at (%u, %u) has a mean of %.6g and %.3g more: t %.2f", what, left, top,
                     d.size, d.mean, t);
    }
    print_message("%-40s %u blocks, the worst t is %.2f\n", what, columns * rows, worst);
}

void expect_same_mean(const Seeds *a, const Seeds *b, f64 most, const char *what)
{
    assert_true(a->width == b->width && a->height == b->height && a->count == b->count && a->count > 2);
    const size_t pixels = (size_t)a->width * a->height, values = 3 * pixels;
    const f64 threshold = sidak_threshold((f64)values);
    f64 smallest = 2, squares = 0;
    size_t passed = 0, worst = 0;
    for (size_t i = 0; i < pixels; i++) {
        bool good = true;
        for (size_t c = 3 * i; c < 3 * i + 3; c++) {
            const Difference d = difference_of(a->rgb + c, b->rgb + c, a->count, values);
            const f64 t = student_t(&d), p = student_p(t, a->count - 1);
            good = good && p > threshold;
            squares += t * t;
            worst = p < smallest ? i : worst;
            smallest = fmin(p, smallest);
        }
        passed += good;
    }
    const Difference mean = difference_of_means(a, b, (Part){0, 0, a->width, a->height});
    const f64 t = student_t(&mean);
    print_message("%-40s %zu of %zu pixels pass, least p %.1g at (%zu, %zu), t rms %.3f\n", what, passed,
                  pixels, smallest, worst % a->width, worst / a->width, sqrt(squares / (f64)values));
    print_message("%-40s mean %.5g, apart by %.2g of it: t %.2f\n", what, mean.size, mean.mean / mean.size,
                  t);
    if (!((f64)passed >= PASS_SHARE * (f64)pixels))
        fail_msg("%s: %zu of %zu pixels differ", what, pixels - passed, pixels);
    if (!(fabs(t) <= 4) || !(fabs(mean.mean) <= most * mean.size))
        fail_msg("%s: the mean differs by %.3g of it, t %.2f", what, mean.mean / mean.size, t);
    expect_same_blocks(a, b, what);
}
