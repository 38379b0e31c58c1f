#include "render_bench.h"

#include <heightcast/bake.h>

#include <stdlib.h>

enum { WIDTH = 480, HEIGHT = 270, BINARY = 5, MAPS = 6, PLANS_MAX = 64 };

/* ---- maps ------------------------------------------------------------------------------------ */

typedef struct map_recipe {
    const char *name;
    hc_cones    cones;
    hc_method   method;
    bool        cells;
} map_recipe;

static const map_recipe recipes[MAPS] = {
    { "brute", HC_CONES_L2, HC_METHOD_EXACT, false }, /* the same ratios */
    { "relaxed", HC_CONES_L2, HC_METHOD_FALLING_EDGE, false },
    { "quick-improved", HC_CONES_L2, HC_METHOD_QUICK_IMPROVED, false },
    { "quick-centre", HC_CONES_L2, HC_METHOD_QUICK_CENTRE, false },
    { "diamond", HC_CONES_L1, HC_METHOD_EXACT, true },
    { "quadrant", HC_CONES_QUAD, HC_METHOD_EXACT, true },
};

enum { BRUTE, RELAXED, QUICK_IMPROVED, QUICK_CENTRE, DIAMOND, QUADRANT, NONE };

typedef struct job {
    const hc_bench_render_options *options;
    const char                    *name; /* of the field */
    hc_field                       field;
    float                         *maps[MAPS];
    hc_picture                     picture;
    hc_log                        *log;
} job;

static hc_result bake(float **map, const map_recipe *recipe, const job *j)
{
    const hc_cone_options options = { .cones   = recipe->cones,
                                      .method  = recipe->method,
                                      .threads = j->options->plan.threads };
    return hc_bench_bake_ratios(map, &j->field, &options, recipe->cells, j->log);
}

/* ---- frames ---------------------------------------------------------------------------------- */

typedef struct plan {
    int             map; /* NONE */
    hc_trace_method method;
    int             steps, refinements; /* refinements 0: the method has none */
} plan;

static hc_scene scene_of(const job *j, const plan *p)
{
    hc_scene scene = { .relief = { .field  = j->field,
                                   .edge   = HC_EDGE_DISCARD,
                                   .aspect = 1.0F,
                                   .trace  = { .method      = p->method,
                                               .steps       = p->steps,
                                               .refinements = p->refinements } },
                       .light  = { .no_shadows = true } };
    if (p->map != NONE) {
        scene.relief.trace.ratios = j->maps[p->map];
        scene.relief.trace.cones  = recipes[p->map].cones;
    }
    return scene;
}

static const char *refine_word(int refinements)
{
    return refinements == -2   ? "none"
           : refinements == -1 ? "secant"
           : refinements > 0   ? "binary"
                               : "";
}

static void report(const job *j, const plan *p, double seconds, int runs)
{
    const hc_render_figures  *f    = &j->picture.figures; /* of the view that compares */
    const double              near = f->entered > 0 ? (double)f->entered : 1.0;
    const hc_bench_render_row row  = { .field        = j->name,
                                       .side         = j->field.width,
                                       .map          = p->map == NONE ? "" : recipes[p->map].name,
                                       .method       = hc_trace_method_name(p->method),
                                       .refine       = refine_word(p->refinements),
                                       .steps        = p->steps,
                                       .runs         = runs,
                                       .milliseconds = 1e3 * seconds,
                                       .mean_steps   = f->mean_steps,
                                       .mean_fetches = f->mean_fetches,
                                       .lost         = (double)f->lost / near,
                                       .made_up      = (double)f->made_up / near,
                                       .unconverged  = (double)f->unconverged / near };
    j->options->row_done(j->options->user, &row);
}

static hc_result draw(job *j, const plan *p, hc_view view)
{
    const hc_scene          scene   = scene_of(j, p);
    const hc_render_options options = { .view    = view,
                                        .backend = j->options->backend,
                                        .threads = j->options->plan.threads };
    return hc_bench_stopped(&j->options->plan) ? HC_ERROR_CANCELLED
                                               : hc_render(&j->picture, &scene, &options, j->log);
}

/* ---- all of them ----------------------------------------------------------------------------- */

/* The table of 2022: maps by steps by refinements. */
static int plan_table(plan *plans)
{
    static const int steps[]   = { 32, 200 };
    static const int refines[] = { -2, -1, BINARY };
    int              count     = 0;
    for (int s = 0; s < 2; s++) {
        for (int r = 0; r < 3; r++) {
            for (int map = BRUTE; map <= QUICK_CENTRE; map++) {
                plans[count++] = (plan){ map, map == RELAXED ? HC_TRACE_RELAXED : HC_TRACE_QUICK,
                                         steps[s], refines[r] };
            }
        }
    }
    return count;
}

static int plan_all(plan plans[PLANS_MAX])
{
    static const plan others[] = {
        { NONE, HC_TRACE_LINEAR, 32, 0 },        { NONE, HC_TRACE_RELIEF, 32, BINARY },
        { NONE, HC_TRACE_OCCLUSION, 32, 0 },     { BRUTE, HC_TRACE_CONE_FIXED, 10, 0 },
        { BRUTE, HC_TRACE_CONE_LOOP, 16, 0 },    { BRUTE, HC_TRACE_CONE_LOOP, 32, 0 },
        { BRUTE, HC_TRACE_CONE_LOOP, 64, 0 },    { BRUTE, HC_TRACE_CONE_LOOP, 128, 0 },
        { BRUTE, HC_TRACE_CONE_LOOP, 256, 0 },   { BRUTE, HC_TRACE_CONE_EXACT, 256, 0 },
        { BRUTE, HC_TRACE_ROBUST, 200, BINARY }, { NONE, HC_TRACE_QDM, 0, 0 },
        { NONE, HC_TRACE_MAXMIP, 0, 0 },         { DIAMOND, HC_TRACE_SAFE, 0, 0 },
        { QUADRANT, HC_TRACE_SAFE, 0, 0 },
    };
    int count = plan_table(plans);
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        plans[count++] = others[i];
    }
    return count;
}

/* Runs go round the plans, so that a busy moment of the machine does not fall on one of them. */
static hc_result measure_plans(job *j)
{
    plan      plans[PLANS_MAX];
    double    fastest[PLANS_MAX];
    const int count  = plan_all(plans);
    const int runs   = hc_bench_repeat(&j->options->plan);
    hc_result result = HC_OK;
    for (int run = 0; run < runs; run++) {
        for (int i = 0; i < count && result == HC_OK; i++) {
            result               = draw(j, &plans[i], HC_VIEW_SHADED);
            const double seconds = j->picture.figures.seconds;
            fastest[i]           = run == 0 || seconds < fastest[i] ? seconds : fastest[i];
        }
    }
    for (int i = 0; i < count && result == HC_OK; i++) {
        result = draw(j, &plans[i], HC_VIEW_MISSED);
        if (result == HC_OK) {
            report(j, &plans[i], fastest[i], runs);
        }
    }
    return result;
}

static hc_result measure_field(void *context, const char *name, const hc_field *field)
{
    job      *j      = context;
    hc_result result = HC_OK;
    j->name          = name;
    j->field         = *field;
    for (int i = 0; i < MAPS && result == HC_OK; i++) {
        result = bake(&j->maps[i], &recipes[i], j);
    }
    result = result == HC_OK ? measure_plans(j) : result;
    for (int i = 0; i < MAPS; i++) {
        free(j->maps[i]);
        j->maps[i] = NULL;
    }
    return result;
}

hc_result hc_bench_render(const hc_bench_render_options *options, hc_log *log)
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
