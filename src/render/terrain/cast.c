/* Rows of rays through the tracer, and what they see. Rays go to it many at a time, as the fast
 * caster follows them. */
#include "terrain.h"

#include "../stage.h"
#include "../vec.h"

#include "base/fail.h"
#include "base/parallel.h"

#include <stdlib.h>

enum { PIECE = 4096 }; /* rays at a time */

/* Of one thread. */
typedef struct scratch {
    hc_ray    *rays;
    hc_hit    *hits, *exact, *to_sun_hits; /* NULL where they are not needed */
    hc_glance *glances;
    hc_ray    *to_sun;
    uint8_t   *dark;
} scratch;

/* Rays of a row of pixels, from `first`. */
typedef struct piece {
    int row, first, count;
} piece;

typedef struct job {
    hc_pixel         *pixels;
    const hc_terrain *terrain;
    const hc_eye     *eye;
    double            footprint; /* of a pixel at distance 1 */
    scratch          *scratches;
} job;

/* ---- rays ---------------------------------------------------------------------------------- */

static void aim(hc_ray *rays, const job *j, piece p)
{
    for (int i = 0; i < p.count; i++) {
        const int column = (p.first + i) / j->eye->samples;
        double    place[2], origin[3], direction[3];
        hc_eye_sample_place(j->eye, place, (p.first + i) % j->eye->samples);
        hc_eye_ray(j->eye, origin, direction, column + place[0], p.row + place[1]);
        rays[i].tmin = 0.0F;
        rays[i].tmax = INFINITY;
        for (int k = 0; k < 3; k++) {
            rays[i].origin[k]    = (float)origin[k];
            rays[i].direction[k] = (float)direction[k];
        }
    }
}

/* Detail by detail: what the ground hides lies in its layer, and may see the sun. Steps that come
 * to nothing hide nothing. */
static void ask_details(const scratch *s, const hc_terrain *terrain, int count)
{
    const hc_detail_method method = terrain->scene.detail_method;
    hc_trace_nearest_many(terrain->tracer, s->to_sun_hits, s->to_sun, (size_t)count);
    for (int i = 0; i < count; i++) {
        hc_hit *hit = &s->to_sun_hits[i];
        (void)hc_details_dig(hit, terrain, terrain->tracer, &s->to_sun[i], method,
                             s->glances[i].left);
        const bool lost = method == HC_DETAIL_STEPS && (hit->flags & HC_HIT_UNCONVERGED) != 0;
        s->dark[i]      = hit->t < INFINITY && !lost ? 1 : 0;
    }
}

static void cast_to_sun(const scratch *s, const job *j, int count)
{
    const hc_terrain *terrain = j->terrain;
    for (int i = 0; i < count; i++) {
        s->to_sun[i] = hc_terrain_sun_ray(terrain, &s->glances[i]);
    }
    if (terrain->details.count > 0) {
        ask_details(s, terrain, count);
    } else {
        hc_trace_any_many(terrain->tracer, s->dark, s->to_sun, (size_t)count);
    }
    for (int i = 0; i < count; i++) {
        if (s->to_sun[i].tmin > s->to_sun[i].tmax) {
            s->dark[i] = 1; /* it faces away, though rough ground may face the sun here and there */
        } else if (s->dark[i] == 0 && terrain->bodies != NULL) {
            s->dark[i] = hc_terrain_body_shades(terrain, &s->glances[i]) ? 1 : 0;
        }
    }
}

/* The field has no end below, its picture does. */
static void cut_below(hc_hit *hits, int count)
{
    for (int i = 0; i < count; i++) {
        if ((hits[i].flags & HC_HIT_SIDE) != 0 && (double)hits[i].height < -HC_TERRAIN_BASE) {
            hits[i].t = INFINITY;
        }
    }
}

static void dig_exact(const scratch *s, const hc_terrain *terrain, int count)
{
    for (int i = 0; i < count && terrain->details.count > 0; i++) {
        (void)hc_details_dig(&s->exact[i], terrain, terrain->exact, &s->rays[i], HC_DETAIL_SAFE,
                             HC_BY_DISTANCE);
    }
}

static void cast(const scratch *s, const job *j, int count)
{
    const hc_terrain *terrain = j->terrain;
    hc_trace_nearest_many(terrain->tracer, s->hits, s->rays, (size_t)count);
    cut_below(s->hits, count);
    for (int i = 0; i < count; i++) {
        s->glances[i] = (hc_glance){ s->rays[i], s->hits[i], { .t = INFINITY }, 0.0 };
        hc_terrain_dig(&s->glances[i], terrain);
        if (terrain->bodies != NULL) {
            hc_terrain_find_body(&s->glances[i], terrain);
        }
    }
    if (terrain->exact != NULL) {
        hc_trace_nearest_many(terrain->exact, s->exact, s->rays, (size_t)count);
        cut_below(s->exact, count);
        dig_exact(s, terrain, count);
    }
}

/* ---- pixels -------------------------------------------------------------------------------- */

void hc_terrain_add(hc_pixel *pixel, const hc_terrain *terrain, const hc_eye *eye,
                    const hc_sample *sample, const double direction[3])
{
    const float slack = terrain->exact != NULL ? (float)terrain->slack : -1.0F;
    hc_pixel_add(pixel, sample, hc_dot(direction, eye->forward), slack);
}

static void add(const scratch *s, const job *j, piece p)
{
    const hc_terrain *terrain = j->terrain;
    hc_pixel         *pixels  = &j->pixels[(size_t)p.row * (size_t)j->eye->width];
    for (int i = 0; i < p.count; i++) {
        const hc_glance *glance = &s->glances[i];
        double           direction[3];
        hc_sample        sample;
        for (int k = 0; k < 3; k++) {
            direction[k] = (double)glance->ray.direction[k];
        }
        const double lit =
            terrain->sunview.side > 0 ? hc_terrain_map_light(terrain, glance) : 1.0 - s->dark[i];
        hc_terrain_see(&sample, terrain, glance, j->footprint, lit);
        if (terrain->exact != NULL) {
            sample.exact = fminf(s->exact[i].t, (float)glance->body.t);
        }
        hc_terrain_add(&pixels[(p.first + i) / j->eye->samples], terrain, j->eye, &sample,
                       direction);
    }
}

static void draw_piece(const scratch *s, const job *j, piece p)
{
    aim(s->rays, j, p);
    cast(s, j, p.count);
    if (!j->terrain->scene.no_shadows && j->terrain->sunview.side == 0) {
        cast_to_sun(s, j, p.count);
    }
    add(s, j, p);
}

static void draw_row(void *context, int row, int worker)
{
    const job *j     = context;
    const int  count = j->eye->width * j->eye->samples;
    for (int first = 0; first < count; first += PIECE) {
        const int   rest = count - first;
        const piece p    = { row, first, rest < PIECE ? rest : PIECE };
        draw_piece(&j->scratches[worker], j, p);
    }
}

/* ---- memory -------------------------------------------------------------------------------- */

static bool take(scratch *s, bool exact, bool details)
{
    s->to_sun_hits = details ? malloc(PIECE * sizeof *s->to_sun_hits) : NULL;
    s->rays        = malloc(PIECE * sizeof *s->rays);
    s->hits        = malloc(PIECE * sizeof *s->hits);
    s->exact       = exact ? malloc(PIECE * sizeof *s->exact) : NULL;
    s->glances     = malloc(PIECE * sizeof *s->glances);
    s->to_sun      = malloc(PIECE * sizeof *s->to_sun);
    s->dark        = calloc(PIECE, sizeof *s->dark);
    return s->rays != NULL && s->hits != NULL && (s->exact != NULL || !exact)
           && (s->to_sun_hits != NULL || !details) && s->glances != NULL && s->to_sun != NULL
           && s->dark != NULL;
}

static void release(scratch *s)
{
    free(s->rays);
    free(s->hits);
    free(s->exact);
    free(s->to_sun_hits);
    free(s->glances);
    free(s->to_sun);
    free(s->dark);
}

double hc_terrain_footprint(const hc_eye *eye)
{
    return eye->parallel ? 0.0 : 2.0 * sqrt(hc_dot(eye->right, eye->right)) / eye->width;
}

hc_result hc_terrain_cast(hc_pixel *pixels, const hc_terrain *terrain, const hc_eye *eye,
                          hc_log *log)
{
    const int threads = hc_threads_resolve(terrain->options.threads);
    scratch  *all     = calloc((size_t)threads, sizeof *all);
    job       j       = { .pixels    = pixels,
                          .terrain   = terrain,
                          .eye       = eye,
                          .footprint = hc_terrain_footprint(eye),
                          .scratches = all };
    bool      enough  = all != NULL;
    for (int i = 0; enough && i < threads; i++) {
        enough = take(&all[i], terrain->exact != NULL, terrain->details.count > 0);
    }
    const hc_result result =
        enough ? hc_parallel_for(eye->height, threads, draw_row, &j, terrain->options.progress, log)
               : hc_fail(log, HC_ERROR_MEMORY, "no memory for the rays of %d threads", threads);
    for (int i = 0; all != NULL && i < threads; i++) {
        release(&all[i]);
    }
    free(all);
    return result;
}
