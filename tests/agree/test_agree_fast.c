/* The fast caster against the reference walk: no first hit lost, none made up, whatever the field,
 * the ray, the instruction set or the company a ray keeps. */
#include <heightcast/trace.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RAYS = 165, SIDE_MAX = 97 };

static uint64_t state = 1;

static double even(void) /* 0 .. 1 */
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (double)(state >> 11) * 0x1p-53;
}

static int below(int n)
{
    return (int)(even() * n);
}

static void aim(hc_ray *ray, const double from[3], const double to[3])
{
    for (int k = 0; k < 3; k++) {
        ray->origin[k]    = (float)from[k];
        ray->direction[k] = (float)(to[k] - from[k]);
    }
    ray->tmin = 0.0F;
    ray->tmax = INFINITY;
}

static double sample_u(const hc_field *field, int i)
{
    return (i + (field->registration == HC_GRID ? 0.0 : 0.5)) * hc_field_step_u(field);
}

static double sample_v(const hc_field *field, int j)
{
    return (j + (field->registration == HC_GRID ? 0.0 : 0.5)) * hc_field_step_v(field);
}

/* The kinds of rays that break casters. */
static hc_ray make_ray(const hc_field *field, int kind)
{
    const int    i    = below(field->width);
    const int    j    = below(field->height);
    const double top  = (double)field->heights[(size_t)j * (size_t)field->width + (size_t)i];
    const double u    = sample_u(field, i);
    const double v    = sample_v(field, j);
    double       a[3] = { even() * 1.4 - 0.2, even() * 1.4 - 0.2, even() * 1.3 };
    double       b[3] = { even(), even(), even() * 0.9 };
    hc_ray       ray  = { .tmin = 0.0F };
    const double far  = field->wrap == HC_WRAP_NONE ? 1e5 : 100.0; /* within its periods */
    switch (kind) {
    case 0: break;                                               /* anywhere */
    case 1: memcpy(b, (double[]){ u, v, top }, sizeof b); break; /* at a sample */
    case 2: a[2] = b[2] = top; break; /* level, as high as a sample: grazing */
    case 3: a[1] = b[1] = v; break;   /* along a grid line */
    case 4: a[0] = b[0] = u; break;
    case 5:
        memcpy(a, (double[]){ u, v, 1.5 }, sizeof a); /* vertical on a sample */
        memcpy(b, (double[]){ u, v, 0.0 }, sizeof b);
        break;
    case 6:
        a[2] = 1.2;
        b[0] = a[0];
        b[1] = a[1];
        break; /* vertical */
    case 7:
        for (int k = 0; k < 3; k++) {
            a[k] = b[k] + far * (a[k] - b[k]);
        }
        break;                                                          /* from far */
    case 8: memcpy(a, (double[]){ u, v, top + 1e-4 }, sizeof a); break; /* off the ground */
    case 9:
        a[0] = u;
        a[1] = v;
        b[0] = u + (v - 0.5);
        b[1] = v + (v - 0.5);
        a[2] = b[2] = top;
        break;                          /* diagonal, along vertices */
    default: a[2] = b[2] + 0.02; break; /* shallow */
    }
    aim(&ray, a, b);
    if (kind % 3 == 0 && below(4) == 0) {
        ray.tmax = (float)(even() * 2.0);
        ray.tmin = (float)(even() * 0.5);
    }
    if (field->wrap != HC_WRAP_NONE) { /* well within the periods that are followed */
        const float run = fmaxf(fabsf(ray.direction[0]), fabsf(ray.direction[1]));
        ray.tmax        = fminf(ray.tmax, 200.0F / run);
    }
    return ray;
}

static double reference(const hc_field *field, const hc_trace_options *options, const hc_ray *ray,
                        double rise, double reach)
{
    hc_hit                     hit;
    const hc_reference_options judge = {
        .surface = options->surface, .open_sides = options->open_sides, .rise = rise, .reach = reach
    };
    return hc_reference_trace(&hit, field, &judge, ray);
}

static void show(const hc_field *field, const hc_trace_options *options, const hc_ray *ray,
                 double early, double t, double late)
{
    print_error("%d x %d wrap %d registration %d surface %d open %d: t %.9g not in %.17g .. %.17g\n"
                "origin %.9g %.9g %.9g direction %.9g %.9g %.9g t %.9g .. %.9g\n",
                field->width, field->height, (int)field->wrap, (int)field->registration,
                (int)options->surface, options->open_sides, t, early, late, (double)ray->origin[0],
                (double)ray->origin[1], (double)ray->origin[2], (double)ray->direction[0],
                (double)ray->direction[1], (double)ray->direction[2], (double)ray->tmin,
                (double)ray->tmax);
}

static int judge(const hc_field *field, const hc_trace_options *options, const hc_tracer *tracer,
                 const hc_ray *rays, const hc_hit *hits)
{
    double rise;
    double reach;
    int    wrong = 0;
    hc_tracer_tolerance(tracer, &rise, &reach);
    for (int i = 0; i < RAYS; i++) {
        const double t     = (double)hits[i].t;
        const double early = reference(field, options, &rays[i], rise, reach);
        const double late  = reference(field, options, &rays[i], -rise, -reach);
        const double ulp   = isfinite(t) ? fabs(t) * 0x1p-23 : 0.0;
        double       first = early;
        double       last  = late;
        if (options->open_sides) {
            /* Under a higher surface a ray through an open side comes out later, and may hit less:
             * the order of the three is not known. */
            const double exact = reference(field, options, &rays[i], 0.0, 0.0);
            first              = fmin(fmin(early, late), exact);
            last               = fmax(fmax(early, late), exact);
        }
        if (!(first - ulp <= t && t <= last + ulp)) {
            show(field, options, &rays[i], first, t, last);
            wrong++;
        }
    }
    return wrong;
}

/* The same hit, but for counts of steps. */
static bool same(const hc_hit *a, const hc_hit *b)
{
    return memcmp(a, b, offsetof(hc_hit, steps)) == 0;
}

static int check(const hc_field *field, const hc_trace_options *options)
{
    static hc_ray rays[RAYS];
    static hc_hit hits[RAYS];
    static hc_hit others[RAYS];
    uint8_t       any[RAYS];
    hc_tracer    *tracer;
    hc_log        log   = { 0 };
    int           wrong = 0;
    for (int i = 0; i < RAYS; i++) {
        /* Through open sides rays that touch the ground from below are out of it or not by a hair,
         * and no bracket of surfaces orders that: rays made to touch are left to closed sides. */
        const int  kind    = i % 11;
        const bool touches = (kind >= 1 && kind <= 5) || kind == 9;
        rays[i]            = make_ray(field, options->open_sides && touches ? 0 : kind);
    }
    for (int isa = HC_ISA_SCALAR; isa <= (int)HC_ISA_AVX512; isa++) {
        hc_trace_options with = *options;
        with.isa              = (hc_isa)isa;
        assert_int_equal(hc_tracer_create(&tracer, field, &with, &log), HC_OK);
        hc_trace_nearest_many(tracer, isa == HC_ISA_SCALAR ? hits : others, rays, RAYS);
        hc_trace_any_many(tracer, any, rays, RAYS);
        for (int i = 0; i < RAYS; i++) {
            hc_hit one;
            wrong += isa != HC_ISA_SCALAR && !same(&hits[i], &others[i]);
            wrong += any[i] != (hits[i].t < INFINITY);
            wrong += hc_trace_nearest(tracer, &one, &rays[i]) != (hits[i].t < INFINITY);
            wrong += !same(&one, &hits[i]);
            wrong += hc_trace_any(tracer, &rays[i]) != (any[i] != 0);
        }
        if (isa == HC_ISA_SCALAR) {
            wrong += judge(field, options, tracer, rays, hits);
        }
        hc_tracer_destroy(tracer);
    }
    return wrong;
}

static const int sizes[][2] = { { 1, 1 }, { 1, 9 },   { 7, 1 },        { 2, 2 },
                                { 5, 3 }, { 33, 17 }, { SIDE_MAX, 61 } };

static int check_kind(const char *kind, hc_surface surface)
{
    static float heights[SIDE_MAX * SIDE_MAX];
    int          wrong = 0;
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        hc_field field = { .heights = heights, .width = sizes[s][0], .height = sizes[s][1] };
        assert_int_equal(hc_synth(heights, field.width, field.height, kind, 3, NULL), HC_OK);
        for (int variant = 0; variant < 8; variant++) {
            const hc_trace_options options = { .surface = surface, .open_sides = below(2) == 0 };
            field.wrap                     = (hc_wrap)(variant / 2);
            field.registration             = (hc_registration)(variant % 2);
            wrong += check(&field, &options);
        }
    }
    return wrong;
}

static void test_patches(void **unused)
{
    (void)unused;
    for (int i = 0; i < hc_synth_count(); i++) {
        assert_int_equal(check_kind(hc_synth_name(i), HC_SURFACE_BILINEAR), 0);
    }
}

static void test_steps(void **unused)
{
    (void)unused;
    for (int i = 0; i < hc_synth_count(); i++) {
        assert_int_equal(check_kind(hc_synth_name(i), HC_SURFACE_STEPS), 0);
    }
}

static void test_bad_rays_miss(void **unused)
{
    (void)unused;
    static const float height = 0.5F;
    const hc_field     field  = { .heights = &height, .width = 1, .height = 1 };
    const float        bad[]  = { NAN, INFINITY, -INFINITY };
    hc_tracer         *tracer;
    hc_hit             hit;
    assert_int_equal(hc_tracer_create(&tracer, &field, NULL, NULL), HC_OK);
    const hc_ray good = { .origin    = { 0.5F, 0.5F, 1.0F },
                          .direction = { 0.0F, 0.0F, -1.0F },
                          .tmax      = INFINITY };
    assert_true(hc_trace_nearest(tracer, &hit, &good));
    assert_true(hit.t == 0.5F);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 7; k++) {
            hc_ray ray = good;
            if (k == 6) {
                ray.tmin = bad[i];
            } else {
                *(k < 3 ? &ray.origin[k] : &ray.direction[k - 3]) = bad[i];
            }
            assert_false(hc_trace_nearest(tracer, &hit, &ray));
            assert_true(isinf(hit.t));
        }
    }
    hc_ray none       = good;
    none.direction[2] = 0.0F;
    assert_false(hc_trace_any(tracer, &none));
    hc_ray backwards = good;
    backwards.tmax   = -1.0F;
    assert_false(hc_trace_any(tracer, &backwards));
    hc_tracer_destroy(tracer);
}

/* Towers narrow cones: a walk that falls back to cells takes one step for each. */
static void test_steps_grow_slowly(void **unused)
{
    (void)unused;
    double mean[2];
    for (int k = 0; k < 2; k++) {
        const int side    = 128 << (2 * k);
        float    *heights = malloc((size_t)side * (size_t)side * sizeof *heights);
        assert_non_null(heights);
        assert_int_equal(hc_synth(heights, side, side, "fbm", 1, NULL), HC_OK);
        const hc_field field = { .heights = heights, .width = side, .height = side };
        hc_tracer     *tracer;
        double         steps = 0.0;
        assert_int_equal(hc_tracer_create(&tracer, &field, NULL, NULL), HC_OK);
        for (int i = 0; i < 4000; i++) {
            hc_hit       hit;
            const hc_ray ray = make_ray(&field, 0);
            (void)hc_trace_nearest(tracer, &hit, &ray);
            steps += hit.steps;
        }
        mean[k] = steps / 4000.0;
        hc_tracer_destroy(tracer);
        free(heights);
    }
    assert_true(mean[1] <= mean[0] * 9.0 / 7.0 + 2.0); /* log2 of the side: 7 and 9 */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_patches),
        cmocka_unit_test(test_steps),
        cmocka_unit_test(test_bad_rays_miss),
        cmocka_unit_test(test_steps_grow_slowly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
