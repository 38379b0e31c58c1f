/* Details: rays against a surface that is computed by its definition, on fields that are hard; what
 * steps lose; where they are, their colours and how they fade; what is refused. */
#include "terrain_fixture.h"

#include "render/terrain/quartic.h"
#include "render/terrain/terrain.h"

enum { MAP = 24, TEXELS = MAP * MAP, SAMPLES = SIDE * SIDE };

static float   hills[SAMPLES], maps[HC_DETAILS_MAX][TEXELS], colours[TEXELS * 3];
static float   planes[HC_DETAILS_MAX][SAMPLES]; /* the mask's */
static uint8_t mask[SAMPLES * 4];

static const char *const names[HC_DETAILS_MAX] = { "spikes", "noise", "ridge", "cobbles" };

static int prepare(void **state)
{
    (void)state;
    fill_heights();
    bool     good = hc_synth(hills, SIDE, SIDE, "fbm", 5, NULL) == HC_OK;
    uint32_t seed = 1;
    for (int i = 0; i < HC_DETAILS_MAX; i++) {
        good = good && hc_synth(maps[i], MAP, MAP, names[i], 3, NULL) == HC_OK;
    }
    for (int i = 0; i < SAMPLES * 4; i++) {
        seed    = seed * 1664525U + 1013904223U;
        mask[i] = seed >> 31 != 0 ? 0 : (uint8_t)(seed >> 22);

        planes[i % 4][i / 4] = (float)mask[i] / 255.0F;
    }
    return good ? 0 : -1;
}

/* Spacing 10, heights 100 .. 300; texels of two to a third of a unit. */
static hc_terrain_scene detailed(hc_detail details[HC_DETAILS_MAX], const float *heights)
{
    hc_terrain_scene scene = scene_of(heights);
    for (int i = 0; i < HC_DETAILS_MAX; i++) {
        details[i] = (hc_detail){ .heights = maps[i],
                                  .width   = MAP,
                                  .height  = MAP,
                                  .tile    = MAP * 2.0 / (1 + 2 * i),
                                  .depth   = 3.0 + i };
    }
    scene.details        = details;
    scene.detail_count   = HC_DETAILS_MAX;
    scene.mask           = mask;
    scene.mask_width     = SIDE;
    scene.mask_height    = SIDE;
    scene.detail_fade[1] = 1e9;
    scene.detail_fade[0] = 1e8;
    return scene;
}

/* ---- the surface, by its definition ---------------------------------------------------------- */

static bool has_tops(const hc_terrain_scene *scene)
{
    return scene->trace.surface == HC_SURFACE_STEPS || scene->trace.method == HC_TRACE_QDM;
}

/* Of samples: between them, or of the nearest one. */
static double plane_at(const float *samples, double x, double y, bool nearest)
{
    const double   side  = 10.0 * (SIDE - 1);
    const hc_field plane = {
        .heights = samples, .width = SIDE, .height = SIDE, .registration = HC_GRID
    };
    const double u = nearest ? 10.0 * floor(x / 10.0 + 0.5) : x;
    const double v = nearest ? 10.0 * floor(-y / 10.0 + 0.5) : -y;
    return hc_field_surface(&plane, u / side, v / side);
}

static double ground_at(const hc_terrain_scene *scene, double x, double y)
{
    return 100.0 + 200.0 * plane_at(scene->field.heights, x, y, has_tops(scene));
}

/* How far details lie under the ground at a place, all of them in full. */
static double cut_at(const hc_terrain_scene *scene, const hc_detail *details, double x, double y)
{
    double sum = 0.0;
    for (int i = 0; i < HC_DETAILS_MAX; i++) {
        const hc_field map = {
            .heights = maps[i], .width = MAP, .height = MAP, .wrap = HC_WRAP_UV
        };
        const double low = 1.0 - hc_field_surface(&map, x / details[i].tile, -y / details[i].tile);
        sum += plane_at(planes[i], x, y, has_tops(scene)) * details[i].depth * low;
    }
    return sum;
}

static double uniform(uint32_t *seed)
{
    *seed = *seed * 1664525U + 1013904223U;
    return (double)(*seed >> 8) / 16777216.0;
}

/* From above, from the sides and along the ground, to places near it. */
static hc_ray random_ray(uint32_t *seed)
{
    const double rises[3] = { 300.0, 30.0, 1.0 };
    const double rise     = rises[(int)(uniform(seed) * 3.0)];
    const double from[3]  = { 400.0 * uniform(seed) - 40.0, 40.0 - 400.0 * uniform(seed), 0.0 };
    const double to[3]    = { 320.0 * uniform(seed), -320.0 * uniform(seed), 0.0 };
    hc_ray       ray      = { .tmax = INFINITY };
    double       length   = 0.0, along[3];
    for (int k = 0; k < 3; k++) {
        along[k] = to[k] - from[k] - (k == 2 ? rise : 0.0);
        length += along[k] * along[k];
    }
    const hc_terrain_scene scene = scene_of(hills);
    const double z = 100.0 + 200.0 * hc_field_surface(&scene.field, to[0] / 320.0, -to[1] / 320.0);
    for (int k = 0; k < 3; k++) {
        ray.origin[k]    = (float)(k == 2 ? z + rise : from[k]);
        ray.direction[k] = (float)(along[k] / sqrt(length));
    }
    return ray;
}

#define OUTSIDE INFINITY

/* Over the ground, or OUTSIDE. */
static double place_at(double at[3], const hc_terrain_scene *scene, const hc_ray *ray, double t)
{
    for (int k = 0; k < 3; k++) {
        at[k] = (double)ray->origin[k] + t * (double)ray->direction[k];
    }
    const bool over = at[0] >= 0.0 && at[0] <= 320.0 && at[1] <= 0.0 && at[1] >= -320.0;
    return over ? at[2] - ground_at(scene, at[0], at[1]) : OUTSIDE;
}

static double gap_at(const hc_terrain_scene *scene, const hc_detail *details, const hc_ray *ray,
                     double t)
{
    double       at[3];
    const double above = place_at(at, scene, ray, t);
    return above < OUTSIDE ? above + cut_at(scene, details, at[0], at[1]) : OUTSIDE;
}

/* The first of many steps under the surface by more than `tolerance`; INFINITY: none. Under open
 * sides rays are to have been above it before. */
static double first_below(const hc_terrain_scene *scene, const hc_detail *details,
                          const hc_ray *ray, double until, double tolerance)
{
    enum { STEPS = 6000 };
    const double end   = fmax(fmin(until, 700.0), 0.0);
    bool         ready = !scene->trace.open_sides;
    for (int i = 0; i < STEPS && end > 0.0; i++) {
        const double t = end * i / STEPS;
        double       at[3];
        double       gap = place_at(at, scene, ray, t);
        gap += gap <= tolerance ? cut_at(scene, details, at[0], at[1]) : 0.0; /* else clear */
        if (gap < -tolerance && ready) {
            return t;
        }
        ready = ready || (gap > tolerance && gap < OUTSIDE);
    }
    return INFINITY;
}

/* ---- roots ----------------------------------------------------------------------------------- */

static void first_roots(void **state)
{
    (void)state;
    const double touches[HC_QUARTIC]  = { 0.25, -1.0, 1.0, 0.0, 0.0 }; /* (x - 1/2)^2 */
    const double above[HC_QUARTIC]    = { 0.2500001, -1.0, 1.0, 0.0, 0.0 };
    const double below[HC_QUARTIC]    = { -1e-9, 1.0, 0.0, 0.0, 0.0 };
    const double constant[HC_QUARTIC] = { 1e-9, 0.0, 0.0, 0.0, 0.0 };
    assert_true(fabs(hc_quartic_first(touches, 1.0) - 0.5) < 1e-3);
    assert_true(hc_quartic_first(above, 1.0) == INFINITY);
    assert_true(hc_quartic_first(below, 1.0) == 0.0);
    assert_true(hc_quartic_first(constant, 0.0) == INFINITY);
    assert_true(hc_quartic_first(touches, 0.25) == INFINITY);
}

/* (x - a) (x - b) (x - c) (x - d), roots on both sides of and in 0 .. length. */
static void roots_of_products(void **state)
{
    uint32_t seed = 9;
    (void)state;
    for (int i = 0; i < 20000; i++) {
        const double length        = 0.01 + 10.0 * uniform(&seed);
        double       c[HC_QUARTIC] = { 1.0, 0.0, 0.0, 0.0, 0.0 };
        double       least = INFINITY, before = 1.0;
        for (int k = 0; k < 4; k++) {
            const double root = length * (3.0 * uniform(&seed) - 1.0);
            least             = root >= 0.0 ? fmin(least, root) : least;
            before            = root >= 0.0 ? -before : before;
            for (int j = 4; j > 0; j--) {
                c[j] = c[j - 1] - root * c[j];
            }
            c[0] *= -root;
        }
        for (int k = 0; k < HC_QUARTIC; k++) {
            c[k] *= before; /* above 0 at 0 */
        }
        const double found = hc_quartic_first(c, length);
        if (least <= length) {
            assert_true(fabs(found - least) <= 1e-5 * length);
        } else {
            assert_true(found == INFINITY);
        }
    }
}

/* ---- rays ------------------------------------------------------------------------------------ */

enum { RAYS = 500 };

/* Heights are float: so is t, and on a slope of 16 it moves z by 16 times its rounding. */
static const double TOLERANCE = 4e-3;
static const double NEAR      = 1e-3; /* before and behind a face */

typedef struct tally {
    int hits, missed, made_up, unconverged;
    int below; /* come in through a side, under the ground */
} tally;

static bool comes_in_below(const hc_terrain_scene *scene, const hc_ray *ray)
{
    double t = 0.0, at[3];
    for (int k = 0; k < 2; k++) {
        const double side = (ray->direction[k] > 0.0F) == (k == 0) ? 0.0 : k == 0 ? 320.0 : -320.0;
        t                 = fmax(t, (side - (double)ray->origin[k]) / (double)ray->direction[k]);
    }
    for (int k = 0; k < 3; k++) {
        at[k] = (double)ray->origin[k] + t * (double)ray->direction[k];
    }
    const bool passes = at[0] >= -0.01 && at[0] <= 320.01 && at[1] <= 0.01 && at[1] >= -320.01;
    return t > 0.0 && passes && at[2] < ground_at(scene, at[0], at[1]);
}

static tally cast(const hc_terrain_scene *scene, const hc_detail *details)
{
    hc_terrain *terrain = make(scene, NULL);
    uint32_t    seed    = 77;
    tally       sum     = { 0 };
    for (int i = 0; i < RAYS; i++) {
        const hc_ray ray = random_ray(&seed);
        hc_hit       hit;
        (void)hc_trace_nearest(terrain->tracer, &hit, &ray);
        (void)hc_details_dig(&hit, terrain, terrain->tracer, &ray, scene->detail_method, 1.0);
        const bool   met   = hit.t < INFINITY;
        const bool   wall  = (hit.flags & (HC_HIT_SIDE | HC_HIT_INSIDE)) != 0;
        const double gap   = met ? gap_at(scene, details, &ray, (double)hit.t) : 0.0;
        const double until = (double)hit.t - NEAR;
        const bool   faced = wall && gap_at(scene, details, &ray, (double)hit.t + NEAR) > TOLERANCE;
        const bool   lost  = first_below(scene, details, &ray, until, TOLERANCE) < INFINITY;
        sum.hits += met ? 1 : 0;
        sum.missed += lost ? 1 : 0;
        sum.made_up += met && !lost && (wall ? faced : fabs(gap) > TOLERANCE) ? 1 : 0;
        sum.below += comes_in_below(scene, &ray) ? 1 : 0;
        sum.unconverged += (hit.flags & HC_HIT_UNCONVERGED) != 0 ? 1 : 0;
    }
    hc_terrain_destroy(terrain);
    return sum;
}

static void safe_loses_nothing(void **state)
{
    static const struct kind {
        const float    *heights;
        hc_trace_method method;
        hc_surface      surface;
        bool            open_sides;
    } kinds[] = { { hills, HC_TRACE_FAST, HC_SURFACE_BILINEAR, false },
                  { cliff, HC_TRACE_MAXMIP, HC_SURFACE_BILINEAR, false },
                  { hills, HC_TRACE_FAST, HC_SURFACE_STEPS, false },
                  { hills, HC_TRACE_QDM, HC_SURFACE_BILINEAR, false },
                  { hills, HC_TRACE_FAST, HC_SURFACE_BILINEAR, true },
                  { hills, HC_TRACE_MAXMIP, HC_SURFACE_STEPS, true },
                  { cliff, HC_TRACE_MAXMIP, HC_SURFACE_BILINEAR, true } };
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        hc_detail        details[HC_DETAILS_MAX];
        hc_terrain_scene scene = detailed(details, kinds[i].heights);
        scene.trace.method     = kinds[i].method;
        scene.trace.surface    = kinds[i].surface;
        scene.trace.open_sides = kinds[i].open_sides;
        const tally sum        = cast(&scene, details);
        assert_true(sum.hits > RAYS / 4);
        assert_true(sum.below > RAYS / 20);
        assert_int_equal(sum.missed, 0);
        assert_int_equal(sum.made_up, 0);
        assert_int_equal(sum.unconverged, 0);
    }
}

/* More steps lose less, and no number of them nothing. */
static void steps_lose_some(void **state)
{
    const int steps[] = { 4, 32, 256 };
    int       before  = RAYS;
    (void)state;
    for (int i = 0; i < 3; i++) {
        hc_detail        details[HC_DETAILS_MAX];
        hc_terrain_scene scene = detailed(details, hills);
        scene.detail_method    = HC_DETAIL_STEPS;
        scene.detail_steps     = steps[i];
        const tally sum        = cast(&scene, details);
        print_message("%d steps: %d of %d rays miss the first hit, %d hit in the air\n", steps[i],
                      sum.missed, RAYS, sum.made_up);
        assert_true(sum.missed > 0 && sum.missed < before);
        before = sum.missed;
    }
}

/* ---- pictures -------------------------------------------------------------------------------- */

static void without_depth_the_ground_is_as_it_was(void **state)
{
    (void)state;
    hc_terrain_scene       bare    = scene_of(hills);
    hc_detail              white   = { .heights = level_heights, .width = SIDE, .height = SIDE };
    static float           ones[4] = { 1.0F, 1.0F, 1.0F, 1.0F };
    const hc_camera        camera  = { .fov = 60.0F };
    hc_terrain_scene       with    = bare;
    const hc_terrain_scene none    = bare;
    white.heights                  = ones;
    white.width = white.height = 2;
    with.details               = &white;
    with.detail_count          = 1;
    draw_once(&first, &none, NULL, &camera);
    draw_once(&second, &with, NULL, &camera);
    for (int i = 0; i < PIXELS; i++) {
        assert_true(first.depth[i] == second.depth[i]
                    || fabsf(first.depth[i] - second.depth[i]) < 1e-2F);
    }
}

/* Seen from straight above, the ground lies lower by the depth where the map is black. */
static void depth_is_in_world_units(void **state)
{
    (void)state;
    static float     zeros[4];
    hc_detail        black  = { .heights = zeros, .width = 2, .height = 2, .depth = 7.0 };
    hc_terrain_scene scene  = scene_of(level_heights);
    const hc_camera  camera = from_above(300.0F);
    scene.details           = &black;
    scene.detail_count      = 1;
    scene.detail_fade[0]    = 900.0;
    scene.detail_fade[1]    = 1000.0;
    draw_once(&first, &scene, NULL, &camera);
    assert_true(fabsf(first.depth[PIXELS / 2 + WIDE / 2] - 807.0F) < 1e-2F);
    scene.exaggeration = 2.0; /* 400 high */
    draw_once(&first, &scene, NULL, &camera);
    assert_true(fabsf(first.depth[PIXELS / 2 + WIDE / 2] - 614.0F) < 1e-2F);
    scene.exaggeration   = 1.0;
    scene.detail_fade[0] = 700.0;
    scene.detail_fade[1] = 900.0; /* a half is left at 800 */
    draw_once(&first, &scene, NULL, &camera);
    assert_true(fabsf(first.depth[PIXELS / 2 + WIDE / 2] - 803.5F) < 1e-2F);
    scene.detail_fade[1] = 800.0;
    draw_once(&first, &scene, NULL, &camera);
    assert_true(first.depth[PIXELS / 2 + WIDE / 2] == 800.0F);
}

/* Far away the colour is the mean one. */
static void colours_fade_to_their_mean(void **state)
{
    (void)state;
    hc_detail        details[HC_DETAILS_MAX];
    hc_terrain_scene scene  = detailed(details, level_heights);
    const hc_camera  camera = from_above(100.0F);
    for (int i = 0; i < TEXELS; i++) {
        colours[3 * i] = i / MAP % 2 == 0 ? 0.9F : 0.1F;
    }
    details[0].colour  = colours;
    scene.detail_count = 1;
    scene.mask         = NULL;
    scene.no_shadows   = true;
    scene.haze         = INFINITY;
    scene.ground       = HC_GROUND_PLAIN; /* without ripples */
    details[0].depth   = 1e-6;
    draw_once(&first, &scene, NULL, &camera);
    scene.detail_fade[0] = 1.0;
    scene.detail_fade[1] = 2.0;
    draw_once(&second, &scene, NULL, &camera);
    float low = INFINITY, high = 0.0F, sum = 0.0F;
    for (int i = 0; i < PIXELS; i++) {
        low  = fminf(low, first.rgb[3 * i]);
        high = fmaxf(high, first.rgb[3 * i]);
        sum += first.rgb[3 * i] / PIXELS;
        assert_true(fabsf(second.rgb[3 * i] - second.rgb[0]) < 1e-3F);
        assert_true(second.rgb[3 * i + 1] == 0.0F);
    }
    assert_true(high > 5.0F * low);
    assert_true(fabsf(sum - second.rgb[0]) < 0.1F * sum);
}

static void the_view_of_misses_knows_details(void **state)
{
    (void)state;
    const hc_render_options missed = { .view = HC_VIEW_MISSED };
    for (int method = HC_DETAIL_SAFE; method <= HC_DETAIL_STEPS; method++) {
        hc_detail        details[HC_DETAILS_MAX];
        hc_terrain_scene scene  = detailed(details, hills);
        hc_camera        camera = { .eye = { 20.0, -20.0, 330.0 }, .at = { 100.0, -100.0, 200.0 } };
        scene.detail_method     = (hc_detail_method)method;
        scene.detail_steps      = 6;
        draw_once(&first, &scene, &missed, &camera);
        const uint64_t wrong = first.picture.figures.lost + first.picture.figures.made_up;
        assert_true(first.picture.figures.hits > PIXELS / 2);
        assert_true(method == HC_DETAIL_SAFE ? wrong == 0 : wrong > 0);
    }
}

/* Their own, and in the map of what the sun sees. */
static void details_throw_shadows(void **state)
{
    (void)state;
    const hc_camera camera = from_above(300.0F);
    float           light[2];
    for (int map = 0; map < 2; map++) {
        for (int bare = 0; bare < 2; bare++) {
            hc_detail        details[HC_DETAILS_MAX];
            hc_terrain_scene scene = detailed(details, level_heights);
            scene.details          = &details[2]; /* walls */
            details[2].tile        = 96.0;
            details[2].depth       = 60.0;
            scene.detail_count     = 1;
            scene.mask             = NULL;
            scene.sun[0]           = 1.0;
            scene.sun[2]           = 0.5;
            scene.no_shadows       = bare == 1;
            scene.shadow_map       = map == 1 ? 512 : 0;
            draw_once(&first, &scene, NULL, &camera);
            light[bare] = 0.0F;
            for (int i = 0; i < PIXELS; i++) {
                light[bare] += first.rgb[3 * i];
            }
        }
        assert_true(light[0] < 0.8F * light[1]);
    }
}

/* ---- what is refused ------------------------------------------------------------------------- */

static void refuse_as(const hc_terrain_scene *scene, hc_result expected, const char *says)
{
    hc_log      log     = { .text = "" };
    hc_terrain *terrain = NULL;
    assert_int_equal(hc_terrain_create(&terrain, scene, NULL, &log), expected);
    assert_null(terrain);
    if (strstr(log.text, says) == NULL) {
        fail_msg("'%s' does not say '%s'", log.text, says);
    }
}

static void bad_details(void **state)
{
    static float     high[4] = { 0.0F, 0.5F, 2.0F, 0.0F };
    hc_detail        details[HC_DETAILS_MAX];
    hc_terrain_scene scene = detailed(details, hills);
    (void)state;
    scene.mask_width = SIDE - 1;
    refuse_as(&scene, HC_ERROR_ARGUMENT, "scene.mask is 32 x 33; the field has 33 x 33");
    scene              = detailed(details, hills);
    scene.detail_count = 5;
    refuse_as(&scene, HC_ERROR_ARGUMENT, "scene.detail_count is 5");
    scene           = detailed(details, hills);
    details[1].tile = NAN;
    refuse_as(&scene, HC_ERROR_ARGUMENT, "detail 1 has a tile of nan");
    scene           = detailed(details, hills);
    details[1].tile = 1e-5;
    refuse_as(&scene, HC_ERROR_ARGUMENT, "detail 1 has a tile of 1e-05; the terrain is 320 wide");
    scene              = detailed(details, hills);
    details[2].heights = high;
    details[2].width = details[2].height = 2;
    refuse_as(&scene, HC_ERROR_ARGUMENT, "detail 2 has the height 2 at 0, 1");
    scene              = detailed(details, hills);
    details[3].heights = NULL;
    refuse_as(&scene, HC_ERROR_ARGUMENT, "detail 3 has no heights");
    scene                = detailed(details, hills);
    scene.detail_fade[0] = 2e9;
    refuse_as(&scene, HC_ERROR_ARGUMENT, "scene.detail_fade is 2e+09, 1e+09");
    scene               = detailed(details, hills);
    scene.detail_method = (hc_detail_method)2;
    refuse_as(&scene, HC_ERROR_ARGUMENT, "scene.detail_method is 2");
    assert_null(hc_detail_method_name(scene.detail_method));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(first_roots),
        cmocka_unit_test(roots_of_products),
        cmocka_unit_test(safe_loses_nothing),
        cmocka_unit_test(steps_lose_some),
        cmocka_unit_test(without_depth_the_ground_is_as_it_was),
        cmocka_unit_test(depth_is_in_world_units),
        cmocka_unit_test(colours_fade_to_their_mean),
        cmocka_unit_test(the_view_of_misses_knows_details),
        cmocka_unit_test(details_throw_shadows),
        cmocka_unit_test(bad_details),
    };
    return cmocka_run_group_tests(tests, prepare, NULL);
}
