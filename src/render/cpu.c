#include "cpu.h"

#include "base/parallel.h"

typedef struct job {
    hc_pixel       *pixels;
    const hc_stage *stage;
} job;

static hc_sight look(const hc_stage *stage, const hc_gaze *gaze, const hc_tracer *tracer)
{
    return hc_sight_along(&gaze->shape, stage->scene.relief.edge, HC_SIGHT_OF_EYE, tracer,
                          gaze->origin, gaze->direction);
}

static void draw_sample(hc_pixel *pixel, const hc_stage *stage, double x, double y, int row)
{
    hc_gaze   gaze;
    hc_sample sample;
    hc_stage_gaze(stage, &gaze, x, y);
    const hc_sight sight = look(stage, &gaze, gaze.tracer);
    hc_shade(&sample, stage, &gaze, &sight);
    if (stage->exact != NULL) {
        sample.exact = (float)look(stage, &gaze, stage->exact).distance;
    }
    hc_stage_add(pixel, stage, sample, gaze.direction, row);
}

static void draw_row(void *context, int row, int worker)
{
    const job *j = context;
    (void)worker;
    for (int x = 0; x < j->stage->width; x++) {
        hc_pixel *pixel = &j->pixels[(size_t)row * (size_t)j->stage->width + (size_t)x];
        for (int i = 0; i < j->stage->scene.camera.samples; i++) {
            double place[2];
            hc_eye_sample_place(&j->stage->eye, place, i);
            draw_sample(pixel, j->stage, x + place[0], row + place[1], row);
        }
    }
}

hc_result hc_cpu_draw(hc_pixel *pixels, const hc_stage *stage, hc_log *log)
{
    job j = { pixels, stage };
    return hc_parallel_for(stage->height, hc_threads_resolve(stage->options.threads), draw_row, &j,
                           stage->options.progress, log);
}
