/* Tiles into one field: what lies on both sides of a seam is then one patch like any other. */
#include <heightcast/field.h>

#include "base/fail.h"

#include <math.h>

/* Neighbours that hold the same original values, each normalised to its own range and rounded. */
static const double SAME = 0x1p-21;

typedef struct range {
    double low, high;
} range;

static const hc_field *tile_at(const hc_tiling *tiling, const hc_field *tiles, int column, int row)
{
    return &tiles[(size_t)row * (size_t)tiling->columns + (size_t)column];
}

/* ---- heights ------------------------------------------------------------------------------- */

static bool is_known(const hc_field *tile)
{
    return fabs(tile->elevation.low) > 0.0 || fabs(tile->elevation.high) > 0.0;
}

static range range_of(const hc_tiling *tiling, const hc_field *tiles)
{
    const int count    = tiling->columns * tiling->rows;
    bool      inverted = false;
    double    low = INFINITY, high = -INFINITY;
    for (int i = 0; i < count; i++) {
        const hc_elevation *e = &tiles[i].elevation;
        low                   = fmin(low, fmin(e->low, e->high));
        high                  = fmax(high, fmax(e->low, e->high));
        inverted              = inverted || e->low > e->high;
    }
    return inverted     ? (range){ high, low }
           : low < high ? (range){ low, high }
                        : (range){ 0.0, 1.0 };
}

static bool any_known(const hc_tiling *tiling, const hc_field *tiles)
{
    bool known = false;
    for (int i = 0; i < tiling->columns * tiling->rows; i++) {
        known = known || is_known(&tiles[i]);
    }
    return known;
}

/* Height in the range of all. */
static double height_in(const hc_field *tile, const range *all, bool known, int x, int y)
{
    const double h = (double)tile->heights[(size_t)y * (size_t)tile->width + (size_t)x];
    const double z = tile->elevation.low + h * (tile->elevation.high - tile->elevation.low);
    const bool   same =
        !known || (tile->elevation.low == all->low && tile->elevation.high == all->high);
    return same ? h : (z - all->low) / (all->high - all->low);
}

/* ---- seams --------------------------------------------------------------------------------- */

typedef struct seam {
    int    column, row; /* of the tile to the west or to the north                  */
    bool   below;       /* the neighbour is to the south, not to the east           */
    int    place;       /* along the seam, where the edges differ most              */
    double difference;  /* there                                                    */
} seam;

static void compare_edges(seam *s, const hc_tiling *tiling, const hc_field *tiles, const range *all,
                          bool known)
{
    const hc_field *a = tile_at(tiling, tiles, s->column, s->row);
    const hc_field *b =
        tile_at(tiling, tiles, s->column + (s->below ? 0 : 1), s->row + (s->below ? 1 : 0));
    const int length = s->below ? a->width : a->height;
    s->difference    = 0.0;
    for (int i = 0; i < length; i++) {
        const double here = s->below ? height_in(a, all, known, i, a->height - 1)
                                     : height_in(a, all, known, a->width - 1, i);
        const double there =
            s->below ? height_in(b, all, known, i, 0) : height_in(b, all, known, 0, i);
        if (fabs(here - there) > s->difference) {
            s->difference = fabs(here - there);
            s->place      = i;
        }
    }
}

/* The seam whose edges differ most. */
static seam worst_seam(const hc_tiling *tiling, const hc_field *tiles)
{
    const range all   = range_of(tiling, tiles);
    const bool  known = any_known(tiling, tiles);
    seam        worst = { .difference = 0.0 };
    for (int row = 0; row < tiling->rows; row++) {
        for (int column = 0; column < tiling->columns; column++) {
            for (int below = 0; below < 2; below++) {
                seam s = { .column = column, .row = row, .below = below == 1 };
                if (s.below ? row + 1 == tiling->rows : column + 1 == tiling->columns) {
                    continue;
                }
                compare_edges(&s, tiling, tiles, &all, known);
                worst = s.difference > worst.difference ? s : worst;
            }
        }
    }
    return worst;
}

static bool shares_edges(const hc_tiling *tiling, const hc_field *tiles)
{
    return tiling->seams == HC_SEAMS_SHARED
           || (tiling->seams == HC_SEAMS_AUTO && worst_seam(tiling, tiles).difference <= SAME);
}

/* ---- checks -------------------------------------------------------------------------------- */

static hc_result check_tiling(const hc_tiling *tiling, hc_log *log)
{
    if (tiling->columns < 1 || tiling->rows < 1 || tiling->columns > HC_TILES_MAX
        || tiling->rows > HC_TILES_MAX) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "tiling is %d x %d; each is 1 .. %d",
                       tiling->columns, tiling->rows, HC_TILES_MAX);
    }
    return (unsigned)tiling->seams <= HC_SEAMS_APART
               ? HC_OK
               : hc_fail(log, HC_ERROR_ARGUMENT, "tiling.seams is %d; it must be 0 .. 2",
                         (int)tiling->seams);
}

static hc_result check_tile(const hc_tiling *tiling, const hc_field *tiles, int column, int row,
                            hc_log *log)
{
    const hc_field *tile   = tile_at(tiling, tiles, column, row);
    const hc_result result = hc_field_check(tile, log);
    const int       width  = tile_at(tiling, tiles, column, 0)->width;
    const int       height = tile_at(tiling, tiles, 0, row)->height;
    if (result != HC_OK) {
        return result;
    }
    if (tile->wrap != HC_WRAP_NONE) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "tile [%d, %d] wraps along %s; tiles must not",
                       column, row, hc_wrap_name(tile->wrap));
    }
    if (tile->registration != tiles[0].registration) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "tile [%d, %d] has registration %s, tile [0, 0] has %s", column, row,
                       hc_registration_name(tile->registration),
                       hc_registration_name(tiles[0].registration));
    }
    if (tile->width != width || tile->height != height) {
        return hc_fail(log, HC_ERROR_ARGUMENT,
                       "tile [%d, %d] is %d x %d; its column is %d wide, its row %d high", column,
                       row, tile->width, tile->height, width, height);
    }
    return HC_OK;
}

static hc_result check_seams(const hc_tiling *tiling, const hc_field *tiles, hc_log *log)
{
    const seam worst = worst_seam(tiling, tiles);
    if (tiling->seams != HC_SEAMS_SHARED || worst.difference <= SAME) {
        return HC_OK;
    }
    return hc_fail(log, HC_ERROR_FIELD,
                   "tile [%d, %d] and the one %s of it should share an edge; at sample %d they "
                   "differ by %g of the range",
                   worst.column, worst.row, worst.below ? "south" : "east", worst.place,
                   worst.difference);
}

/* ---- all together -------------------------------------------------------------------------- */

hc_result hc_join_size(int *width, int *height, const hc_tiling *tiling, const hc_field *tiles,
                       hc_log *log)
{
    hc_result result = check_tiling(tiling, log);
    for (int i = 0; result == HC_OK && i < tiling->columns * tiling->rows; i++) {
        result = check_tile(tiling, tiles, i % tiling->columns, i / tiling->columns, log);
    }
    if (result == HC_OK) {
        result = check_seams(tiling, tiles, log);
    }
    if (result != HC_OK) {
        return result;
    }
    const int shared   = shares_edges(tiling, tiles) ? 1 : 0;
    int64_t   sides[2] = { shared, shared };
    for (int i = 0; i < tiling->columns; i++) {
        sides[0] += tile_at(tiling, tiles, i, 0)->width - shared;
    }
    for (int i = 0; i < tiling->rows; i++) {
        sides[1] += tile_at(tiling, tiles, 0, i)->height - shared;
    }
    if (sides[0] > HC_SIDE_MAX || sides[1] > HC_SIDE_MAX) {
        return hc_fail(log, HC_ERROR_LIMIT,
                       "the tiles are %lld x %lld together; sides are at most %d",
                       (long long)sides[0], (long long)sides[1], HC_SIDE_MAX);
    }
    *width  = (int)sides[0];
    *height = (int)sides[1];
    return HC_OK;
}

/* A tile's samples to where they belong; of a shared edge the neighbour to the west or north has
 * written first, and stays. */
static void put_tile(float *heights, int width, const hc_field *tile, const int origin[2],
                     const int skip[2], const range *all, bool known)
{
    for (int y = skip[1]; y < tile->height; y++) {
        float *line = heights + (size_t)(origin[1] + y) * (size_t)width + (size_t)origin[0];
        for (int x = skip[0]; x < tile->width; x++) {
            const double h = height_in(tile, all, known, x, y);
            line[x]        = (float)fmin(fmax(h, 0.0), 1.0);
        }
    }
}

hc_result hc_join_fields(float *heights, hc_field *joined, const hc_tiling *tiling,
                         const hc_field *tiles, hc_log *log)
{
    int             width = 0, height = 0;
    const hc_result result = hc_join_size(&width, &height, tiling, tiles, log);
    if (result != HC_OK) {
        return result;
    }
    const range all       = range_of(tiling, tiles);
    const bool  known     = any_known(tiling, tiles);
    const int   shared    = shares_edges(tiling, tiles) ? 1 : 0;
    int         origin[2] = { 0, 0 };
    for (int row = 0; row < tiling->rows; row++) {
        origin[0] = 0;
        for (int column = 0; column < tiling->columns; column++) {
            const hc_field *tile    = tile_at(tiling, tiles, column, row);
            const int       skip[2] = { column > 0 ? shared : 0, row > 0 ? shared : 0 };
            put_tile(heights, width, tile, origin, skip, &all, known);
            origin[0] += tile->width - shared;
        }
        origin[1] += tile_at(tiling, tiles, 0, row)->height - shared;
    }
    *joined         = tiles[0];
    joined->heights = heights;
    joined->width   = width;
    joined->height  = height;
    if (known) {
        joined->elevation.low  = all.low;
        joined->elevation.high = all.high;
    }
    return HC_OK;
}
