#include "report.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char *report_channel(const Pictures *pictures, u32 channel)
{
    static const char *const GREY[] = {"grey", "alpha"};
    static const char *const COLOR[] = {"red", "green", "blue", "alpha"};
    return pictures->images[0]->channels >= 3 ? COLOR[channel] : GREY[channel];
}

static f64 percent(u64 part, u64 whole)
{
    return 100 * (f64)part / (f64)whole;
}

bool report_finish(Error *error)
{
    if (fflush(stdout) != 0 || ferror(stdout))
        return error_set(error, ERROR_IO, "standard output: %s", strerror(errno));
    return true;
}

static void print_limits(const Options *options, const Pictures *pictures, const Metrics *m)
{
    const Limits *limits = &options->limits;
    if (isfinite(limits->fail)) {
        printf("  beyond %.9g", limits->fail);
        if (pictures->format == FORMAT_PFM && limits->fail_ulp > 0)
            printf(" and %u ulp", limits->fail_ulp);
        printf(": %llu values, %.6g %%; allowed %.6g %%\n", (unsigned long long)m->failed_values,
               percent(m->failed_values, m->values), limits->fail_percent);
    }
    if (isfinite(limits->hard_fail))
        printf("  beyond %.9g: %llu values; allowed none\n", limits->hard_fail,
               (unsigned long long)m->hard_failed_values);
    if (m->nan_values > 0)
        printf("  NaN: %llu values; allowed none\n", (unsigned long long)m->nan_values);
}

static void print_figures(const Pictures *pictures, const Metrics *m)
{
    printf("  mean %.6g, RMSE %.6g, PSNR %.6g dB, relMSE %.6g, SSIM %.6g, FLIP mean %.6g", m->mean_abs,
           m->rmse, m->psnr, m->relmse, m->ssim_mean, m->flip_mean);
    if (pictures->format == FORMAT_PFM)
        printf(", at most %u ulp", m->max_ulp);
    printf("\n");
    if (m->worst.present)
        printf("  worst: pixel %u, %u %s: %.9g and %.9g, %.9g apart\n", m->worst.x, m->worst.y,
               report_channel(pictures, m->worst.channel), (f64)m->worst.a, (f64)m->worst.b, m->max_abs);
}

static void print_test(const Options *options, const Pictures *pictures, const ZTest *test)
{
    printf("  Z-test: %llu of %llu pixels pass, %.6g %%; needed %.6g %%\n",
           (unsigned long long)test->passed_pixels, (unsigned long long)test->pixels,
           percent(test->passed_pixels, test->pixels), options->limits.ztest.pass_percent);
    printf("    p from %.3g, at pixel %u, %u %s; passes above %.3g\n", test->p_min, test->x, test->y,
           report_channel(pictures, test->channel), test->threshold);
    printf("    RMS of z %.6g, 1 expected; bias %.6g, standard error %.6g\n", test->z_rms, test->bias,
           test->bias_error);
}

bool report_text(const Options *options, const Pictures *pictures, const Metrics *m, Error *error)
{
    static const char *const FORMATS[] = {"PNG, 8 bits", "PNG, 16 bits", "PFM"};
    const Region r = pictures->region;
    printf("%s, %s: %s\n", options->sources.paths[0], options->sources.paths[1],
           !m->same                   ? "different"
           : m->different_values == 0 ? "the same"
                                      : "the same within the limits");
    printf("  %u x %u, %u channels, %s", r.width, r.height, pictures->images[0]->channels,
           FORMATS[pictures->format]);
    if (options->sources.crop)
        printf(", from %u, %u", r.x, r.y);
    if (m->left_out_pixels > 0)
        printf(", %llu pixels left out", (unsigned long long)m->left_out_pixels);
    printf("\n  differing: %llu pixels, %.6g %%; %llu values, %.6g %%\n",
           (unsigned long long)m->different_pixels, percent(m->different_pixels, m->pixels),
           (unsigned long long)m->different_values, percent(m->different_values, m->values));
    print_limits(options, pictures, m);
    print_figures(pictures, m);
    if (m->tested)
        print_test(options, pictures, &m->ztest);
    printf("  pixels: FNV-1a %016llx and %016llx\n", (unsigned long long)pictures->hashes[0],
           (unsigned long long)pictures->hashes[1]);
    return report_finish(error);
}
