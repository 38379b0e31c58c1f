/* From a scene to a picture. */
#include "cpu.h"
#include "gl/gl.h"

#include "base/clock.h"
#include "base/fail.h"

#include <stdlib.h>

static const char *name_of(const char *const *names, unsigned count, unsigned index)
{
    return index < count ? names[index] : NULL;
}

const char *hc_body_name(hc_body body)
{
    static const char *const names[] = { "plane", "cylinder", "sphere", "torus" };
    return name_of(names, 4, (unsigned)body);
}

const char *hc_edge_name(hc_edge edge)
{
    static const char *const names[] = { "wall", "discard", "clamp" };
    return name_of(names, 3, (unsigned)edge);
}

const char *hc_view_name(hc_view view)
{
    static const char *const names[] = { "shaded",      "height", "normal", "depth",    "steps",
                                         "unconverged", "missed", "error",  "crossings" };
    return name_of(names, 9, (unsigned)view);
}

static hc_result draw_by(hc_pixel *pixels, double *seconds, const hc_stage *stage, hc_log *log)
{
    if (stage->options.backend == HC_BACKEND_GL) {
        return hc_gl_draw(pixels, seconds, stage, log);
    }
    const double    start  = hc_clock_now();
    const hc_result result = hc_cpu_draw(pixels, stage, log);
    *seconds               = hc_clock_now() - start;
    return result;
}

static hc_result draw(hc_picture *picture, const hc_stage *stage, hc_log *log)
{
    const size_t count   = (size_t)picture->width * (size_t)picture->height;
    hc_pixel    *pixels  = calloc(count, sizeof *pixels);
    float       *scratch = malloc(count * sizeof *scratch);
    hc_result    result  = HC_OK;
    if (pixels == NULL || scratch == NULL) {
        result = hc_fail(log, HC_ERROR_MEMORY, "no memory for a picture of %d x %d pixels",
                         picture->width, picture->height);
    } else {
        result = draw_by(pixels, &picture->figures.seconds, stage, log);
    }
    if (result == HC_OK) {
        hc_pixels_finish(picture, stage, pixels, scratch);
    }
    free(scratch);
    free(pixels);
    return result;
}

hc_result hc_render(hc_picture *picture, const hc_scene *scene, const hc_render_options *options,
                    hc_log *log)
{
    hc_stage  stage;
    hc_result result = hc_stage_set(&stage, picture, scene, options, log);
    if (result == HC_OK) {
        result = draw(picture, &stage, log);
    }
    hc_stage_clear(&stage);
    return result;
}
