/* Maps written and read back: every container, layout, depth and size, pyramids included. */
#include "io_fixture.h"

typedef struct container {
    const char *ending;
    const char *format;
    int         bits; /* OR of 8, 16, 32 */
    bool        levels;
} container;

static const container containers[] = {
    { "png", "PNG", 8 | 16, false },       { "tif", "TIFF", 8 | 16 | 32, true },
    { "exr", "EXR", 32, false },           { "npy", "NPY", 8 | 16 | 32, false },
    { "ktx2", "KTX2", 8 | 16 | 32, true }, { "dds", "DDS", 8 | 16 | 32, true },
};
enum { CONTAINERS = sizeof containers / sizeof *containers };

/* One of each shape that a map can have. */
static const hc_map_info shapes[] = {
    { .kind = HC_MAP_CONE, .layout = HC_LAYOUT_DUMMER, .bits = 8, .max_ratio = 1.0F },
    { .kind = HC_MAP_CONE, .layout = HC_LAYOUT_RG, .cones = HC_CONES_L1, .max_ratio = 0.1F },
    { .kind = HC_MAP_CONE, .layout = HC_LAYOUT_QUAD, .cones = HC_CONES_QUAD, .max_ratio = 4.0F },
    { .kind = HC_MAP_CONE, .layout = HC_LAYOUT_ANISO, .cones = HC_CONES_ANISO, .max_ratio = 2.0F },
    { .kind = HC_MAP_RELAXED, .layout = HC_LAYOUT_RG, .max_ratio = 1e30F },
    { .kind = HC_MAP_CONE, .layout = HC_LAYOUT_HEIGHT, .max_ratio = 1.0F },
    { .kind = HC_MAP_BOUNDS, .layout = HC_LAYOUT_MINMAX },
    { .kind = HC_MAP_GRADIENT, .layout = HC_LAYOUT_GRADIENT },
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static const int sizes[][2] = { { 1, 1 }, { 1, 6 }, { 11, 1 }, { 5, 3 }, { 33, 47 } };
enum { SIZES = sizeof sizes / sizeof *sizes };

static hc_map make_map(const hc_map_info *shape, int bits, int width, int height, int levels)
{
    hc_map map                   = { .info = *shape };
    map.info.bits                = bits;
    map.info.width               = width;
    map.info.height              = height;
    map.info.channels            = hc_layout_channels(shape->layout);
    map.info.levels              = levels;
    map.info.wrap                = HC_WRAP_U;
    map.info.registration        = HC_GRID;
    map.info.elevation.low       = 236.0;
    map.info.elevation.high      = 1076.5;
    map.info.elevation.spacing_x = 92.5;
    map.info.elevation.spacing_y = 74.25;
    map.info.elevation.placed    = true;
    map.info.elevation.origin_x  = 1000.0;
    map.info.elevation.origin_y  = -2000.0;
    (void)snprintf(map.info.method, sizeof map.info.method, "quick improved, 5%%");
    (void)snprintf(map.info.elevation.unit, sizeof map.info.elevation.unit, "m");
    const size_t   bytes = hc_map_bytes(&map.info);
    unsigned       state = 7;
    unsigned char *texel = malloc(bytes);
    assert_non_null(texel);
    assert_true(bytes > 0);
    for (size_t i = 0; i < bytes; i++) {
        texel[i] = (unsigned char)next_number(&state);
    }
    map.texels = texel;
    /* float texels as bakers make them: numbers, and INFINITY where there is no limit */
    for (size_t i = 0; bits == 32 && i < bytes / sizeof(float); i++) {
        ((float *)map.texels)[i] =
            i % 5 == 4 ? INFINITY : (float)(next_number(&state) % 4096U) / 4096.0F;
    }
    return map;
}

static void assert_info(const hc_map_info *got, const hc_map_info *wanted)
{
    assert_int_equal(got->kind, wanted->kind);
    assert_int_equal(got->layout, wanted->layout);
    assert_int_equal(got->cones, wanted->cones);
    assert_int_equal(got->bits, wanted->bits);
    assert_int_equal(got->width, wanted->width);
    assert_int_equal(got->height, wanted->height);
    assert_int_equal(got->channels, wanted->channels);
    assert_int_equal(got->levels, wanted->levels);
    assert_int_equal(got->wrap, wanted->wrap);
    assert_int_equal(got->registration, wanted->registration);
    assert_memory_equal(&got->max_ratio, &wanted->max_ratio, sizeof got->max_ratio);
    assert_true(got->compat2006 == wanted->compat2006);
    assert_string_equal(got->method, wanted->method);
    assert_string_equal(got->elevation.unit, wanted->elevation.unit);
    assert_true(got->elevation.low == wanted->elevation.low);
    assert_true(got->elevation.high == wanted->elevation.high);
    assert_true(got->elevation.spacing_x == wanted->elevation.spacing_x);
    assert_true(got->elevation.spacing_y == wanted->elevation.spacing_y);
    assert_true(got->elevation.placed == wanted->elevation.placed);
    assert_true(got->elevation.origin_x == wanted->elevation.origin_x);
    assert_true(got->elevation.origin_y == wanted->elevation.origin_y);
}

static const char *path_of(const container *in)
{
    char name[32];
    (void)snprintf(name, sizeof name, "m.%s", in->ending);
    return in_folder(name);
}

static void round_trip(const hc_map *map, const container *in)
{
    hc_log       log  = { .text = "" };
    const char  *path = path_of(in);
    hc_map       read;
    hc_file_info info;
    assert_ok(hc_save_map(map, path, &(hc_save_options){ .overwrite = true }, &log), &log);
    assert_ok(hc_load_map(&read, path, NULL, &log), &log);
    assert_info(&read.info, &map->info);
    assert_memory_equal(read.texels, map->texels, hc_map_bytes(&map->info));
    hc_free_map(&read);
    assert_null(read.texels);

    assert_ok(hc_read_file_info(&info, path, NULL, &log), &log);
    assert_string_equal(info.format, in->format);
    assert_true(info.has_map);
    assert_info(&info.map, &map->info);
    assert_int_equal(info.channels, map->info.channels);
    assert_int_equal(info.bits, map->info.bits);
    assert_true(info.elevation.high == map->info.elevation.high);
}

static void test_round_trips(void **state)
{
    (void)state;
    for (int c = 0; c < CONTAINERS; c++) {
        for (int i = 0; i < SHAPES; i++) {
            for (int bits = 8; bits <= 32; bits *= 2) {
                const bool possible = (containers[c].bits & bits) != 0
                                      && (shapes[i].layout != HC_LAYOUT_DUMMER || bits == 8);
                for (int s = 0; possible && s < SIZES; s++) {
                    hc_map map = make_map(&shapes[i], bits, sizes[s][0], sizes[s][1], 1);
                    round_trip(&map, &containers[c]);
                    hc_free_map(&map);
                }
            }
        }
    }
}

static void test_unlimited_and_compatible(void **state)
{
    (void)state;
    hc_map_info shape = shapes[1];
    shape.max_ratio   = 0.0F;
    hc_map unlimited  = make_map(&shape, 32, 3, 2, 1);
    round_trip(&unlimited, &containers[2]);
    hc_free_map(&unlimited);
    shape            = shapes[0];
    shape.compat2006 = true;
    hc_map old       = make_map(&shape, 8, 3, 2, 1);
    round_trip(&old, &containers[0]);
    hc_free_map(&old);
}

static void test_pyramids(void **state)
{
    (void)state;
    static const hc_map_info kinds[] = {
        { .kind = HC_MAP_PYRAMID, .layout = HC_LAYOUT_MINMAX },
        { .kind = HC_MAP_BOUNDS, .layout = HC_LAYOUT_HEIGHT },
    };
    for (int c = 0; c < CONTAINERS; c++) {
        for (int bits = 8; bits <= 32; bits *= 2) {
            for (int s = 0; s < SIZES * 2 && (containers[c].bits & bits) != 0; s++) {
                const int *size   = sizes[s / 2];
                const int  levels = hc_pyramid_levels(size[0], size[1]);
                hc_map     map    = make_map(&kinds[s % 2], bits, size[0], size[1], levels);
                if (containers[c].levels || levels == 1) {
                    round_trip(&map, &containers[c]);
                } else {
                    hc_log      log  = { .text = "" };
                    const char *path = path_of(&containers[c]);
                    (void)unlink(path);
                    assert_refused(hc_save_map(&map, path, NULL, &log), HC_ERROR_UNSUPPORTED, &log,
                                   path, ".ktx2");
                    assert_int_equal(access(path, F_OK), -1);
                }
                hc_free_map(&map);
            }
        }
    }
}

/* One level goes into any container, as a map of its own. */
static void test_single_level(void **state)
{
    (void)state;
    const hc_map_info shape = { .kind = HC_MAP_PYRAMID, .layout = HC_LAYOUT_MINMAX };
    hc_map            map   = make_map(&shape, 32, 13, 6, 4);
    for (int c = 1; c < CONTAINERS; c++) {
        for (int level = 1; level <= 4; level++) {
            hc_log                log     = { .text = "" };
            const char           *path    = path_of(&containers[c]);
            const hc_save_options options = { .overwrite = true, .level = level };
            hc_map                read;
            int                   width;
            int                   height;
            const void           *texels = hc_map_level(&map, level - 1, &width, &height);
            assert_ok(hc_save_map(&map, path, &options, &log), &log);
            assert_ok(hc_load_map(&read, path, NULL, &log), &log);
            assert_int_equal(read.info.width, width);
            assert_int_equal(read.info.height, height);
            assert_int_equal(read.info.levels, 1);
            assert_memory_equal(read.texels, texels, hc_map_bytes(&read.info));
            hc_free_map(&read);
        }
    }
    hc_log                log    = { .text = "" };
    const char           *path   = path_of(&containers[1]);
    const hc_save_options third  = { .overwrite = true, .level = 3 };
    const hc_save_options beyond = { .overwrite = true, .level = 5 };
    hc_map                read;
    assert_ok(hc_save_map(&map, path, &third, &log), &log);
    assert_ok(hc_load_map(&read, path, NULL, &log), &log);
    /* four samples together: the first stands one and a half spacings further right and down */
    assert_true(read.info.elevation.spacing_x == 4.0 * 92.5);
    assert_true(read.info.elevation.spacing_y == 4.0 * 74.25);
    assert_true(read.info.elevation.origin_x == 1000.0 + 1.5 * 92.5);
    assert_true(read.info.elevation.origin_y == -2000.0 - 1.5 * 74.25);
    hc_free_map(&read);
    assert_refused(hc_save_map(&map, path, &beyond, &log), HC_ERROR_ARGUMENT, &log, path, "5");
    hc_free_map(&map);
}

/* What a container cannot hold is refused with the list of those that can. */
static void test_refusals(void **state)
{
    (void)state;
    hc_log      log    = { .text = "" };
    hc_map      floats = make_map(&shapes[1], 32, 3, 2, 1);
    hc_map      codes  = make_map(&shapes[1], 16, 3, 2, 1);
    const char *png    = in_folder("no.png");
    const char *exr    = in_folder("no.exr");
    const char *pgm    = in_folder("no.pgm");
    assert_refused(hc_save_map(&floats, png, NULL, &log), HC_ERROR_UNSUPPORTED, &log, png,
                   ".tif, .exr, .npy, .ktx2, .dds");
    assert_refused(hc_save_map(&codes, exr, NULL, &log), HC_ERROR_UNSUPPORTED, &log, exr,
                   ".png, .tif, .npy, .ktx2, .dds");
    assert_refused(hc_save_map(&codes, pgm, NULL, &log), HC_ERROR_UNSUPPORTED, &log, pgm, ".png");
    const hc_map empty = { .info = codes.info };
    assert_int_equal(hc_save_map(&empty, png, NULL, &log), HC_ERROR_ARGUMENT);
    codes.info.channels = 3;
    assert_int_equal(hc_save_map(&codes, png, NULL, &log), HC_ERROR_ARGUMENT);
    hc_free_map(&floats);
    hc_free_map(&codes);
    hc_free_map(NULL);
}

/* A map file is a field too, if it holds heights. */
static void test_maps_as_fields(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        hc_log      log  = { .text = "" };
        const char *path = in_folder("field.dds");
        hc_map      map  = make_map(&shapes[i], 8, 5, 4, 1);
        hc_field    field;
        assert_ok(hc_save_map(&map, path, &(hc_save_options){ .overwrite = true }, &log), &log);
        const hc_result result = hc_load_field(&field, path, NULL, &log);
        if (shapes[i].layout == HC_LAYOUT_QUAD || shapes[i].layout == HC_LAYOUT_GRADIENT) {
            assert_refused(result, HC_ERROR_UNSUPPORTED, &log, path, "no heights");
            assert_null(field.heights);
        } else {
            assert_ok(result, &log);
            for (int k = 0; k < 20; k++) {
                assert_true(field.heights[k] == hc_map_height_at(&map, k % 5, k / 5));
            }
            assert_true(field.elevation.low == 236.0 && field.elevation.high == 1076.5);
        }
        hc_free_field(&field);
        hc_free_map(&map);
    }
}

/* Files without metadata, and files that were changed after baking, are not maps. */
static void test_not_maps(void **state)
{
    (void)state;
    const float    heights[] = { 0.0F, 1.0F, 0.5F, 0.25F };
    const hc_field field     = { heights, 2, 2, .wrap = HC_WRAP_NONE };
    hc_log         log       = { .text = "" };
    const char    *path      = in_folder("not.npy");
    hc_map         map;
    assert_ok(hc_save_field(&field, path, NULL, &log), &log);
    assert_refused(hc_load_map(&map, path, NULL, &log), HC_ERROR_FORMAT, &log, path, "no metadata");
    assert_null(map.texels);

    static const char *const changes[][3] = {
        { "width=3", "width=4", "changed" },       { "bits=8", "bits=7", "wrong" },
        { "kind=cone", "kind=corn", "kind=corn" }, { " wrap=u", " wrap ", "wrap" },
        { "method=", "mexhod=", "method" },        { "low=236", "low=nan", "low=nan" },
        { "levels=1", "bits=8  ", "bits=8" },      { "%20", "%2x", "quick%2x" },
    };
    hc_map made = make_map(&shapes[1], 8, 3, 2, 1);
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        size_t size;
        assert_ok(hc_save_map(&made, path, &(hc_save_options){ .overwrite = true }, &log), &log);
        unsigned char *bytes = read_bytes(path, &size);
        char          *found = strstr((char *)bytes + 12, changes[i][0]);
        assert_non_null(found);
        memcpy(found, changes[i][1], strlen(changes[i][1]));
        write_bytes(path, bytes, size);
        free(bytes);
        assert_refused(hc_load_map(&map, path, NULL, &log), HC_ERROR_FORMAT, &log, path,
                       changes[i][2]);
    }
    hc_free_map(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trips), cmocka_unit_test(test_unlimited_and_compatible),
        cmocka_unit_test(test_pyramids),    cmocka_unit_test(test_single_level),
        cmocka_unit_test(test_refusals),    cmocka_unit_test(test_maps_as_fields),
        cmocka_unit_test(test_not_maps),
    };
    return cmocka_run_group_tests(tests, fixture_begin, fixture_end);
}
