/* A cone baker that stays: it remembers, for squares of samples, how high a change must be to
 * matter to them, and searches only tiles that a change may matter to. */
#include "base/fail.h"
#include "base/parallel.h"
#include "reach.h"

#include <stdlib.h>

enum {
    GROUP       = 64, /* side of the squares whose reach is kept [samples] */
    GROUP_TILES = GROUP / HC_TILE_SIDE
};

struct hc_cone_baker {
    hc_cone_job   job; /* without heights and ratios, which belong to the caller */
    hc_exact_plan plan;
    int           group_columns, group_rows;
    hc_reach     *reaches; /* a group and pass */
};

typedef struct update {
    hc_cone_baker *baker;
    float         *ratios;
    hc_rect        changed;
    hc_change      changes[HC_CHANGES_MAX];
    int            change_count;
    int           *tiles; /* indices of tiles to search, row-major */
    int            tile_count;
    size_t         sample_count; /* in these tiles */
    bool          *group_touched;
} update;

static int tile_columns(const hc_cone_baker *baker)
{
    return (baker->job.width + HC_TILE_SIDE - 1) / HC_TILE_SIDE;
}

/* The part of a square that lies inside the field. */
static hc_rect square(const hc_cone_baker *baker, int x, int y, int side)
{
    hc_rect rect = { x * side, y * side, side, side };
    if (rect.x + side > baker->job.width) {
        rect.width = baker->job.width - rect.x;
    }
    if (rect.y + side > baker->job.height) {
        rect.height = baker->job.height - rect.y;
    }
    return rect;
}

static hc_reach *group_reaches(const hc_cone_baker *baker, int group)
{
    return baker->reaches + (size_t)group * (size_t)baker->plan.count;
}

/* ---- creating ---- */

typedef struct measuring {
    const hc_cone_baker *baker;
    const float         *ratios;
    const bool          *wanted; /* NULL: all groups */
} measuring;

static void measure_group(void *context, int group, int worker)
{
    (void)worker;
    const measuring     *m     = context;
    const hc_cone_baker *baker = m->baker;
    if (m->wanted == NULL || m->wanted[group]) {
        hc_reach_of(
            group_reaches(baker, group), &baker->plan, m->ratios, baker->plan.max_ratio,
            square(baker, group % baker->group_columns, group / baker->group_columns, GROUP));
    }
}

static void measure_groups(const hc_cone_baker *baker, const float *ratios, const bool *wanted)
{
    measuring m = { .baker = baker, .ratios = ratios, .wanted = wanted };
    (void)hc_parallel_for(baker->group_columns * baker->group_rows, baker->job.threads,
                          measure_group, &m, (hc_progress){ 0 }, NULL);
}

static hc_result prepare(hc_cone_baker *baker, float *ratios, const hc_field *field,
                         float max_ratio, hc_log *log)
{
    hc_result result = hc_exact_plan_init(&baker->plan, &baker->job);
    if (result != HC_OK) {
        return result;
    }
    baker->plan.max_ratio = max_ratio;
    baker->group_columns  = (field->width + GROUP - 1) / GROUP;
    baker->group_rows     = (field->height + GROUP - 1) / GROUP;
    baker->reaches        = calloc((size_t)baker->group_columns * (size_t)baker->group_rows,
                                   (size_t)baker->plan.count * sizeof *baker->reaches);
    if (baker->reaches == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for a baker of %d x %d samples",
                       field->width, field->height);
    }
    result = hc_exact_plan_run(&baker->plan, &baker->job);
    if (result == HC_OK) {
        measure_groups(baker, ratios, NULL);
    }
    return result;
}

hc_result hc_cone_baker_create(hc_cone_baker **baker, float *ratios, const hc_field *field,
                               const hc_cone_options *options, hc_log *log)
{
    *baker                      = NULL;
    const hc_cone_options given = options == NULL ? (hc_cone_options){ 0 } : *options;
    if (given.method != HC_METHOD_EXACT) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "options.method is %s; a baker that stays needs exact",
                       hc_method_name(given.method));
    }
    hc_cone_baker *made = calloc(1, sizeof *made);
    if (made == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for a baker");
    }
    hc_result result = hc_cone_job_init(&made->job, ratios, field, &given, log);
    if (result == HC_OK) {
        result = prepare(made, ratios, field, given.max_ratio, log);
    }
    if (result != HC_OK) {
        hc_cone_baker_destroy(made);
        return result;
    }
    made->job.ratios  = NULL;
    made->job.heights = NULL;
    made->job.log     = NULL;
    *baker            = made;
    return HC_OK;
}

void hc_cone_baker_destroy(hc_cone_baker *baker)
{
    if (baker != NULL) {
        hc_exact_plan_finish(&baker->plan);
        free(baker->reaches);
        free(baker);
    }
}

/* ---- updating ---- */

static float height_before(const void *owner, int x, int y)
{
    const hc_cone_baker *baker = owner;
    return hc_tree_node(&baker->plan.tree.levels[0], x / 4, y / 4)[y % 4 * 4 + x % 4];
}

static bool any_included(const update *u, const hc_reach *reaches, hc_rect rect)
{
    const hc_exact_plan *plan = &u->baker->plan;
    for (int pass = 0; pass < plan->count; pass++) {
        for (int i = 0; i < u->change_count; i++) {
            if (hc_reach_includes(&reaches[pass], &plan->passes[pass], rect, &u->changes[i])) {
                return true;
            }
        }
    }
    return false;
}

static bool overlaps(hc_rect a, hc_rect b)
{
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height
           && b.y < a.y + a.height;
}

static void choose_tiles_of(update *u, int group_x, int group_y)
{
    const hc_cone_baker *baker = u->baker;
    const int            rows  = (baker->job.height + HC_TILE_SIDE - 1) / HC_TILE_SIDE;
    for (int y = group_y * GROUP_TILES; y < (group_y + 1) * GROUP_TILES && y < rows; y++) {
        for (int x = group_x * GROUP_TILES;
             x < (group_x + 1) * GROUP_TILES && x < tile_columns(baker); x++) {
            const hc_rect rect = square(baker, x, y, HC_TILE_SIDE);
            hc_reach      reaches[HC_ANISO_COUNT];
            hc_reach_of(reaches, &baker->plan, u->ratios, baker->plan.max_ratio, rect);
            if (overlaps(rect, u->changed) || any_included(u, reaches, rect)) {
                u->tiles[u->tile_count++] = y * tile_columns(baker) + x;
                u->sample_count += (size_t)rect.width * (size_t)rect.height;
                u->group_touched[group_y * baker->group_columns + group_x] = true;
            }
        }
    }
}

/* Reaches still tell of the old heights, as they must: ratios do, too. */
static void choose_tiles(update *u)
{
    const hc_cone_baker *baker = u->baker;
    for (int y = 0; y < baker->group_rows; y++) {
        for (int x = 0; x < baker->group_columns; x++) {
            const hc_rect rect = square(baker, x, y, GROUP);
            if (overlaps(rect, u->changed)
                || any_included(u, group_reaches(baker, y * baker->group_columns + x), rect)) {
                choose_tiles_of(u, x, y);
            }
        }
    }
}

static void search_chosen(void *context, int item, int worker)
{
    const update *u       = context;
    const int     columns = tile_columns(u->baker);
    hc_exact_search_tile(&u->baker->plan, u->ratios, u->tiles[item] % columns,
                         u->tiles[item] / columns, worker);
}

static hc_result apply(update *u, const float *heights, hc_log *log)
{
    hc_cone_baker *baker = u->baker;
    u->change_count =
        hc_find_changes(u->changes, heights, baker->job.width, u->changed, height_before, baker);
    if (u->change_count == 0) {
        return HC_OK;
    }
    choose_tiles(u);
    hc_exact_plan_forget(&baker->plan);
    if (!hc_tree_update(&baker->plan.tree, heights, u->changed)) {
        hc_tree_free(&baker->plan.tree);
        const hc_result built = hc_tree_build(&baker->plan.tree, heights, baker->job.width,
                                              baker->job.height, baker->job.threads, log);
        if (built != HC_OK) {
            return built;
        }
    }
    const hc_result searched = hc_parallel_for(u->tile_count, baker->job.threads, search_chosen, u,
                                               baker->job.progress, log);
    if (searched == HC_OK) {
        measure_groups(baker, u->ratios, u->group_touched);
    }
    return searched;
}

hc_result hc_cone_baker_update(hc_cone_baker *baker, float *ratios, const float *heights,
                               hc_rect changed, size_t *rebaked, hc_log *log)
{
    hc_result result = hc_check_change(heights, baker->job.width, baker->job.height, changed, log);
    if (result != HC_OK) {
        return result;
    }
    const size_t rows   = (size_t)((baker->job.height + HC_TILE_SIDE - 1) / HC_TILE_SIDE);
    const size_t groups = (size_t)baker->group_columns * (size_t)baker->group_rows;
    update       u      = { .baker = baker, .ratios = ratios, .changed = changed };
    u.tiles             = malloc((size_t)tile_columns(baker) * rows * sizeof *u.tiles);
    u.group_touched     = calloc(groups, sizeof *u.group_touched);
    result              = u.tiles == NULL || u.group_touched == NULL
                              ? hc_fail(log, HC_ERROR_MEMORY, "no memory to update %zu tiles", rows)
                              : apply(&u, heights, log);
    if (rebaked != NULL) {
        *rebaked = u.sample_count;
    }
    free(u.tiles);
    free(u.group_touched);
    return result;
}
