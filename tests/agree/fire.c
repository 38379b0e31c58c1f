#include "rays.h"

#include "base/parallel.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- the judge ------------------------------------------------------------------------------ */

static double reference(const agree_scene *scene, const hc_ray *ray, double sign_of_lift,
                        hc_hit *hit)
{
    hc_reference_options options = scene->surface;
    options.rise *= sign_of_lift;
    options.reach *= sign_of_lift;
    return hc_reference_trace(hit, scene->field, &options, ray);
}

static void complain(agree_score *score, const agree_scene *scene, const hc_ray *ray, double value,
                     const char *what, double bound)
{
    if (score->complaint[0] != '\0') {
        return;
    }
    (void)snprintf(score->complaint, sizeof score->complaint,
                   "%s on %s, %s%s: %.17g %s %.17g; ray { { %a, %a, %a }, %a, { %a, %a, %a }, %a }",
                   scene->method, agree_describe(scene->kind, scene->field),
                   hc_surface_name(scene->surface.surface),
                   scene->surface.open_sides ? ", open" : "", value, what, bound,
                   (double)ray->origin[0], (double)ray->origin[1], (double)ray->origin[2],
                   (double)ray->tmin, (double)ray->direction[0], (double)ray->direction[1],
                   (double)ray->direction[2], (double)ray->tmax);
}

/* Heights of hits that are neither inside nor on a side are those of the surface there. */
static void judge_place(agree_score *score, const agree_scene *scene, const hc_ray *ray,
                        const hc_hit *hit)
{
    const double u = (double)hit->u;
    const double v = (double)hit->v;
    if (hit->flags != 0 || scene->surface.surface != HC_SURFACE_BILINEAR) {
        return;
    }
    /* Rounding of u and v to float, as far as it leads at the steepest, and of the height. */
    const double cells = fmax(fabs(u), 1.0) / hc_field_step_u(scene->field)
                         + fmax(fabs(v), 1.0) / hc_field_step_v(scene->field);
    const double bound = 0x1p-24 * (1.0 + cells) + scene->surface.rise + 2.0 * scene->surface.reach;
    const double error = fabs((double)hit->height - hc_field_surface(scene->field, u, v));
    if (fmax(fabs(u), fabs(v)) <= 1.0) { /* farther out floats cannot tell cells apart */
        score->off = fmax(score->off, error);
    }
    if (!(error <= bound)) {
        score->odd++;
        complain(score, scene, ray, error, "off the surface is more than", bound);
    }
}

static bool about(double a, double b, double slack)
{
    return a == b || fabs(a - b) <= slack + 0x1p-23 * fabs(a);
}

/* For rays that come in through an open side under the raised surface, which may come up from one
 * of the surfaces and not from another: what the reference says on the surface as it is, is right.
 * Something else is wrong only where the moved surfaces agree with that one, and where it is known
 * that the ray comes in under them: from above the lowered one it may touch any between. */
static bool excused_under(agree_score *score, const agree_scene *scene, const hc_ray *ray, double t,
                          double first, double last)
{
    agree_scene closed        = *scene;
    closed.surface.open_sides = false;
    hc_hit       hit;
    const double side = reference(&closed, ray, 1.0, &hit);
    if (!scene->surface.open_sides || side == INFINITY || hit.steps != 1) {
        return false;
    }
    const double slack = 0x1p-50 * fabs((double)ray->tmin);
    const double exact = reference(scene, ray, 0.0, &hit);
    if (about(exact, t, slack)) {
        return true;
    }
    const bool agreed  = about(exact, first, slack) && about(exact, last, slack);
    const bool between = reference(&closed, ray, -1.0, &hit) > side + slack && hit.steps > 1;
    const bool excused = !agreed || (between && t < INFINITY);
    score->undecided += excused ? 1 : 0;
    return excused;
}

static void judge_time(agree_score *score, const agree_scene *scene, const hc_ray *ray, double t)
{
    hc_hit       unused;
    const double first = reference(scene, ray, 1.0, &unused);
    const double last  = reference(scene, ray, -1.0, &unused);
    /* t is a sum of doubles as large as itself and tmin, whoever computes it. */
    const double least  = isfinite(ray->tmin) ? fabs((double)ray->tmin) : 0.0;
    const double before = first < INFINITY ? first - 0x1p-50 * (fabs(first) + least) : INFINITY;
    const double after  = last < INFINITY ? last + 0x1p-50 * (fabs(last) + least) : INFINITY;
    const bool   early  = !(t >= (double)(float)before);
    const bool late = !(t <= (double)(float)after || (t == INFINITY && after >= (double)ray->tmax));
    if ((early || late) && excused_under(score, scene, ray, t, first, last)) {
        return;
    }
    if (early) {
        score->early++;
        complain(score, scene, ray, t, "is earlier than on the raised surface,", first);
    }
    if (late) {
        score->lost++;
        complain(score, scene, ray, t, "is later than on the lowered surface,", last);
    }
}

static void judge_rest(agree_score *score, const agree_scene *scene, const hc_ray *ray,
                       const hc_hit *hit, bool found)
{
    score->fired++;
    score->found += found ? 1 : 0;
    if (found != (hit->t < INFINITY) || (found && !(hit->t >= ray->tmin && hit->t <= ray->tmax))) {
        score->odd++;
        complain(score, scene, ray, (double)hit->t, "does not suit what was returned, or tmin",
                 (double)ray->tmin);
    } else if (found) {
        judge_place(score, scene, ray, hit);
    }
}

void agree_judge(agree_score *score, const agree_scene *scene, const hc_ray *ray, const hc_hit *hit,
                 bool found)
{
    judge_time(score, scene, ray, (double)hit->t);
    judge_rest(score, scene, ray, hit, found);
}

void agree_expect_right(const agree_score *score)
{
    if (score->lost + score->early + score->odd > 0) {
        fail_msg("of %zu rays %zu lost, %zu early, %zu odd; %s", score->fired, score->lost,
                 score->early, score->odd, score->complaint);
    }
}

/* ---- fire ----------------------------------------------------------------------------------- */

enum { BUNDLE = 61 }; /* not a multiple of any vector's lanes */

typedef struct target {
    hc_tracer  *tracer;
    float      *ratios; /* that it borrows, or NULL */
    agree_scene scene;
} target;

typedef struct bundle {
    agree_rays set;
    int        count;
    uint64_t   random;
} bundle;

typedef struct battle {
    const agree_volley *volley;
    target              targets[AGREE_METHODS_MAX];
    bundle             *bundles;
    agree_score (*scores)[AGREE_METHODS_MAX]; /* of each worker */
} battle;

static float *bake_for(const hc_field *field, hc_trace_options *options, hc_cones cones)
{
    if (hc_trace_method_needs(options->method) != HC_NEEDS_CELL_RATIOS) {
        return NULL;
    }
    float *ratios = agree_bake(field, &(hc_cone_options){ .cones = cones });
    float *cells  = malloc(agree_count(field, cones) * sizeof *cells);
    assert_non_null(cells);
    hc_bake_cell_ratios(cells, ratios, field->width, field->height, cones, field->wrap);
    free(ratios);
    options->ratios = cells;
    options->cones  = cones;
    return cells;
}

static void make_target(target *made, const agree_volley *volley, hc_trace_method method)
{
    hc_trace_options options           = volley->options;
    hc_log           log               = { .text = "" };
    options.method                     = method;
    const hc_reference_options surface = { .surface    = options.surface,
                                           .open_sides = options.open_sides,
                                           .placement  = options.placement };
    *made                              = (target){ .tracer = NULL };
    made->scene                        = (agree_scene){ .field   = volley->field,
                                                        .kind    = volley->kind,
                                                        .method  = hc_trace_method_name(method),
                                                        .surface = surface };
    made->ratios                       = bake_for(volley->field, &options, volley->cones);
    if (hc_tracer_create(&made->tracer, volley->field, &options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    hc_tracer_tolerance(made->tracer, &made->scene.surface.rise, &made->scene.surface.reach);
}

/* But for counts of steps: among others a ray may go a part of its way with them. */
static void compare_alone(agree_score *score, const target *by, const hc_ray *ray,
                          const hc_hit *among, bool any)
{
    hc_hit     alone;
    const bool found = hc_trace_nearest(by->tracer, &alone, ray);
    if (memcmp(&alone, among, offsetof(hc_hit, steps)) != 0 || any != found
        || hc_trace_any(by->tracer, ray) != found) {
        score->odd++;
        complain(score, &by->scene, ray, (double)among->t,
                 "among many is not what the other functions say; alone", (double)alone.t);
    }
}

/* All ways to ask give the same. One ray of `alone` is asked for by itself, too. */
static void compare_ways(agree_score *score, const target *by, const hc_ray *rays,
                         const hc_hit *hits, int count, int alone)
{
    uint8_t any[BUNDLE];
    hc_trace_any_many(by->tracer, any, rays, (size_t)count);
    for (int i = 0; i < count; i++) {
        if ((any[i] != 0) != (hits[i].t < INFINITY)) {
            score->odd++;
            complain(score, &by->scene, &rays[i], (double)hits[i].t,
                     "is not what is said about any hit,", (double)any[i]);
        } else if (i % alone == 0) {
            compare_alone(score, by, &rays[i], &hits[i], any[i] != 0);
        }
    }
}

static void fire_at(agree_score *score, const target *by, const hc_ray *rays, const float *equal,
                    int count, int alone)
{
    hc_hit hits[BUNDLE];
    hc_trace_nearest_many(by->tracer, hits, rays, (size_t)count);
    compare_ways(score, by, rays, hits, count, alone);
    for (int i = 0; i < count; i++) {
        const bool found = hits[i].t < INFINITY;
        if (equal[i] == hits[i].t) { /* false for NAN */
            judge_rest(score, &by->scene, &rays[i], &hits[i], found);
        } else {
            agree_judge(score, &by->scene, &rays[i], &hits[i], found);
        }
    }
}

static void fire_bundle(void *context, int item, int worker)
{
    battle             *all    = context;
    const agree_volley *volley = all->volley;
    const bundle       *b      = &all->bundles[item];
    const agree_scene  *scene  = &all->targets[0].scene;
    const hc_placement *place  = &scene->surface.placement;
    uint64_t            random = b->random;
    hc_ray              rays[BUNDLE];
    float               equal[BUNDLE];
    for (int i = 0; i < b->count; i++) {
        hc_hit unused;
        rays[i] = agree_ray(volley->field, b->set, &random);
        if (place->scale_z != 0.0) {
            rays[i] = agree_place_ray(volley->field, place, &rays[i]);
        }
        equal[i] = volley->trust_equal ? (float)reference(scene, &rays[i], 0.0, &unused) : NAN;
    }
    for (int m = 0; m < volley->method_count; m++) {
        fire_at(&all->scores[worker][m], &all->targets[m], rays, equal, b->count,
                volley->alone > 1 ? volley->alone : 1);
    }
}

static int make_bundles(battle *all, uint64_t *random)
{
    const size_t count   = all->volley->count;
    const size_t per_set = (count + BUNDLE - 1) / BUNDLE;
    int          made    = 0;
    all->bundles         = malloc(per_set * RAYS_SETS * sizeof *all->bundles);
    assert_non_null(all->bundles);
    for (int set = 0; set < RAYS_SETS; set++) {
        for (size_t done = 0; done < count; done += BUNDLE) {
            const int left       = count - done < BUNDLE ? (int)(count - done) : BUNDLE;
            all->bundles[made++] = (bundle){ (agree_rays)set, left, agree_random(random) };
        }
    }
    return made;
}

static void add_score(agree_score *sum, const agree_score *more)
{
    sum->fired += more->fired;
    sum->found += more->found;
    sum->undecided += more->undecided;
    sum->lost += more->lost;
    sum->early += more->early;
    sum->odd += more->odd;
    sum->off = fmax(sum->off, more->off);
    if (sum->complaint[0] == '\0') {
        memcpy(sum->complaint, more->complaint, sizeof sum->complaint);
    }
}

void agree_fire(agree_score *scores, const agree_volley *volley, uint64_t *random)
{
    const int methods = volley->method_count;
    const int threads = hc_threads_resolve(volley->threads);
    battle    all     = { .volley = volley, .scores = calloc((size_t)threads, sizeof *all.scores) };
    assert_non_null(all.scores);
    assert_true(methods <= AGREE_METHODS_MAX);
    for (int m = 0; m < methods; m++) {
        make_target(&all.targets[m], volley, volley->methods[m]);
    }
    const int bundles = make_bundles(&all, random);
    assert_int_equal(
        hc_parallel_for(bundles, threads, fire_bundle, &all, (hc_progress){ NULL, NULL }, NULL),
        HC_OK);
    for (int i = 0; i < threads * methods; i++) {
        add_score(&scores[i % methods], &all.scores[i / methods][i % methods]);
    }
    for (int m = 0; m < methods; m++) {
        hc_tracer_destroy(all.targets[m].tracer);
        free(all.targets[m].ratios);
    }
    free(all.bundles);
    free(all.scores);
}
