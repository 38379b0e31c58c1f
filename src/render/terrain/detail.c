/* docs/algorithms.md, section 22.9, has the formulas. */
#include "terrain.h"

#include "../check.h"
#include "../vec.h"

#include <stdlib.h>
#include <string.h>

enum { STEPS = 32, STEPS_MAX = 65536, CHANNELS = 4 };

static const double SAMPLES_WIDE = 16.0; /* a tile */
static const double FLATNESS     = 16.0; /* its width over its depth */
static const double FADE[2]      = { 24.0, 48.0 };
static const double FARTHEST     = 1e12;
static const double TEXELS_MAX   = 0x1p24;

const char *hc_detail_method_name(hc_detail_method method)
{
    static const char *const names[] = { "safe", "steps" };
    return (unsigned)method < 2 ? names[method] : NULL;
}

/* ---- checks ---------------------------------------------------------------------------------- */

static hc_result check_detail(const hc_detail *detail, int index, hc_log *log)
{
    CHECK(check_whole("detail.width", detail->width, 1, HC_SIDE_MAX, log));
    CHECK(check_whole("detail.height", detail->height, 1, HC_SIDE_MAX, log));
    if (!(detail->tile >= 0.0 && detail->tile <= FARTHEST && detail->depth >= 0.0
          && detail->depth <= FARTHEST)) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "detail %d has a tile of %g and a depth of %g; both are 0 .. %g", index,
                       detail->tile, detail->depth, FARTHEST);
    }
    if (detail->heights == NULL) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "detail %d has no heights", index);
    }
    const size_t count = (size_t)detail->width * (size_t)detail->height;
    for (size_t i = 0; i < count; i++) {
        if (!(detail->heights[i] >= 0.0F && detail->heights[i] <= 1.0F)) {
            return hc_fail(log, HC_ERROR_ARGUMENT,
                           "detail %d has the height %g at %zu, %zu; heights are 0 .. 1", index,
                           (double)detail->heights[i], i % (size_t)detail->width,
                           i / (size_t)detail->width);
        }
    }
    return HC_OK;
}

static hc_result check_mask(const hc_terrain_scene *scene, hc_log *log)
{
    const bool fits =
        scene->mask_width == scene->field.width && scene->mask_height == scene->field.height;
    return scene->mask == NULL || fits
               ? HC_OK
               : hc_fail(log, HC_ERROR_ARGUMENT,
                         "scene.mask is %d x %d; the field has %d x %d samples, and a mask as many "
                         "texels",
                         scene->mask_width, scene->mask_height, scene->field.width,
                         scene->field.height);
}

static hc_result check_polygons(const hc_terrain_scene *scene, hc_log *log)
{
    return scene->polygons == HC_POLYGONS_NONE
               ? HC_OK
               : hc_fail(log, HC_ERROR_UNSUPPORTED,
                         "the scene has details; scene.polygons is %s, and triangles between "
                         "samples are too coarse to show any",
                         hc_polygons_name(scene->polygons));
}

static hc_result check_details(const hc_terrain_scene *scene, hc_log *log)
{
    CHECK(check_whole("scene.detail_count", scene->detail_count, 0, HC_DETAILS_MAX, log));
    CHECK(check_whole("scene.detail_method", (int)scene->detail_method, 0, HC_DETAIL_STEPS, log));
    CHECK(check_whole("scene.detail_steps", scene->detail_steps, 0, STEPS_MAX, log));
    const double *fade = scene->detail_fade;
    if (!(fade[0] >= 0.0 && (fade[0] < fade[1] || fade[1] == 0.0))) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "scene.detail_fade is %g, %g; the second is above the first", fade[0],
                       fade[1]);
    }
    for (int i = 0; i < scene->detail_count; i++) {
        CHECK(check_detail(&scene->details[i], i, log));
    }
    if (scene->detail_count == 0) {
        return HC_OK;
    }
    CHECK(check_mask(scene, log));
    return check_polygons(scene, log);
}

/* ---- defaults -------------------------------------------------------------------------------- */

static void set_mean(double mean[3], const hc_detail *detail)
{
    const size_t count = (size_t)detail->width * (size_t)detail->height;
    memset(mean, 0, 3 * sizeof *mean);
    for (size_t i = 0; detail->colour != NULL && i < 3 * count; i++) {
        mean[i % 3] += (double)detail->colour[i] / (double)count;
    }
}

static void resolve(hc_details *details, const hc_terrain_scene *scene)
{
    double widest  = 0.0;
    details->count = scene->detail_count;
    details->texel = INFINITY;
    for (int i = 0; i < details->count; i++) {
        hc_detail *map   = &details->maps[i];
        *map             = scene->details[i];
        map->tile        = map->tile > 0.0 ? map->tile : SAMPLES_WIDE * scene->spacing[0];
        map->depth       = map->depth > 0.0 ? map->depth : map->tile / FLATNESS;
        details->rate[i] = map->width / map->tile;
        details->cut[i]  = map->depth / (scene->high - scene->low);
        details->texel   = fmin(details->texel, 1.0 / details->rate[i]);
        widest           = fmax(widest, map->tile);
        set_mean(details->mean[i], map);
    }
    for (int k = 0; k < 2; k++) {
        details->fade[k] = scene->detail_fade[1] > 0.0 ? scene->detail_fade[k] : FADE[k] * widest;
    }
}

/* ---- tops ------------------------------------------------------------------------------------ */

static void fill_corners(float *tops, const hc_detail *map)
{
    for (int y = 0; y < map->height; y++) {
        const float *upper = map->heights + (size_t)y * (size_t)map->width;
        const float *lower = map->heights + (size_t)((y + 1) % map->height) * (size_t)map->width;
        for (int x = 0; x < map->width; x++) {
            const int right = (x + 1) % map->width;
            *tops++         = fmaxf(fmaxf(upper[x], upper[right]), fmaxf(lower[x], lower[right]));
        }
    }
}

/* The last texel of an odd side's half takes the one left over, too. */
static void fill_level(hc_pyramid *tops, int level)
{
    int          wide, high, fine_wide, fine_high;
    float       *coarse = hc_pyramid_level(tops, level, &wide, &high);
    const float *fine   = hc_pyramid_level(tops, level - 1, &fine_wide, &fine_high);
    memset(coarse, 0, (size_t)wide * (size_t)high * sizeof *coarse); /* heights are 0 or more */
    for (int y = 0; y < fine_high; y++) {
        for (int x = 0; x < fine_wide; x++) {
            const int row    = y / 2 < high ? y / 2 : high - 1;
            const int column = x / 2 < wide ? x / 2 : wide - 1;
            float    *top    = &coarse[(size_t)row * (size_t)wide + (size_t)column];
            *top             = fmaxf(*top, fine[(size_t)y * (size_t)fine_wide + (size_t)x]);
        }
    }
}

static hc_result set_tops(hc_details *details, const hc_terrain_scene *scene, hc_log *log)
{
    const double wide = fmax(scene->spacing[0], scene->spacing[1]);
    for (int i = 0; i < details->count; i++) {
        const hc_detail *map    = &details->maps[i];
        hc_pyramid      *tops   = &details->tops[i];
        const int        levels = hc_pyramid_levels(map->width, map->height);
        *tops        = (hc_pyramid){ .width = map->width, .height = map->height, .levels = levels };
        tops->values = malloc(hc_pyramid_size(map->width, map->height) * sizeof *tops->values);
        if (tops->values == NULL) {
            return hc_fail(log, HC_ERROR_MEMORY, "no memory for a detail of %d x %d", map->width,
                           map->height);
        }
        fill_corners(tops->values, map);
        for (int level = 1; level < tops->levels; level++) {
            fill_level(tops, level);
            if (level > details->level_max && (1 << level) < wide * details->rate[i]) {
                details->level_max = level;
            }
        }
    }
    return HC_OK;
}

void hc_details_free(hc_details *details)
{
    for (int i = 0; i < details->count; i++) {
        free(details->tops[i].values);
    }
}

/* Texels are counted across the whole terrain. */
static hc_result check_count(const hc_terrain *terrain, hc_log *log)
{
    for (int i = 0; i < terrain->details.count; i++) {
        if (!(terrain->details.rate[i] * terrain->side < TEXELS_MAX)) {
            return hc_fail(log, HC_ERROR_ARGUMENT,
                           "detail %d has a tile of %g; the terrain is %g wide, and has at most "
                           "2^24 of its texels side by side",
                           i, terrain->details.maps[i].tile, terrain->side);
        }
    }
    return HC_OK;
}

hc_result hc_details_set(hc_terrain *terrain, hc_log *log)
{
    CHECK(check_details(&terrain->scene, log));
    resolve(&terrain->details, &terrain->scene);
    CHECK(check_count(terrain, log));
    CHECK(set_tops(&terrain->details, &terrain->scene, log));
    terrain->scene.details = NULL; /* they may go */
    if (terrain->scene.detail_steps == 0) {
        terrain->scene.detail_steps = STEPS;
    }
    return HC_OK;
}

/* ---- patches --------------------------------------------------------------------------------- */

static hc_bilinear through(double upper_left, double upper_right, double lower_left,
                           double lower_right)
{
    return (hc_bilinear){ upper_left,
                          { upper_right - upper_left, lower_left - upper_left },
                          lower_right - upper_right - lower_left + upper_left };
}

static size_t inside(int index, int size)
{
    return (size_t)(index < 0 ? 0 : index < size ? index : size - 1);
}

static size_t folded(int index, int size)
{
    const int rest = index % size;
    return (size_t)(rest < 0 ? rest + size : rest);
}

/* The field goes on outwards with its border. A top has the same height at all corners. */
static void corners_of(size_t corners[4], const hc_field *field, const int cell[2], bool tops)
{
    for (int i = 0; i < 4; i++) {
        corners[i] = inside(cell[1] + (tops ? 0 : i / 2), field->height) * (size_t)field->width
                     + inside(cell[0] + (tops ? 0 : i % 2), field->width);
    }
}

hc_bilinear hc_ground_patch(const hc_terrain *terrain, const int cell[2], bool tops)
{
    const float *h = terrain->scene.field.heights;
    size_t       at[4];
    corners_of(at, &terrain->scene.field, cell, tops);
    return through((double)h[at[0]], (double)h[at[1]], (double)h[at[2]], (double)h[at[3]]);
}

hc_bilinear hc_mask_patch(const hc_terrain *terrain, int detail, const int cell[2], bool tops)
{
    const uint8_t *mask = terrain->scene.mask;
    size_t         at[4];
    if (mask == NULL) {
        return (hc_bilinear){ .base = 1.0 / terrain->details.count };
    }
    corners_of(at, &terrain->scene.field, cell, tops);
    for (int i = 0; i < 4; i++) {
        at[i] = at[i] * CHANNELS + (size_t)detail;
    }
    return through(mask[at[0]] / 255.0, mask[at[1]] / 255.0, mask[at[2]] / 255.0,
                   mask[at[3]] / 255.0);
}

hc_bilinear hc_detail_patch(const hc_terrain *terrain, int detail, const int cell[2])
{
    const hc_detail *map   = &terrain->details.maps[detail];
    const size_t     x     = folded(cell[0], map->width);
    const size_t     y     = folded(cell[1], map->height);
    const size_t     right = x + 1 < (size_t)map->width ? x + 1 : 0;
    const float     *upper = map->heights + y * (size_t)map->width;
    const float     *lower =
        map->heights + (y + 1 < (size_t)map->height ? y + 1 : 0) * (size_t)map->width;
    return through((double)upper[x], (double)upper[right], (double)lower[x], (double)lower[right]);
}

double hc_bilinear_at(const hc_bilinear *patch, double x, double y)
{
    return patch->base + x * patch->slope[0] + y * patch->slope[1] + x * y * patch->twist;
}

/* ---- at a hit -------------------------------------------------------------------------------- */

/* A place in a grid of cells: the cell, and where in it. */
typedef struct spot {
    int    cell[2];
    double at[2];
} spot;

static spot spot_of(double x, double y)
{
    const double column = floor(x);
    const double row    = floor(y);
    return (spot){ { (int)column, (int)row }, { x - column, y - row } };
}

static spot spot_on_ground(const hc_terrain *terrain, const hc_hit *hit)
{
    const hc_field *field = &terrain->scene.field;
    const double    first =
        (field->registration == HC_GRID ? 0.0 : 0.5) - (hc_terrain_has_tops(terrain) ? 0.5 : 0.0);
    spot s = spot_of((double)hit->u / hc_field_step_u(field) - first,
                     (double)hit->v / hc_field_step_v(field) - first);
    if ((hit->flags & HC_HIT_SIDE) != 0) { /* the face of this top, whatever rounding says */
        s.cell[0] = hit->cell_x;
        s.cell[1] = hit->cell_y;
    }
    return s;
}

static spot spot_on_detail(const hc_terrain *terrain, int detail, const hc_hit *hit)
{
    const double rate = terrain->details.rate[detail];
    const double east = (double)hit->u * (terrain->high[0] - terrain->low[0]);
    const double down = (double)hit->v * (terrain->high[1] - terrain->low[1]);
    return spot_of(rate * east - 0.5, rate * down - 0.5);
}

double hc_details_left(const hc_terrain *terrain, double distance)
{
    const double *fade = terrain->details.fade;
    const double  x    = fmin(fmax((distance - fade[0]) / (fade[1] - fade[0]), 0.0), 1.0);
    return 1.0 - x * x * (3.0 - 2.0 * x);
}

static double texel_at(const hc_detail *map, int x, int y)
{
    return (double)
        map->heights[folded(y, map->height) * (size_t)map->width + folded(x, map->width)];
}

/* Heights per texel: of the patch, or of central differences between its corners. */
static void slopes_of(double slopes[2], const hc_terrain *terrain, int detail, const spot *s)
{
    const hc_detail  *map   = &terrain->details.maps[detail];
    const hc_bilinear patch = hc_detail_patch(terrain, detail, s->cell);
    if (terrain->scene.blocky) {
        slopes[0] = patch.slope[0] + s->at[1] * patch.twist;
        slopes[1] = patch.slope[1] + s->at[0] * patch.twist;
        return;
    }
    slopes[0] = slopes[1] = 0.0;
    for (int i = 0; i < 4; i++) {
        const double weight =
            (i % 2 != 0 ? s->at[0] : 1.0 - s->at[0]) * (i / 2 != 0 ? s->at[1] : 1.0 - s->at[1]);
        const int x = s->cell[0] + i % 2;
        const int y = s->cell[1] + i / 2;
        slopes[0] += weight * 0.5 * (texel_at(map, x + 1, y) - texel_at(map, x - 1, y));
        slopes[1] += weight * 0.5 * (texel_at(map, x, y + 1) - texel_at(map, x, y - 1));
    }
}

void hc_details_bend(double normal[3], const hc_terrain *terrain, const hc_hit *hit, double left)
{
    const bool   tops      = hc_terrain_has_tops(terrain);
    const spot   ground    = spot_on_ground(terrain, hit);
    const double up        = fmax(normal[2], 1e-6);
    double       slopes[2] = { -normal[0] / up, -normal[1] / up };
    for (int i = 0; i < terrain->details.count; i++) {
        const spot        texel = spot_on_detail(terrain, i, hit);
        const hc_bilinear mask  = hc_mask_patch(terrain, i, ground.cell, tops);
        const hc_bilinear patch = hc_detail_patch(terrain, i, texel.cell);
        const double      share = hc_bilinear_at(&mask, ground.at[0], ground.at[1]);
        const double      low   = 1.0 - hc_bilinear_at(&patch, texel.at[0], texel.at[1]);
        double            steep[2];
        slopes_of(steep, terrain, i, &texel);
        for (int k = 0; k < 2; k++) {
            const double shares  = mask.slope[k] + ground.at[1 - k] * mask.twist;
            const double towards = k == 0 ? 1.0 : -1.0; /* rows go against y */
            slopes[k] += towards * left * terrain->details.cut[i] * terrain->placement.scale_z
                         * (share * steep[k] * terrain->details.rate[i]
                            - low * shares / terrain->scene.spacing[k]);
        }
    }
    normal[0] = -slopes[0];
    normal[1] = -slopes[1];
    normal[2] = 1.0;
    (void)hc_unit(normal);
}

static void filtered(double rgb[3], const hc_detail *map, const spot *s, bool nearest)
{
    const double a = nearest ? floor(s->at[0] + 0.5) : s->at[0];
    const double b = nearest ? floor(s->at[1] + 0.5) : s->at[1];
    memset(rgb, 0, 3 * sizeof *rgb);
    for (int i = 0; i < 4; i++) {
        const double weight = (i % 2 != 0 ? a : 1.0 - a) * (i / 2 != 0 ? b : 1.0 - b);
        const float *texel  = map->colour
                             + 3
                                   * (folded(s->cell[1] + i / 2, map->height) * (size_t)map->width
                                      + folded(s->cell[0] + i % 2, map->width));
        for (int k = 0; k < 3; k++) {
            rgb[k] += weight * (double)texel[k];
        }
    }
}

/* Shares that come to more than 1 are as good as 1. */
void hc_details_colour(double rgb[3], const hc_terrain *terrain, const hc_hit *hit, double left)
{
    const bool tops   = hc_terrain_has_tops(terrain);
    const spot ground = spot_on_ground(terrain, hit);
    double     sum[3] = { 0.0, 0.0, 0.0 };
    double     shares = 0.0;
    for (int i = 0; i < terrain->details.count; i++) {
        const hc_detail  *map   = &terrain->details.maps[i];
        const spot        texel = spot_on_detail(terrain, i, hit);
        const hc_bilinear mask  = hc_mask_patch(terrain, i, ground.cell, tops);
        const double      share = hc_bilinear_at(&mask, ground.at[0], ground.at[1]);
        double            own[3];
        if (map->colour == NULL) {
            continue;
        }
        filtered(own, map, &texel, terrain->scene.blocky);
        for (int k = 0; k < 3; k++) {
            const double mean = terrain->details.mean[i][k];
            sum[k] += share * (mean + left * (own[k] - mean));
        }
        shares += share;
    }
    for (int k = 0; k < 3; k++) {
        rgb[k] = rgb[k] * (1.0 - fmin(shares, 1.0)) + sum[k] / fmax(shares, 1.0);
    }
}
