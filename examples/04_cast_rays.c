/* Rays at a field in memory: where a picking ray hits first, whether the sun shines there, and the
 * shadows of a whole row at once. libheightcast only; no map is baked, the tracer needs none.
 *
 * The field stands in the world: samples 10 m apart, x to the right, y against the rows, z the
 * elevation from 0 to 300 m. */
#include <heightcast/heightcast.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 128, ROW = 64 };

static const float sun[3] = { -0.8F, 0.3F, 0.35F };

/* A ray from a hit towards the sun, that starts a little above the surface: the hit itself lies in
 * the solid as often as not. */
static hc_ray to_sun(const hc_tracer *tracer, const hc_ray *ray, const hc_hit *hit)
{
    hc_ray shadow = { .tmin = 0.0F, .tmax = INFINITY };
    float  normal[3];
    hc_trace_normals(tracer, normal, NULL, hit);
    for (int i = 0; i < 3; i++) {
        shadow.origin[i]    = ray->origin[i] + hit->t * ray->direction[i] + 0.1F * normal[i];
        shadow.direction[i] = sun[i];
    }
    return shadow;
}

int main(void)
{
    static float           heights[SIDE * SIDE];
    const hc_field         field   = { .heights = heights, .width = SIDE, .height = SIDE };
    const hc_trace_options options = {
        .placement = { .spacing_x = 10.0, .spacing_y = -10.0, .scale_z = 300.0 }
    };
    hc_log     log    = { 0 };
    hc_tracer *tracer = NULL;
    hc_result  result = hc_synth(heights, SIDE, SIDE, "fbm", 5, &log);
    if (result == HC_OK) {
        result = hc_tracer_create(&tracer, &field, &options, &log);
    }
    if (result != HC_OK) {
        (void)fprintf(stderr, "%s: %s\n", hc_result_name(result), log.text);
        return EXIT_FAILURE;
    }

    const hc_ray pick = { { -100.0F, -640.0F, 400.0F }, 0.0F, { 1.0F, 0.1F, -0.4F }, INFINITY };
    hc_hit       hit;
    if (hc_trace_nearest(tracer, &hit, &pick)) {
        const hc_ray shadow = to_sun(tracer, &pick, &hit);
        (void)printf("hit after t = %.2f at x = %.1f m, %s\n", (double)hit.t,
                     (double)(pick.origin[0] + hit.t * pick.direction[0]),
                     hc_trace_any(tracer, &shadow) ? "in the shadow" : "in the sun");
    }

    hc_ray  rays[ROW];
    hc_hit  hits[ROW];
    uint8_t dark[ROW];
    for (int i = 0; i < ROW; i++) {
        rays[i] = (hc_ray){ .origin    = { (float)(i * 20), -640.0F, 400.0F },
                            .direction = { 0.0F, 0.0F, -1.0F },
                            .tmax      = INFINITY };
    }
    hc_trace_nearest_many(tracer, hits, rays, ROW);
    for (int i = 0; i < ROW; i++) {
        rays[i] = to_sun(tracer, &rays[i], &hits[i]);
    }
    hc_trace_any_many(tracer, dark, rays, ROW);
    for (int i = 0; i < ROW; i++) {
        (void)putchar(dark[i] ? '#' : '.');
    }
    (void)putchar('\n');
    hc_tracer_destroy(tracer);
    return EXIT_SUCCESS;
}
