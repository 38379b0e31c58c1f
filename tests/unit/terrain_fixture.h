/* Small terrains and their pictures. */
#ifndef HC_TESTS_TERRAIN_FIXTURE_H
#define HC_TESTS_TERRAIN_FIXTURE_H

#include <heightcast/terrain.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDE = 64, HIGH = 36, PIXELS = WIDE * HIGH, SIDE = 33 };

typedef struct shot {
    float      rgb[PIXELS * 3], depth[PIXELS];
    hc_picture picture;
} shot;

static shot  first, second;
static float level_heights[SIDE * SIDE];
static float cliff[SIDE * SIDE]; /* high in the west */

static inline void fill_heights(void)
{
    for (int i = 0; i < SIDE * SIDE; i++) {
        level_heights[i] = 0.5F;
        cliff[i]         = i % SIDE < SIDE / 2 ? 1.0F : 0.0F;
    }
}

/* Ten units between samples, heights 100 .. 300. */
static inline hc_terrain_scene scene_of(const float *heights)
{
    return (hc_terrain_scene){
        .field   = { .heights = heights, .width = SIDE, .height = SIDE, .registration = HC_GRID },
        .spacing = { 10.0, 10.0 },
        .low     = 100.0,
        .high    = 300.0
    };
}

static inline hc_terrain *make(const hc_terrain_scene *scene, const hc_render_options *options)
{
    hc_log      log = { .text = "" };
    hc_terrain *terrain;
    if (hc_terrain_create(&terrain, scene, options, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    return terrain;
}

static inline void draw(shot *s, const hc_terrain *terrain, const hc_camera *camera)
{
    hc_log log       = { .text = "" };
    *s               = (shot){ .picture = { .width = WIDE, .height = HIGH } };
    s->picture.rgb   = s->rgb;
    s->picture.depth = s->depth;
    if (hc_terrain_draw(&s->picture, terrain, camera, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
}

static inline void draw_once(shot *s, const hc_terrain_scene *scene,
                             const hc_render_options *options, const hc_camera *camera)
{
    hc_terrain *terrain = make(scene, options);
    draw(s, terrain, camera);
    hc_terrain_destroy(terrain);
}

/* The place on z = `height` that the middle of a pixel shows, from straight above, north on top. */
static inline void place_below(double place[2], const hc_camera *camera, int pixel)
{
    const double unit = (double)camera->orthographic / WIDE;
    place[0]          = camera->eye[0] + (pixel % WIDE + 0.5 - 0.5 * WIDE) * unit;
    place[1]          = camera->eye[1] - (pixel / WIDE + 0.5 - 0.5 * HIGH) * unit;
}

static inline hc_camera from_above(float width)
{
    return (hc_camera){ .eye          = { 160.0, -160.0, 1000.0 },
                        .at           = { 160.0, -160.0, 0.0 },
                        .orthographic = width };
}

static inline void refuse(const hc_terrain_scene *scene, const hc_render_options *options,
                          const char *says)
{
    hc_log      log = { .text = "" };
    hc_terrain *terrain;
    assert_int_equal(hc_terrain_create(&terrain, scene, options, &log), HC_ERROR_ARGUMENT);
    assert_null(terrain);
    if (strstr(log.text, says) == NULL) {
        fail_msg("'%s' does not say '%s'", log.text, says);
    }
}

#endif
