#include "terrain_bench.h"

#include <heightcast/bake.h>

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WIDTH = 480, HEIGHT = 270, FRAMES = 5, TOURS = 2 };

static const double LIMIT = 60.0;

/* In the order of hc_polygons, but none. */
static const char *const polygon_names[2] = { "mesh", "lod" };

static const hc_tour tours[TOURS] = { HC_TOUR_FLY, HC_TOUR_WALK };

typedef struct job {
    const hc_bench_terrain_options *options;
    const char                     *name; /* of the field */
    hc_field                        field;
    hc_trace_method                 method;
    hc_polygons                     polygons;
    hc_cones                        cones;
    float                          *ratios;
    hc_picture                      picture;
    double                          start; /* of what the limit is for */
    hc_log                         *log;
} job;

const char *hc_bench_terrain_method(int index)
{
    const int methods = hc_trace_method_count();
    return index < methods       ? hc_trace_method_name((hc_trace_method)index)
           : index < methods + 2 ? polygon_names[index - methods]
                                 : NULL;
}

static double now(void)
{
    struct timespec time;
    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* ---- the limit ------------------------------------------------------------------------------- */

static bool is_over(const job *j)
{
    const double limit = j->options->limit > 0.0 ? j->options->limit : LIMIT;
    return now() - j->start > limit;
}

static bool go_on(void *user, double fraction)
{
    const job *j = user;
    (void)fraction;
    return !is_over(j) && !hc_bench_stopped(&j->options->plan);
}

/* What ends a method and not the whole measurement. */
static bool is_its_own(hc_result result, const job *j)
{
    return (result == HC_ERROR_CANCELLED && !hc_bench_stopped(&j->options->plan))
           || result == HC_ERROR_MEMORY || result == HC_ERROR_LIMIT;
}

/* ---- getting ready --------------------------------------------------------------------------- */

static size_t ratio_count(const job *j)
{
    return hc_trace_method_needs(j->method) == HC_NEEDS_NOTHING
               ? 0
               : (size_t)j->field.width * (size_t)j->field.height
                     * (size_t)hc_cones_channels(j->cones);
}

static hc_result bake(job *j)
{
    const hc_trace_needs needs    = hc_trace_method_needs(j->method);
    const bool           cells    = needs == HC_NEEDS_CELL_RATIOS;
    const bool           relaxed  = needs == HC_NEEDS_RELAXED;
    j->cones                      = cells ? HC_CONES_QUAD : HC_CONES_L2;
    const hc_cone_options options = { .cones   = j->cones,
                                      .method  = relaxed ? HC_METHOD_FALLING_EDGE : HC_METHOD_EXACT,
                                      .threads = j->options->plan.threads,
                                      .progress = { .report = go_on, .user = j } };
    if (needs == HC_NEEDS_NOTHING) {
        return HC_OK;
    }
    const hc_result result = hc_bench_bake_ratios(&j->ratios, &j->field, &options, cells, j->log);
    /* Other threads may do all of it before the one that reports is asked. */
    return result == HC_OK && is_over(j) ? HC_ERROR_CANCELLED : result;
}

static hc_trace_options trace_of(const job *j)
{
    return (hc_trace_options){ .method  = j->method,
                               .ratios  = j->ratios,
                               .cones   = j->cones,
                               .threads = j->options->plan.threads };
}

static hc_result make(hc_terrain **terrain, const job *j, hc_view view)
{
    const hc_terrain_scene scene = {
        .field = j->field, .trace = trace_of(j), .polygons = j->polygons, .no_shadows = true
    };
    const hc_render_options options = { .view    = view,
                                        .backend = j->options->backend,
                                        .threads = j->options->plan.threads };
    return hc_terrain_create(terrain, &scene, &options, j->log);
}

/* ---- frames ---------------------------------------------------------------------------------- */

/* What the frames of a tour came to. */
typedef struct sums {
    int    frames;
    double seconds, entered, crossings, lost, made_up;
} sums;

static hc_result draw_frame(sums *all, job *j, const hc_terrain *terrain, hc_tour tour, int frame)
{
    const hc_render_figures *f = &j->picture.figures;
    hc_camera                camera;
    hc_terrain_tour(&camera, terrain, tour, (double)frame / FRAMES);
    const hc_result result = hc_bench_stopped(&j->options->plan)
                                 ? HC_ERROR_CANCELLED
                                 : hc_terrain_draw(&j->picture, terrain, &camera, j->log);
    if (result == HC_OK) {
        all->frames++;
        all->seconds += f->seconds;
        all->entered += (double)f->entered;
        all->crossings += f->mean_crossings * (double)f->entered;
        all->lost += (double)f->lost;
        all->made_up += (double)f->made_up;
    }
    return result;
}

/* Frames of all tours in turn, so that a busy moment of the machine does not fall on one of
 * them. */
static hc_result draw_tours(sums all[TOURS], job *j, const hc_terrain *terrain, bool once)
{
    memset(all, 0, TOURS * sizeof *all);
    for (int i = 0; i < FRAMES * TOURS; i++) {
        const bool first = once && i < TOURS;
        if (!first && is_over(j)) {
            break;
        }
        const hc_result result =
            draw_frame(&all[i % TOURS], j, terrain, tours[i % TOURS], i / TOURS);
        if (result != HC_OK) {
            return result;
        }
    }
    return HC_OK;
}

static hc_result time_tours(hc_bench_tour *found[TOURS], job *j, const hc_terrain *terrain,
                            int runs)
{
    for (int run = 0; run < runs; run++) {
        sums            all[TOURS];
        const hc_result result = draw_tours(all, j, terrain, run == 0);
        if (result != HC_OK) {
            return result;
        }
        for (int i = 0; i < TOURS; i++) {
            const double rate = all[i].frames / all[i].seconds;
            if (run > 0 && all[i].frames < FRAMES) {
                return HC_OK;
            }
            if (run == 0 || rate > found[i]->frames_per_second) {
                found[i]->frames_per_second = rate;
            }
            found[i]->frames = all[i].frames;
            found[i]->mean_crossings =
                all[i].entered > 0.0 ? all[i].crossings / all[i].entered : 0.0;
        }
    }
    return HC_OK;
}

static hc_result judge_tours(hc_bench_tour *found[TOURS], job *j)
{
    sums        all[TOURS];
    hc_terrain *terrain = NULL;
    hc_result   result  = make(&terrain, j, HC_VIEW_MISSED);
    j->start            = now();
    result              = result == HC_OK ? draw_tours(all, j, terrain, true) : result;
    for (int i = 0; i < TOURS && result == HC_OK; i++) {
        const double rays = all[i].entered > 0.0 ? all[i].entered : 1.0;
        found[i]->judged  = all[i].frames;
        found[i]->lost    = all[i].lost / rays;
        found[i]->made_up = all[i].made_up / rays;
    }
    hc_terrain_destroy(terrain);
    return result;
}

/* ---- all of them ----------------------------------------------------------------------------- */

/* Polygons are drawn from the heights; what says how, a 100th of them, does not count. */
static double bytes_held(const job *j)
{
    const hc_trace_options trace   = trace_of(j);
    const size_t           samples = (size_t)j->field.width * (size_t)j->field.height;
    const double           tracer  = (double)hc_tracer_bytes(&j->field, &trace);
    return (double)(sizeof(float) * (samples + ratio_count(j)))
           + (j->polygons == HC_POLYGONS_NONE ? tracer : 0.0);
}

static hc_result measure_ready(hc_bench_terrain_row *row, job *j)
{
    hc_bench_tour *found[TOURS] = { &row->fly, &row->walk };
    hc_terrain    *terrain      = NULL;
    j->start                    = now();
    hc_result result            = bake(j);
    result                      = result == HC_OK ? make(&terrain, j, HC_VIEW_SHADED) : result;
    row->seconds                = now() - j->start;
    if (result == HC_OK) {
        row->bytes = bytes_held(j);
        result     = time_tours(found, j, terrain, row->runs);
    }
    hc_terrain_destroy(terrain);
    return result == HC_OK ? judge_tours(found, j) : result;
}

static void choose_method(job *j, const char *name)
{
    const int methods = hc_trace_method_count();
    int       index   = 0;
    while (strcmp(hc_bench_terrain_method(index), name) != 0) {
        index++;
    }
    j->method = index < methods ? (hc_trace_method)index : HC_TRACE_MAXMIP;
    j->polygons =
        index < methods ? HC_POLYGONS_NONE : (hc_polygons)(HC_POLYGONS_FULL + index - methods);
}

static hc_result measure_method(job *j, const char *name)
{
    hc_bench_terrain_row row = { .field  = j->name,
                                 .side   = j->field.width,
                                 .method = name,
                                 .runs   = hc_bench_repeat(&j->options->plan) };
    choose_method(j, name);
    hc_result result = measure_ready(&row, j);
    free(j->ratios);
    j->ratios = NULL;
    if (is_its_own(result, j)) {
        row.stopped = result;
        result      = HC_OK;
    }
    if (result == HC_OK) {
        j->options->row_done(j->options->user, &row);
    }
    return result;
}

static hc_result measure_field(void *context, const char *name, const hc_field *field)
{
    static const char *const usual[] = { "fast",      "maxmip", "pdm",  "safe",
                                         "cone-loop", "qdm",    "mesh", "lod" };
    /* Polygons are GL's. */
    job                 *j      = context;
    const hc_bench_plan *plan   = &j->options->plan;
    const bool           all    = plan->method_count == 0;
    const char *const   *names  = all ? usual : plan->methods;
    const int            own    = j->options->backend == HC_BACKEND_GL ? 8 : 6;
    const int            count  = all ? own : plan->method_count;
    hc_result            result = HC_OK;
    j->name                     = name;
    j->field                    = *field;
    for (int i = 0; i < count && result == HC_OK; i++) {
        result = measure_method(j, names[i]);
    }
    return result;
}

hc_result hc_bench_terrain(const hc_bench_terrain_options *options, hc_log *log)
{
    const bool sized = options->width > 0;
    job        j     = { .options = options,
                         .log     = log,
                         .picture = { .width  = sized ? options->width : WIDTH,
                                      .height = sized ? options->height : HEIGHT } };
    j.picture.rgb = malloc((size_t)j.picture.width * (size_t)j.picture.height * 3 * sizeof(float));
    const hc_result result = j.picture.rgb == NULL
                                 ? HC_ERROR_MEMORY
                                 : hc_bench_each_field(&options->plan, measure_field, &j, log);
    free(j.picture.rgb);
    return result;
}
