/* Tiles joined: the field they were cut from comes back, whatever they share. */
#include <heightcast/field.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDE = 33, HIGH = 21, COLUMNS = 4, ROWS = 4 };

static float whole[WIDE * HIGH], cut[WIDE * HIGH * 4], back[WIDE * HIGH * 4];

static int prepare(void **state)
{
    (void)state;
    return hc_synth(whole, WIDE, HIGH, "fbm", 5, NULL) == HC_OK ? 0 : -1;
}

/* First sample of tile `i` along an axis, or the end of the last one. */
static int edge_of(int i, int tiles, int side, int shared)
{
    return i == tiles ? side - shared : i * (side / tiles);
}

/* Tiles of unequal sides; with `own` each in a range of its own. */
static void cut_up(hc_field tiles[COLUMNS * ROWS], int shared, bool own)
{
    float *to = cut;
    for (int k = 0; k < COLUMNS * ROWS; k++) {
        const int    x0 = edge_of(k % COLUMNS, COLUMNS, WIDE, shared);
        const int    y0 = edge_of(k / COLUMNS, ROWS, HIGH, shared);
        const int    x1 = edge_of(k % COLUMNS + 1, COLUMNS, WIDE, shared) + shared;
        const int    y1 = edge_of(k / COLUMNS + 1, ROWS, HIGH, shared) + shared;
        const double lo = own ? 100.0 - k : 50.0;
        const double hi = own ? 300.0 + 7 * k : 450.0;
        tiles[k]        = (hc_field){ .heights   = to,
                                      .width     = x1 - x0,
                                      .height    = y1 - y0,
                                      .elevation = { .low = lo, .high = hi, .spacing_x = 2 } };
        for (int y = y0; y < y1; y++) {
            for (int x = x0; x < x1; x++) { /* originals 150 .. 250 */
                const double z = 150.0 + 100.0 * (double)whole[y * WIDE + x];
                *to++          = (float)((z - lo) / (hi - lo));
            }
        }
    }
}

static void joins_to_the_whole(int shared, bool own, hc_seams seams)
{
    const hc_tiling tiling = { COLUMNS, ROWS, seams };
    hc_field        tiles[COLUMNS * ROWS], joined;
    hc_log          log   = { .text = "" };
    int             width = 0, height = 0;
    cut_up(tiles, shared, own);
    if (hc_join_size(&width, &height, &tiling, tiles, &log) != HC_OK) {
        fail_msg("%s", log.text);
    }
    assert_int_equal(width, WIDE);
    assert_int_equal(height, HIGH);
    assert_int_equal(hc_join_fields(back, &joined, &tiling, tiles, &log), HC_OK);
    assert_int_equal(hc_field_check(&joined, &log), HC_OK);
    assert_true(joined.heights == back && joined.elevation.spacing_x == 2.0);
    const double low  = joined.elevation.low;
    const double rise = joined.elevation.high - low;
    assert_true(low == (own ? 85.0 : 50.0) && rise == (own ? 320.0 : 400.0));
    for (int i = 0; i < WIDE * HIGH; i++) {
        const double z         = 150.0 + 100.0 * (double)whole[i];
        const double tolerance = own ? 1e-4 : 3e-5;
        assert_true(fabs(low + rise * (double)back[i] - z) < tolerance);
    }
}

static void the_whole_comes_back(void **state)
{
    (void)state;
    for (int own = 0; own < 2; own++) {
        joins_to_the_whole(1, own == 1, HC_SEAMS_AUTO);
        joins_to_the_whole(1, own == 1, HC_SEAMS_SHARED);
        joins_to_the_whole(0, own == 1, HC_SEAMS_AUTO);
        joins_to_the_whole(0, own == 1, HC_SEAMS_APART);
    }
}

/* In one range, or in none that is known, heights are copied. */
static void heights_of_one_range_stay(void **state)
{
    (void)state;
    const hc_tiling tiling = { 2, 1, HC_SEAMS_APART };
    for (int known = 0; known < 2; known++) {
        hc_field tiles[2] = { { .heights = whole, .width = 3, .height = 2 },
                              { .heights = whole + 6, .width = 4, .height = 2 } };
        hc_field joined;
        for (int i = 0; i < 2; i++) {
            tiles[i].elevation.low  = known == 1 ? 9.0 : 0.0;
            tiles[i].elevation.high = known == 1 ? -3.0 : 0.0; /* a depth map */
        }
        assert_int_equal(hc_join_fields(back, &joined, &tiling, tiles, NULL), HC_OK);
        assert_int_equal(joined.width, 7);
        assert_memory_equal(back, whole, 3 * sizeof *whole);
        assert_memory_equal(back + 3, whole + 6, 4 * sizeof *whole);
        assert_memory_equal(back + 7, whole + 3, 3 * sizeof *whole);
        assert_true(joined.elevation.low == tiles[0].elevation.low);
        assert_true(joined.elevation.high == tiles[0].elevation.high);
    }
}

static void level_tiles_lie_where_they_should(void **state)
{
    (void)state;
    static const float flat[4] = { 0 }; /* a constant field becomes 0 */
    const hc_tiling    tiling  = { 2, 1, HC_SEAMS_APART };
    hc_field           tiles[2];
    for (int i = 0; i < 2; i++) {
        const double z = i == 0 ? 5.0 : 9.0;
        tiles[i]       = (hc_field){
                  .heights = flat, .width = 2, .height = 2, .elevation = { .low = z, .high = z }
        };
    }
    hc_field joined;
    assert_int_equal(hc_join_fields(back, &joined, &tiling, tiles, NULL), HC_OK);
    assert_true(back[0] == 0.0F && back[2] == 1.0F);
    assert_true(joined.elevation.low == 5.0 && joined.elevation.high == 9.0);
}

/* ---- refusals -------------------------------------------------------------------------------- */

static void refuse(const hc_tiling *tiling, const hc_field *tiles, hc_result result,
                   const char *says)
{
    hc_log log   = { .text = "" };
    int    width = 0, height = 0;
    assert_int_equal(hc_join_size(&width, &height, tiling, tiles, &log), result);
    if (strstr(log.text, says) == NULL) {
        fail_msg("'%s' does not say '%s'", log.text, says);
    }
}

static void what_does_not_fit_is_refused(void **state)
{
    (void)state;
    hc_field  tiles[COLUMNS * ROWS];
    hc_tiling tiling = { COLUMNS, ROWS, HC_SEAMS_SHARED };
    cut_up(tiles, 0, false);
    refuse(&tiling, tiles, HC_ERROR_FIELD, "should share an edge");
    cut_up(tiles, 1, false);
    cut[tiles[5].heights - cut + 3 * tiles[5].width - 1] += 0.01F; /* column 1, row 1, sample 2 */
    refuse(&tiling, tiles, HC_ERROR_FIELD, "tile [1, 1] and the one east");
    refuse(&tiling, tiles, HC_ERROR_FIELD, "at sample 2 they differ by 0.0099");
    cut_up(tiles, 1, false);
    tiles[6].width--;
    refuse(&tiling, tiles, HC_ERROR_ARGUMENT, "tile [2, 1] is 8 x 6");
    cut_up(tiles, 1, false);
    tiles[9].registration = HC_GRID;
    refuse(&tiling, tiles, HC_ERROR_ARGUMENT, "registration");
    tiles[9].registration = HC_TEXEL;
    tiles[9].wrap         = HC_WRAP_V;
    refuse(&tiling, tiles, HC_ERROR_ARGUMENT, "tile [1, 2] wraps along v");
    refuse(&(hc_tiling){ 0, 1, HC_SEAMS_AUTO }, tiles, HC_ERROR_ARGUMENT, "0 x 1");
    refuse(&(hc_tiling){ 1, 65, HC_SEAMS_AUTO }, tiles, HC_ERROR_ARGUMENT, "1 x 65");
    refuse(&(hc_tiling){ 1, 1, (hc_seams)3 }, tiles, HC_ERROR_ARGUMENT, "tiling.seams");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_whole_comes_back),
        cmocka_unit_test(heights_of_one_range_stay),
        cmocka_unit_test(level_tiles_lie_where_they_should),
        cmocka_unit_test(what_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, prepare, NULL);
}
