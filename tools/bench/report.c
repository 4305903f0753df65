#include "report.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "table.h"

static const f64 MILLION = 1e6;

static f64 per_primitive(f64 bytes, const SceneResult *scene)
{
    return bytes / (f64)scene->primitives;
}

static void report_builds(const SceneResult *scenes, u32 count, const BenchOptions *options, Table *table)
{
    table_row(table);
    table_cell(table, "scene");
    static const char *const HEADS[] = {"primitives", "instances", "nodes",  "blocks",
                                        "build s",    "layout s",  "B/prim", "compile s"};
    for (size_t i = 0; i < sizeof HEADS / sizeof *HEADS; i++)
        table_cell(table, "%s", HEADS[i]);
    for (int k = 0; k < EMBREE_SCENES && options->embree; k++) {
        const char *flag = k == 0 ? "robust" : "fast";
        table_cell(table, "Embree %s s", flag);
        table_cell(table, "build ratio");
        table_cell(table, "B/prim");
        table_cell(table, "peak");
    }
    for (u32 i = 0; i < count; i++) {
        const SceneResult *s = &scenes[i];
        table_row(table);
        table_cell(table, "%s", s->name);
        table_cell(table, "%llu", (unsigned long long)s->primitives);
        table_cell(table, "%llu", (unsigned long long)s->instances);
        table_cell(table, "%u", s->nodes);
        table_cell(table, "%u", s->blocks);
        table_cell(table, "%.3f", s->build_seconds);
        table_cell(table, "%.3f", s->layout_seconds);
        table_cell(table, "%.1f", per_primitive((f64)s->bytes, s));
        table_cell(table, "%.2f", s->compile_seconds);
        for (int k = 0; k < EMBREE_SCENES && options->embree; k++) {
            if (!(s->embree_seconds[k] > 0)) {
                for (int cell = 0; cell < 4; cell++)
                    table_cell(table, "-");
                continue;
            }
            table_cell(table, "%.3f", s->embree_seconds[k]);
            table_cell(table, "%.2f", s->build_seconds / s->embree_seconds[k]);
            table_cell(table, "%.1f", per_primitive((f64)s->embree_bytes[k], s));
            table_cell(table, "%.1f", per_primitive((f64)s->embree_peak[k], s));
        }
    }
}

static void add_versus(Table *table, const SetResult *set, bool robust)
{
    const Versus cpu = versus_embree(set, robust, METRIC_CPU), wall = versus_embree(set, robust, METRIC_WALL);
    if (cpu.best == 0 || wall.best == 0) {
        for (int cell = 0; cell < 4; cell++)
            table_cell(table, "-");
        return;
    }
    const Contender *best = &set->contenders[cpu.best];
    table_cell(table, "%.1f (%s)", best->medians[METRIC_CPU] / MILLION, embree_mode_name(best->mode));
    table_cell(table, "%.2f", cpu.ratio);
    table_cell(table, "%.2f", cpu.of_rounds);
    table_cell(table, "%.2f", wall.ratio);
}

// Of Embree's robust modes, else of any, the most of each.
static Mismatch worst_mismatch(const SetResult *set, bool robust)
{
    Mismatch worst = {0, 0, 0};
    for (u32 k = 1; k < set->contender_count; k++) {
        const Mismatch *m = &set->contenders[k].mismatch;
        if (set->contenders[k].robust != robust)
            continue;
        worst.hit_miss = m->hit_miss > worst.hit_miss ? m->hit_miss : worst.hit_miss;
        worst.other = m->other > worst.other ? m->other : worst.other;
        worst.t_error = fmax(worst.t_error, m->t_error);
    }
    return worst;
}

// Where clrt and Embree differ, in any mode.
static Verdict arbitration(const SetResult *set)
{
    Verdict sum = {0, 0};
    for (u32 k = 1; k < set->contender_count; k++) {
        sum.checked += set->contenders[k].arbitration.checked;
        sum.wrong += set->contenders[k].arbitration.wrong;
    }
    return sum;
}

static void add_set(Table *table, const char *scene, const SetResult *set, const BenchOptions *options)
{
    const Contender *own = &set->contenders[0];
    table_row(table);
    table_cell(table, "%s %s", scene, ray_kind_name(set->kind));
    table_cell(table, "%u%s", set->rays, set->rays < RAYS_FEW ? "!" : "");
    table_cell(table, "%.1f", own->medians[METRIC_CPU] / MILLION);
    table_cell(table, "%.1f", own->medians[METRIC_WALL] / MILLION);
    if (options->visits) {
        table_cell(table, "%.1f", set->nodes);
        table_cell(table, "%.1f", set->leaves);
    }
    if (options->embree) {
        const Mismatch robust = worst_mismatch(set, true), fast = worst_mismatch(set, false);
        add_versus(table, set, true);
        add_versus(table, set, false);
        table_cell(table, "%u %u %.0e", robust.hit_miss, robust.other, robust.t_error);
        table_cell(table, "%u %u %.0e", fast.hit_miss, fast.other, fast.t_error);
        const Verdict verdict = arbitration(set);
        table_cell(table, "%u of %u", verdict.wrong, verdict.checked);
    }
    if (options->check)
        table_cell(table, "%u of %u", set->verdict.wrong, set->verdict.checked);
}

static void report_rates(const SceneResult *scenes, u32 count, const BenchOptions *options, Table *table)
{
    table_row(table);
    table_cell(table, "scene, rays");
    table_cell(table, "rays");
    table_cell(table, "clrt");
    table_cell(table, "wall");
    if (options->visits) {
        table_cell(table, "nodes");
        table_cell(table, "leaves");
    }
    for (int k = 0; k < EMBREE_SCENES && options->embree; k++) {
        table_cell(table, "%s", k == 0 ? "Embree robust" : "Embree fast");
        table_cell(table, "ratio");
        table_cell(table, "of rounds");
        table_cell(table, "wall ratio");
    }
    if (options->embree) {
        table_cell(table, "differ robust");
        table_cell(table, "differ fast");
        table_cell(table, "clrt wrong");
    }
    if (options->check)
        table_cell(table, "check wrong");
    for (u32 i = 0; i < count; i++)
        for (u32 k = 0; k < scenes[i].set_count; k++)
            add_set(table, scenes[i].name, &scenes[i].sets[k], options);
}

// Geometric mean and least of the ratios of all sets that are large enough.
typedef struct Summary {
    u32 sets;
    f64 mean, least;
} Summary;

static Summary summarize(const SceneResult *scenes, u32 count, bool robust, Metric metric)
{
    Summary summary = {0, 0, INFINITY};
    for (u32 i = 0; i < count; i++) {
        for (u32 k = 0; k < scenes[i].set_count; k++) {
            const SetResult *set = &scenes[i].sets[k];
            const Versus versus = versus_embree(set, robust, metric);
            if (versus.best == 0 || set->rays < RAYS_FEW)
                continue;
            summary.sets++;
            summary.mean += log(versus.ratio);
            summary.least = fmin(summary.least, versus.ratio);
        }
    }
    summary.mean = summary.sets > 0 ? exp(summary.mean / summary.sets) : 0;
    return summary;
}

static void report_summary(const SceneResult *scenes, u32 count)
{
    static const char *const METRIC_NAMES[METRICS] = {"wall time", "processor time"};
    for (int robust = 1; robust >= 0; robust--) {
        for (int metric = METRICS - 1; metric >= 0; metric--) {
            const Summary s = summarize(scenes, count, robust, (Metric)metric);
            if (s.sets > 0)
                printf("clrt to Embree's best %s mode by %s: geometric mean %.3f, least %.3f, of %u sets\n",
                       robust ? "robust" : "fast", METRIC_NAMES[metric], s.mean, s.least, s.sets);
        }
    }
}

void report_text(const SceneResult *scenes, u32 count, const BenchOptions *options, const Setting *setting)
{
    Table *tables = calloc(2, sizeof *tables);
    if (!tables) {
        fprintf(stderr, "clrt-bench: no memory for the tables\n");
        return;
    }
    printf("%s, driver %s, %u threads; ", setting->device, setting->driver, setting->threads);
    if (options->embree)
        printf("Embree %s, %s quality; ", embree_version(), options->high ? "high" : "medium");
    printf("%u rounds.\n", options->rounds);
    printf("Rates in millions of rays a second, medians: over processor time divided by the threads, but\n"
           "those under \"wall\". Differ: hit or miss, another primitive at another t, largest |dt|/t;\n"
           "clrt wrong: by a search in double, of rays where they differ in any mode.\n"
           "!: below %d rays, not in the means.\n\n",
           RAYS_FEW);
    report_builds(scenes, count, options, &tables[0]);
    report_rates(scenes, count, options, &tables[1]);
    table_print(&tables[0], options->markdown);
    table_print(&tables[1], options->markdown);
    report_summary(scenes, count);
    free(tables);
}

void report_scaling(const SceneResult *scenes, u32 count)
{
    printf("triangles,build_seconds,layout_seconds,bytes_per_triangle,embree_build_seconds,"
           "embree_bytes_per_triangle");
    for (u32 k = 0; count > 0 && k < scenes[0].set_count; k++) {
        const char *name = ray_kind_name(scenes[0].sets[k].kind);
        printf(",%s_mrays,%s_mrays_wall,embree_%s_mrays", name, name, name);
    }
    printf("\n");
    for (u32 i = 0; i < count; i++) {
        const SceneResult *s = &scenes[i];
        // The robust scene, or where there is none, the other one.
        const int flag = s->embree_seconds[0] > 0 ? 0 : 1;
        printf("%llu,%.4f,%.4f,%.2f,%.4f,%.2f", (unsigned long long)s->primitives, s->build_seconds,
               s->layout_seconds, per_primitive((f64)s->bytes, s), s->embree_seconds[flag],
               per_primitive((f64)s->embree_bytes[flag], s));
        for (u32 k = 0; k < s->set_count; k++) {
            const SetResult *set = &s->sets[k];
            const Versus versus = versus_embree(set, flag == 0, METRIC_CPU);
            printf(",%.3f,%.3f,%.3f", set->contenders[0].medians[METRIC_CPU] / MILLION,
                   set->contenders[0].medians[METRIC_WALL] / MILLION,
                   versus.best ? set->contenders[versus.best].medians[METRIC_CPU] / MILLION : 0.0);
        }
        printf("\n");
    }
}
