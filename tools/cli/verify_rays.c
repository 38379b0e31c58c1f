#include "verify_rays.h"

#include "options.h"
#include "ray_sets.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a hit of a published method may be off and still count as one. --help says the same. */
static const double published_rise  = 1.0 / 256.0;
static const double published_reach = 0.2;

/* How a method stands. */
typedef struct losses {
    uint64_t hits;
    uint64_t missed;     /* the lowered surface is hit, the method finds nothing  */
    uint64_t late;       /* it hits behind the lowered surface                    */
    uint64_t early;      /* it hits before the raised surface is hit              */
    uint64_t false_hits; /* it hits and the raised surface is not hit at all      */
    uint64_t unconverged;
    uint64_t wrong_in_set[HC_CLI_RAY_SETS];
    double   off; /* largest distance in height of a hit from the surface  */
    double   mean_steps;
    double   steps_99; /* 99 of 100 rays take no more */
} losses;

/* Where the raised and the lowered surface are hit, for one pair of rise and reach. */
typedef struct bounds {
    bool    known;
    double  rise, reach;
    double *first, *last;
} bounds;

typedef struct judge {
    hc_cli       *cli;
    hc_cli_scene *scene;
    size_t        count;
    hc_ray       *rays;
    hc_hit       *hits;
    uint32_t     *steps;
    bounds        bounds;
    char          broken[256]; /* who lost or made up what it never may */
} judge;

/* ---- the truth ------------------------------------------------------------------------------- */

/* Progress of one of two passes, or of none. */
typedef struct half_progress {
    hc_cli *cli;
    double  start;
} half_progress;

static bool report_half(void *user, double fraction)
{
    const half_progress *half  = user;
    const hc_progress    whole = hc_cli_progress(half->cli);
    return whole.report(whole.user, half->start + 0.5 * fraction);
}

static hc_result find_bounds(judge *j, double rise, double reach)
{
    bounds *b = &j->bounds;
    if (b->known && b->rise == rise && b->reach == reach) {
        return HC_OK;
    }
    *b =
        (bounds){ .known = true, .rise = rise, .reach = reach, .first = b->first, .last = b->last };
    hc_cli_phase(j->cli, "reference");
    for (int pass = 0; pass < 2; pass++) {
        const double               sign     = pass == 0 ? 1.0 : -1.0;
        half_progress              half     = { j->cli, 0.5 * pass };
        const hc_reference_options options  = { .surface    = j->cli->settings.rays.surface,
                                                .open_sides = j->cli->settings.rays.open_sides,
                                                .rise       = sign * rise,
                                                .reach      = sign * reach };
        const hc_progress          progress = { report_half, &half };
        double                    *times    = pass == 0 ? b->first : b->last;
        const hc_result            result =
            hc_reference_batch(NULL, times, &j->scene->field, &options, j->rays, j->count,
                               j->cli->settings.threads, progress, &j->cli->log);
        if (result != HC_OK) {
            return result;
        }
    }
    hc_cli_phase(j->cli, NULL);
    return HC_OK;
}

/* ---- the verdict ----------------------------------------------------------------------------- */

/* True if the method's hit of ray `i` is not the first. Its t is rounded to float, and rounding
 * keeps order: so are the bounds. */
static bool judge_hit(losses *l, const bounds *b, size_t i, float t)
{
    const float first = (float)b->first[i];
    const float last  = (float)b->last[i];
    if (t > last) {
        l->missed += isfinite(t) ? 0 : 1;
        l->late += isfinite(t) ? 1 : 0;
    } else if (t < first) {
        l->early += isfinite(first) ? 1 : 0;
        l->false_hits += isfinite(first) ? 0 : 1;
    }
    return t > last || t < first;
}

static int by_size(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a;
    const uint32_t y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

static void judge_steps(losses *l, judge *j)
{
    double sum = 0.0;
    for (size_t i = 0; i < j->count; i++) {
        j->steps[i] = j->hits[i].steps;
        sum += j->hits[i].steps;
    }
    qsort(j->steps, j->count, sizeof *j->steps, by_size);
    l->mean_steps = sum / (double)j->count;
    l->steps_99   = j->steps[(j->count * 99 + 99) / 100 - 1];
}

static losses judge_method(judge *j)
{
    const bool patches = j->cli->settings.rays.surface == HC_SURFACE_BILINEAR;
    losses     l       = { 0 };
    for (size_t i = 0; i < j->count; i++) {
        const hc_hit *hit = &j->hits[i];
        l.hits += isfinite(hit->t) ? 1 : 0;
        l.unconverged += (hit->flags & HC_HIT_UNCONVERGED) != 0;
        l.wrong_in_set[i % HC_CLI_RAY_SETS] += judge_hit(&l, &j->bounds, i, hit->t);
        if (patches && isfinite(hit->t) && (hit->flags & (HC_HIT_INSIDE | HC_HIT_SIDE)) == 0) {
            const double surface =
                hc_field_surface(&j->scene->field, (double)hit->u, (double)hit->v);
            l.off = fmax(l.off, fabs((double)hit->height - surface));
        }
    }
    judge_steps(&l, j);
    return l;
}

static uint64_t lost(const losses *l)
{
    return l->missed + l->late;
}

static uint64_t too_early(const losses *l)
{
    return l->early + l->false_hits;
}

/* ---- figures --------------------------------------------------------------------------------- */

static void show_method(judge *j, cJSON *list, hc_trace_method method, const losses *l)
{
    const bounds *b    = &j->bounds;
    cJSON        *item = cJSON_CreateObject();
    cJSON        *sets = cJSON_CreateObject();
    (void)cJSON_AddStringToObject(item, "method", hc_trace_method_name(method));
    (void)cJSON_AddNumberToObject(item, "rise", b->rise);
    (void)cJSON_AddNumberToObject(item, "reach", b->reach);
    (void)cJSON_AddNumberToObject(item, "hits", (double)l->hits);
    (void)cJSON_AddNumberToObject(item, "lost", (double)lost(l));
    (void)cJSON_AddNumberToObject(item, "missed", (double)l->missed);
    (void)cJSON_AddNumberToObject(item, "late", (double)l->late);
    (void)cJSON_AddNumberToObject(item, "too_early", (double)too_early(l));
    (void)cJSON_AddNumberToObject(item, "early", (double)l->early);
    (void)cJSON_AddNumberToObject(item, "false_hits", (double)l->false_hits);
    (void)cJSON_AddNumberToObject(item, "unconverged", (double)l->unconverged);
    (void)cJSON_AddNumberToObject(item, "height_error", l->off);
    (void)cJSON_AddNumberToObject(item, "mean_steps", l->mean_steps);
    (void)cJSON_AddNumberToObject(item, "steps_99", l->steps_99);
    for (int i = 0; i < HC_CLI_RAY_SETS; i++) {
        (void)cJSON_AddNumberToObject(sets, hc_cli_ray_set(i), (double)l->wrong_in_set[i]);
    }
    (void)cJSON_AddItemToObject(item, "wrong_in_set", sets);
    (void)cJSON_AddItemToArray(list, item);
    hc_cli_say(j->cli, "%-12s %9llu %9llu %9llu %11.2g %10.1f %8.0f\n",
               hc_trace_method_name(method), (unsigned long long)l->hits,
               (unsigned long long)lost(l), (unsigned long long)too_early(l), l->off, l->mean_steps,
               l->steps_99);
}

/* ---- methods --------------------------------------------------------------------------------- */

static bool promises(hc_trace_method method)
{
    return method == HC_TRACE_FAST || method == HC_TRACE_SAFE || method == HC_TRACE_MAXMIP;
}

static int trace_method(judge *j, hc_trace_method method, double *rise, double *reach)
{
    hc_tracer             *tracer  = NULL;
    hc_cli                *cli     = j->cli;
    const hc_trace_options options = hc_cli_scene_options(j->scene, cli, method);
    hc_cli_phase(cli, "build");
    hc_result result = hc_tracer_create(&tracer, &j->scene->field, &options, &cli->log);
    if (result == HC_OK) {
        hc_tracer_tolerance(tracer, rise, reach);
        hc_cli_phase(cli, "cast");
        result = hc_trace_batch(tracer, j->hits, j->rays, j->count, cli->settings.threads,
                                hc_cli_progress(cli), &cli->log);
    }
    hc_cli_phase(cli, NULL);
    hc_tracer_destroy(tracer);
    return result == HC_OK ? HC_CLI_DONE : hc_cli_fail_result(cli, result);
}

/* One more of those that broke their promise. */
static void note_broken(judge *j, hc_trace_method method, const losses *l)
{
    const size_t used = strlen(j->broken);
    (void)snprintf(j->broken + used, sizeof j->broken - used, "%s%s lost %llu, had %llu too early",
                   used > 0 ? "; " : "", hc_trace_method_name(method), (unsigned long long)lost(l),
                   (unsigned long long)too_early(l));
}

static int try_method(judge *j, cJSON *list, hc_trace_method method)
{
    double rise  = 0.0;
    double reach = 0.0;
    int    code  = hc_cli_scene_ratios(j->scene, j->cli, hc_trace_method_needs(method));
    if (code == HC_CLI_DONE) {
        code = trace_method(j, method, &rise, &reach);
    }
    if (code != HC_CLI_DONE) {
        return code;
    }
    if (!promises(method)) {
        rise  = published_rise;
        reach = published_reach;
    }
    const hc_result known = find_bounds(j, rise, reach);
    if (known != HC_OK) {
        return hc_cli_fail_result(j->cli, known);
    }
    const losses l = judge_method(j);
    show_method(j, list, method, &l);
    if (promises(method) && lost(&l) + too_early(&l) > 0) {
        note_broken(j, method, &l);
    }
    return HC_CLI_DONE;
}

/* The map has what it needs, and it knows the surface. */
static bool can_try(const judge *j, hc_trace_method method)
{
    const hc_trace_needs needs = hc_trace_method_needs(method);
    const bool           holds = !j->scene->is_map || hc_cli_scene_holds(j->scene, needs);
    return holds
           && (method <= HC_TRACE_QDM || j->cli->settings.rays.surface == HC_SURFACE_BILINEAR);
}

/* A broken promise is told at the end, so that the table is whole. */
static int try_methods(judge *j)
{
    const hc_cli_settings *settings = &j->cli->settings;
    const bool             chosen   = hc_cli_given(settings, "method");
    cJSON                 *list     = cJSON_AddArrayToObject(j->cli->json, "methods");
    hc_cli_say(j->cli, "\n%-12s %9s %9s %9s %11s %10s %8s\n", "method", "hits", "lost", "too early",
               "off height", "mean steps", "99 %");
    for (int i = 0; i < hc_trace_method_count(); i++) {
        const hc_trace_method method = (hc_trace_method)i;
        if ((chosen && settings->rays.method != i) || !can_try(j, method)) {
            continue;
        }
        const int code = try_method(j, list, method);
        if (code != HC_CLI_DONE) {
            return code;
        }
    }
    if (cJSON_GetArraySize(list) == 0) {
        return hc_cli_fail(
            j->cli, HC_CLI_BAD_FILE,
            "%s cannot be tried: %s has not the ratios that it needs, or it does not "
            "know the surface",
            hc_trace_method_name((hc_trace_method)settings->rays.method), settings->paths[0]);
    }
    if (j->broken[0] != '\0') {
        return hc_cli_fail(j->cli, HC_CLI_VERIFY_FAILED,
                           "first hits that must neither be lost nor be too early: %s", j->broken);
    }
    return HC_CLI_DONE;
}

static bool take_memory(judge *j)
{
    j->rays         = malloc(j->count * sizeof *j->rays);
    j->hits         = malloc(j->count * sizeof *j->hits);
    j->steps        = malloc(j->count * sizeof *j->steps);
    j->bounds.first = malloc(j->count * sizeof *j->bounds.first);
    j->bounds.last  = malloc(j->count * sizeof *j->bounds.last);
    return j->rays != NULL && j->hits != NULL && j->steps != NULL && j->bounds.first != NULL
           && j->bounds.last != NULL;
}

int hc_cli_verify_rays(hc_cli *cli, hc_cli_scene *scene)
{
    judge j    = { .cli = cli, .scene = scene, .count = (size_t)cli->settings.rays.count };
    int   code = HC_CLI_DONE;
    if (take_memory(&j)) {
        hc_cli_number(cli, "rays", (double)j.count, NULL);
        hc_cli_number(cli, "seed", (double)cli->settings.seed, NULL);
        hc_cli_make_rays(j.rays, j.count, &scene->field, cli->settings.seed);
        code = try_methods(&j);
    } else {
        code = hc_cli_fail_memory(cli);
    }
    free(j.bounds.last);
    free(j.bounds.first);
    free(j.steps);
    free(j.hits);
    free(j.rays);
    return code;
}
