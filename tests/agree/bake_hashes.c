/* Prints one hash for each thing that heightcast bakes: the same lines on every machine and in
 * every build, or promise 2 is broken. tests/golden/bake_hashes.txt holds the lines; CMake
 * compares.
 *
 * Each bake is repeated with one thread and three, and where there are vector kernels for every
 * instruction set of this build and machine: exit 1 if their bytes differ. */
#include <heightcast/heightcast.h>

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 53, HEIGHT = 41, CHANNELS_MAX = 4 }; /* odd, and no multiple of any vector */

static float heights[WIDTH * HEIGHT];
static float ratios[WIDTH * HEIGHT * CHANNELS_MAX];
static bool  differs;

/* FNV-1a: any good mixing would do, this one is short. */
static uint64_t hash_bytes(const void *bytes, size_t size)
{
    uint64_t             hash = UINT64_C(0xcbf29ce484222325);
    const unsigned char *byte = bytes;
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ byte[i]) * UINT64_C(0x100000001b3);
    }
    return hash;
}

static void must(hc_result result, const hc_log *log)
{
    if (result != HC_OK) {
        (void)fprintf(stderr, "%s: %s\n", hc_result_name(result), log->text);
        exit(EXIT_FAILURE);
    }
}

static uint64_t hash_ratios(const hc_field *field, hc_cone_options options)
{
    hc_log       log   = { 0 };
    const size_t count = (size_t)(WIDTH * HEIGHT) * (size_t)hc_cones_channels(options.cones);
    must(hc_bake_cone_map(ratios, field, &options, &log), &log);
    return hash_bytes(ratios, count * sizeof *ratios);
}

static void print_cone_map(const char *name, const hc_field *field, hc_cones cones,
                           hc_method method)
{
    hc_cone_options options = {
        .cones = cones, .method = method, .isa = HC_ISA_SCALAR, .threads = 1, .gems_steps = 16
    };
    const uint64_t hash    = hash_ratios(field, options);
    const bool     kernels = method == HC_METHOD_EXACT || method == HC_METHOD_BRUTE;
    for (int isa = HC_ISA_SCALAR; isa <= (kernels ? HC_ISA_AVX512 : HC_ISA_SCALAR); isa++) {
        for (options.threads = 1; options.threads <= 3; options.threads += 2) {
            options.isa = (hc_isa)isa;
            if (hc_isa_resolve(options.isa) == options.isa && hash_ratios(field, options) != hash) {
                (void)fprintf(stderr, "%s %s %s: other bytes with %s, %d threads\n", name,
                              hc_cones_name(cones), hc_method_name(method),
                              hc_isa_name(options.isa), options.threads);
                differs = true;
            }
        }
    }
    (void)printf("%s wrap %s %s %s %016" PRIx64 "\n", name, hc_wrap_name(field->wrap),
                 hc_cones_name(cones), hc_method_name(method), hash);
}

static void print_cone_maps(const char *name, const hc_field *field)
{
    for (int cones = 0; hc_cones_channels((hc_cones)cones) > 0; cones++) {
        for (int method = 0; hc_method_name((hc_method)method) != NULL; method++) {
            if (hc_method_makes((hc_method)method, (hc_cones)cones)) {
                print_cone_map(name, field, (hc_cones)cones, (hc_method)method);
            }
        }
    }
}

static void print_map(const char *name, const hc_field *field, hc_map_options options)
{
    hc_log log = { 0 };
    hc_map map = { 0 };
    must(hc_map_info_for(&map.info, field, &options, &log), &log);
    const size_t size = hc_map_bytes(&map.info);
    map.texels        = malloc(size);
    if (map.texels == NULL) {
        (void)fprintf(stderr, "out of memory\n");
        exit(EXIT_FAILURE);
    }
    must(hc_bake_map(&map, field, &options, &log), &log);
    (void)printf("%s wrap %s map %s %s %d bits %016" PRIx64 "\n", name, hc_wrap_name(field->wrap),
                 hc_map_kind_name(map.info.kind), hc_layout_name(map.info.layout), map.info.bits,
                 hash_bytes(map.texels, size));
    free(map.texels);
}

static void print_maps(const char *name, const hc_field *field)
{
    print_map(name, field, (hc_map_options){ .layout = HC_LAYOUT_DUMMER });
    for (int bits = 8; bits <= 32; bits *= 2) {
        print_map(name, field, (hc_map_options){ .bits = bits });
        print_map(name, field, (hc_map_options){ .bits = bits, .cone.cones = HC_CONES_QUAD });
        print_map(name, field, (hc_map_options){ .bits = bits, .cone.cones = HC_CONES_ANISO });
        print_map(name, field, (hc_map_options){ .bits = bits, .kind = HC_MAP_PYRAMID });
        print_map(name, field, (hc_map_options){ .bits = bits, .kind = HC_MAP_BOUNDS });
        print_map(name, field, (hc_map_options){ .bits = bits, .kind = HC_MAP_GRADIENT });
    }
}

int main(void)
{
    hc_log   log   = { 0 };
    hc_field field = { .heights = heights, .width = WIDTH, .height = HEIGHT };
    for (int i = 0; i < hc_synth_count(); i++) {
        const char *name = hc_synth_name(i);
        must(hc_synth(heights, WIDTH, HEIGHT, name, 7, &log), &log);
        (void)printf("%s heights %016" PRIx64 "\n", name, hash_bytes(heights, sizeof heights));
        field.wrap = (hc_wrap)(i % 4);
        print_cone_maps(name, &field);
        print_maps(name, &field);
    }
    return differs ? EXIT_FAILURE : EXIT_SUCCESS;
}
