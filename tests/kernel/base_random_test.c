// Random numbers and sample points of kernels/base: the same integers as plain C, uniform, independent
// between neighbours, and as well distributed as a scrambled (0,2)-sequence must be.
#include "harness.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char source[] =
    "#include \"base/sampling.h\"\n"
    "kernel void bits(uint seed, uint dimension, global const uint *xs, global const uint *ys,\n"
    "                 global const uint *samples, global uint *keys, global uint *r, global float *units)\n"
    "{\n"
    "    const size_t i = get_global_id(0) * LANES;\n"
    "    const vu key = random_pixel_key(VU_LOAD(xs + i), VU_LOAD(ys + i), seed);\n"
    "    const vu3 random = random_bits(key, VU_LOAD(samples + i), dimension);\n"
    "    VU_STORE(key, keys + i);\n"
    "    VU_STORE(random.x, r + 3 * i);\n"
    "    VU_STORE(random.y, r + 3 * i + LANES);\n"
    "    VU_STORE(random.z, r + 3 * i + 2 * LANES);\n"
    "    VF_STORE(random_unit(random.x), units + i);\n"
    "}\n"
    "kernel void points(uint seed, uint pair, global const uint *xs, global const uint *ys,\n"
    "                   global const uint *samples, global float *px, global float *py)\n"
    "{\n"
    "    const size_t i = get_global_id(0) * LANES;\n"
    "    const vu key = random_pixel_key(VU_LOAD(xs + i), VU_LOAD(ys + i), seed);\n"
    "    const SamplePoint p = sample_2d(key, VU_LOAD(samples + i), pair);\n"
    "    VF_STORE(p.x, px + i);\n"
    "    VF_STORE(p.y, py + i);\n"
    "}\n";

static const int widths[] = { 1, 4, 8, 16 };
enum { WIDTHS = sizeof widths / sizeof *widths, COUNT = 1 << 20, SIDE = 1 << 10 };

typedef struct {
    uint32_t x[COUNT], y[COUNT], sample[COUNT];
    uint32_t key[COUNT], bits[3 * COUNT];
    float px[COUNT], py[COUNT];
} Batch;

static Batch *batch_create(void)
{
    Batch *batch = calloc(1, sizeof *batch);
    assert_non_null(batch);
    return batch;
}

static void run_bits(KernelProgram *program, int lanes, uint32_t seed, uint32_t dimension, Batch *b)
{
    kernel_run(program, "bits", COUNT / (size_t)lanes,
               (KernelArg[]){ kernel_value(&seed, sizeof seed), kernel_value(&dimension, sizeof dimension),
                              kernel_in(b->x, sizeof b->x), kernel_in(b->y, sizeof b->y),
                              kernel_in(b->sample, sizeof b->sample), kernel_out(b->key, sizeof b->key),
                              kernel_out(b->bits, sizeof b->bits), kernel_out(b->px, sizeof b->px) }, 8);
}

static void run_points(KernelProgram *program, int lanes, uint32_t seed, uint32_t pair, Batch *b)
{
    kernel_run(program, "points", COUNT / (size_t)lanes,
               (KernelArg[]){ kernel_value(&seed, sizeof seed), kernel_value(&pair, sizeof pair),
                              kernel_in(b->x, sizeof b->x), kernel_in(b->y, sizeof b->y),
                              kernel_in(b->sample, sizeof b->sample), kernel_out(b->px, sizeof b->px),
                              kernel_out(b->py, sizeof b->py) }, 7);
}

// The pixels of a square image, the same sample of each.
static void fill_image(Batch *b, uint32_t sample)
{
    for (uint32_t i = 0; i < COUNT; i++) {
        b->x[i] = i % SIDE;
        b->y[i] = i / SIDE;
        b->sample[i] = sample;
    }
}

// count samples, a power of two, of each of COUNT / count pixels.
static void fill_samples(Batch *b, uint32_t count)
{
    for (uint32_t i = 0; i < COUNT; i++) {
        b->x[i] = i / count % SIDE;
        b->y[i] = i / count / SIDE;
        b->sample[i] = i % count;
    }
}

// The definitions once more, a bit at a time.
static void hash_in_c(uint32_t v[3])
{
    for (int i = 0; i < 3; i++)
        v[i] = v[i] * 1664525u + 1013904223u;
    for (int round = 0; round < 2; round++) {
        v[0] += v[1] * v[2];
        v[1] += v[2] * v[0];
        v[2] += v[0] * v[1];
        for (int i = 0; i < 3 && round == 0; i++)
            v[i] ^= v[i] >> 16;
    }
}

static uint32_t reverse_in_c(uint32_t x)
{
    uint32_t r = 0;
    for (int i = 0; i < 32; i++)
        r |= (x >> i & 1u) << (31 - i);
    return r;
}

static uint32_t scramble_in_c(uint32_t x, uint32_t seed)
{
    x = reverse_in_c(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= seed >> 16 | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverse_in_c(x);
}

// By direction numbers: the polynomial x + 1 gives v(i+1) = v(i) ^ v(i) >> 1.
static uint32_t sobol_second_in_c(uint32_t index)
{
    uint32_t result = 0;
    for (uint32_t v = 1u << 31; index; index >>= 1, v ^= v >> 1)
        if (index & 1u)
            result ^= v;
    return result;
}

static float unit_in_c(uint32_t bits)
{
    return (float)(bits >> 8) * 0x1p-24f;
}

static void the_kernels_agree_with_c_for_all_lanes(void **state)
{
    Batch *b = batch_create();
    const uint32_t seed = 0xdeadbeefu, dimension = 7;
    for (uint32_t i = 0; i < COUNT; i++) {
        b->x[i] = i * 2654435761u >> 16;
        b->y[i] = i * 2246822519u >> 16;
        b->sample[i] = i & 1u ? i * 3266489917u : i;
    }
    for (size_t w = 0; w < WIDTHS; w++) {
        const uint32_t lanes = (uint32_t)widths[w];
        KernelProgram *program = kernel_program_create(*state, source, widths[w]);
        run_bits(program, widths[w], seed, dimension, b);
        uint32_t wrong = 0;
        for (uint32_t i = 0; i < COUNT; i++) {
            uint32_t key[3] = { b->x[i], b->y[i], seed };
            hash_in_c(key);
            uint32_t random[3] = { key[2], b->sample[i], dimension };
            hash_in_c(random);
            wrong += b->key[i] != key[2] || b->px[i] != unit_in_c(random[0]) || b->px[i] >= 1.0f;
            for (uint32_t k = 0; k < 3; k++)
                wrong += b->bits[i / lanes * lanes * 3 + k * lanes + i % lanes] != random[k];
        }
        assert_int_equal(wrong, 0);
        run_points(program, widths[w], seed, 2, b);
        for (uint32_t i = 0; i < COUNT; i += 7) {
            uint32_t seeds[3] = { b->key[i], 2, 0x9e3779b9u };
            hash_in_c(seeds);
            const uint32_t index = scramble_in_c(b->sample[i], seeds[0]);
            assert_true(b->px[i] == unit_in_c(scramble_in_c(reverse_in_c(index), seeds[1])));
            assert_true(b->py[i] == unit_in_c(scramble_in_c(sobol_second_in_c(index), seeds[2])));
        }
        kernel_program_destroy(program);
    }
    free(b);
}

static void the_largest_integer_stays_below_one(void **state)
{
    KernelProgram *program = kernel_program_create(*state,
        "#include \"base/random.h\"\n"
        "kernel void f(global const uint *x, global float *y)\n"
        "{ size_t i = get_global_id(0) * LANES; VF_STORE(random_unit(VU_LOAD(x + i)), y + i); }\n", 4);
    const uint32_t x[4] = { 0xffffffffu, 0u, 0x80000000u, 0xffu };
    float y[4];
    kernel_run(program, "f", 1, (KernelArg[]){ kernel_in(x, sizeof x), kernel_out(y, sizeof y) }, 2);
    kernel_program_destroy(program);
    assert_true(y[0] == 0x1.fffffep-1f && y[1] == 0.0f && y[2] == 0.5f && y[3] == 0.0f);
}

// Chi-square over 2^log2_bins equal bins, in standard deviations from what is expected.
static double chi_square(const uint32_t *bin_of, size_t count, int log2_bins)
{
    const size_t bins = (size_t)1 << log2_bins;
    double *histogram = calloc(bins, sizeof *histogram);
    assert_non_null(histogram);
    for (size_t i = 0; i < count; i++)
        histogram[bin_of[i]]++;
    const double expected = (double)count / (double)bins;
    double sum = 0;
    for (size_t i = 0; i < bins; i++)
        sum += (histogram[i] - expected) * (histogram[i] - expected) / expected;
    free(histogram);
    const double freedom = (double)bins - 1;
    return (sum - freedom) / sqrt(2 * freedom);
}

// Correlation of pixels with those dx, dy further on, times sqrt(n): standard deviations from 0.
static double correlation(const float *a, const float *b, uint32_t dx, uint32_t dy)
{
    double sum = 0;
    size_t count = 0;
    for (uint32_t y = 0; y + dy < SIDE; y++)
        for (uint32_t x = 0; x + dx < SIDE; x++, count++)
            sum += ((double)a[y * SIDE + x] - 0.5) * ((double)b[(y + dy) * SIDE + x + dx] - 0.5);
    return sum * 12 / sqrt((double)count);
}

static void assert_uniform_in_pairs(const float *a, const float *b, uint32_t step, const char *what)
{
    uint32_t *bins = malloc(COUNT * sizeof *bins);
    assert_non_null(bins);
    for (size_t i = 0; i + step < COUNT; i++)
        bins[i] = (uint32_t)(a[i] * 64.0f) << 6 | (uint32_t)(b[i + step] * 64.0f);
    const double deviations = chi_square(bins, COUNT - step, 12);
    free(bins);
    if (!(fabs(deviations) < 4.5))
        fail_msg("%s: chi-square is off by %g standard deviations", what, deviations);
}

// 4 standard deviations for one test; a few hundred are made here, all on fixed numbers.
static void neighbouring_pixels_and_dimensions_are_independent(void **state)
{
    KernelProgram *program = kernel_program_create(*state, source, 8);
    Batch *b = batch_create();
    static float first[COUNT];
    double worst = 0;
    for (uint32_t dimension = 0; dimension < 4; dimension++) {
        fill_image(b, 0);
        run_bits(program, 8, 1, dimension, b);
        assert_uniform_in_pairs(b->px, b->px, 1, "neighbours in x");
        assert_uniform_in_pairs(b->px, b->px, SIDE, "neighbours in y");
        for (uint32_t dy = 0; dy <= 8; dy++)
            for (uint32_t dx = dy == 0; dx <= 8; dx++)
                worst = fmax(worst, fabs(correlation(b->px, b->px, dx, dy)));
        memcpy(first, b->px, sizeof first);
        run_bits(program, 8, 1, dimension + 1, b);
        assert_uniform_in_pairs(first, b->px, 0, "neighbouring dimensions");
        worst = fmax(worst, fabs(correlation(first, b->px, 0, 0)));
        run_bits(program, 8, 2, dimension, b);
        assert_uniform_in_pairs(first, b->px, 0, "neighbouring seeds");
        worst = fmax(worst, fabs(correlation(first, b->px, 0, 0)));
        fill_image(b, 1);
        run_bits(program, 8, 1, dimension, b);
        assert_uniform_in_pairs(first, b->px, 0, "neighbouring samples");
        worst = fmax(worst, fabs(correlation(first, b->px, 0, 0)));
    }
    printf("largest correlation: %.2f standard deviations\n", worst);
    assert_true(worst < 4.5);
    free(b);
    kernel_program_destroy(program);
}

// Sample points of neighbouring pixels and of other pairs of the same pixel.
static void neighbouring_sample_points_are_independent(void **state)
{
    KernelProgram *program = kernel_program_create(*state, source, 8);
    Batch *b = batch_create();
    static float first[COUNT];
    double worst = 0;
    for (uint32_t sample = 0; sample < 4; sample++) {
        fill_image(b, sample);
        run_points(program, 8, 5, 0, b);
        assert_uniform_in_pairs(b->px, b->py, 0, "x and y");
        assert_uniform_in_pairs(b->px, b->px, 1, "neighbours in x");
        assert_uniform_in_pairs(b->py, b->py, SIDE, "neighbours in y");
        for (uint32_t dy = 0; dy <= 4; dy++)
            for (uint32_t dx = dy == 0; dx <= 4; dx++) {
                worst = fmax(worst, fabs(correlation(b->px, b->px, dx, dy)));
                worst = fmax(worst, fabs(correlation(b->py, b->py, dx, dy)));
                worst = fmax(worst, fabs(correlation(b->px, b->py, dx, dy)));
            }
        memcpy(first, b->px, sizeof first);
        run_points(program, 8, 5, 1, b);
        assert_uniform_in_pairs(first, b->px, 0, "pairs");
        worst = fmax(worst, fabs(correlation(first, b->px, 0, 0)));
    }
    printf("largest correlation: %.2f standard deviations\n", worst);
    assert_true(worst < 4.5);
    free(b);
    kernel_program_destroy(program);
}

// Every aligned block of 2^m points has one in each box of volume 2^-m, of all m + 1 shapes.
static void blocks_are_nets(void **state)
{
    enum { MAX_LOG2 = 10, BLOCKS = 4 };
    KernelProgram *program = kernel_program_create(*state, source, 8);
    Batch *b = batch_create();
    static unsigned char hit[1 << MAX_LOG2];
    for (uint32_t m = 0; m <= MAX_LOG2; m++) {
        const uint32_t points = 1u << m;
        fill_samples(b, BLOCKS * points);
        run_points(program, 8, m, m % 3, b);
        for (uint32_t start = 0; start < COUNT && start < points * BLOCKS * 16; start += points) {
            for (uint32_t a = 0; a <= m; a++) {
                memset(hit, 0, points);
                for (uint32_t i = start; i < start + points; i++) {
                    const uint32_t column = (uint32_t)(b->px[i] * (float)(1u << a));
                    const uint32_t row = (uint32_t)(b->py[i] * (float)(1u << (m - a)));
                    assert_int_equal(hit[row << a | column]++, 0);
                }
            }
        }
    }
    free(b);
    kernel_program_destroy(program);
}

// The area of a quarter disk, an edge as pixels have them: the error falls faster than that of random points,
// whose standard deviation is sqrt(p (1 - p) / n).
static void edges_converge_faster_than_random(void **state)
{
    KernelProgram *program = kernel_program_create(*state, source, 8);
    Batch *b = batch_create();
    const double radius2 = 0.7, area = 3.14159265358979323846 / 4 * radius2;
    double first_error = 0, error = 0, bias = 0;
    for (uint32_t n = 4; n <= 1024; n *= 4) {
        fill_samples(b, n);
        run_points(program, 8, 11, 0, b);
        const uint32_t pixels = COUNT / n;
        double squares = 0, sum = 0;
        for (uint32_t pixel = 0; pixel < pixels; pixel++) {
            uint32_t inside = 0;
            for (uint32_t i = pixel * n; i < (pixel + 1) * n; i++) {
                const double x = (double)b->px[i], y = (double)b->py[i];
                inside += x * x + y * y < radius2;
            }
            const double difference = (double)inside / n - area;
            squares += difference * difference;
            sum += difference;
        }
        error = sqrt(squares / pixels);
        bias = sum / pixels;
        first_error = n == 4 ? error : first_error;
        const double random = sqrt(area * (1 - area) / n);
        printf("%4u points: error %.6f, random points %.6f, bias %.7f\n", n, error, random, bias);
        assert_true(fabs(bias) < 4.5 * error / sqrt(pixels));
        assert_true(error < random);
    }
    const double slope = log(error / first_error) / log(1024.0 / 4);
    printf("error falls as n^%.3f\n", slope);
    assert_true(slope < -0.65);
    free(b);
    kernel_program_destroy(program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_kernels_agree_with_c_for_all_lanes),
        cmocka_unit_test(the_largest_integer_stays_below_one),
        cmocka_unit_test(neighbouring_pixels_and_dimensions_are_independent),
        cmocka_unit_test(neighbouring_sample_points_are_independent),
        cmocka_unit_test(blocks_are_nets),
        cmocka_unit_test(edges_converge_faster_than_random),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
