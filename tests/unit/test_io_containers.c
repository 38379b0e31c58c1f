/* What can be written, as hc_container says: each entry is tried. */
#include "io_fixture.h"

static const int depths[] = { 8, 16, 32 };

static void test_by_ending(void **state)
{
    (void)state;
    assert_string_equal(hc_container_of("a/b.tif")->name, "TIFF");
    assert_string_equal(hc_container_of("b.TIFF")->name, "TIFF");
    assert_string_equal(hc_container_of(".png.npy")->name, "NPY");
    assert_null(hc_container_of("b.jpg"));
    assert_null(hc_container_of("png"));
    assert_null(hc_container_of(".png"));
    assert_null(hc_container_of(""));
}

static void test_index_ends(void **state)
{
    (void)state;
    int count = 0;
    while (hc_container_at(count) != NULL) {
        const hc_container *container = hc_container_at(count);
        char                path[32];
        (void)snprintf(path, sizeof path, "x%s", container->endings[0]);
        assert_ptr_equal(hc_container_of(path), container);
        count++;
    }
    assert_true(count > 5);
    assert_null(hc_container_at(count + 100));
    assert_null(hc_container_at(-1));
}

/* Saving works for the depths that are named and for no others. */
static void test_field_depths(void **state)
{
    (void)state;
    static const float heights[6] = { 0.0F, 0.25F, 0.5F, 0.75F, 1.0F, 0.125F };
    const hc_field     field      = { .heights = heights, .width = 3, .height = 2 };
    for (int i = 0; hc_container_at(i) != NULL; i++) {
        const hc_container *container = hc_container_at(i);
        char                name[32];
        (void)snprintf(name, sizeof name, "field%s", container->endings[0]);
        for (int k = 0; k < 3; k++) {
            const hc_save_options options = { .overwrite = true, .bits = depths[k] };
            const bool            named   = (container->field_bits & depths[k]) != 0;
            assert_int_equal(hc_save_field(&field, in_folder(name), &options, NULL),
                             named ? HC_OK : HC_ERROR_UNSUPPORTED);
        }
    }
}

static void test_map_depths_and_levels(void **state)
{
    (void)state;
    static const float texels[8] = { 0.5F }; /* enough for each depth */
    for (int i = 0; hc_container_at(i) != NULL; i++) {
        const hc_container *container = hc_container_at(i);
        char                name[32];
        (void)snprintf(name, sizeof name, "map%s", container->endings[0]);
        for (int k = 0; k < 6; k++) {
            const int             levels  = k < 3 ? 1 : 2;
            const int             bits    = depths[k % 3];
            const hc_map          map     = { .info   = { .kind     = HC_MAP_PYRAMID,
                                                          .layout   = HC_LAYOUT_MINMAX,
                                                          .bits     = bits,
                                                          .width    = 2,
                                                          .height   = 1,
                                                          .channels = 2,
                                                          .levels   = levels },
                                              .texels = (void *)(uintptr_t)texels };
            const bool            named   = (container->map_bits & bits) != 0;
            const bool            fits    = named && (levels == 1 || container->levels);
            const hc_save_options options = { .overwrite = true };
            assert_int_equal(hc_save_map(&map, in_folder(name), &options, NULL),
                             fits ? HC_OK : HC_ERROR_UNSUPPORTED);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_by_ending),
        cmocka_unit_test(test_index_ends),
        cmocka_unit_test(test_field_depths),
        cmocka_unit_test(test_map_depths_and_levels),
    };
    return cmocka_run_group_tests(tests, fixture_begin, fixture_end);
}
