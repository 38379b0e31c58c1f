/* Write one of each kind of file, and beside it the samples that other readers should find in it:
 *   NAME.ENDING   as the library writes it
 *   NAME.samples  rows from the top, channels interleaved, little-endian, all levels in turn
 * With two maps as arguments instead of a folder: compare what the library reads from them. */
#include <heightcast/io.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 37, HEIGHT = 21, PATH_SIZE = 4096 };

static void require(hc_result result, const hc_log *log)
{
    if (result != HC_OK) {
        (void)fprintf(stderr, "write_samples: %s\n", log->text);
        exit(1);
    }
}

static void write_bytes(const char *folder, const char *name, const void *bytes, size_t size)
{
    char path[PATH_SIZE];
    (void)snprintf(path, sizeof path, "%s/%s.samples", folder, name);
    FILE *file = fopen(path, "wb");
    if (file == NULL || fwrite(bytes, 1, size, file) != size || fclose(file) != 0) {
        perror(path);
        exit(1);
    }
}

static void write_field(const char *folder, int bits, const char *const *endings)
{
    static float    heights[WIDTH * HEIGHT];
    static uint8_t  codes8[WIDTH * HEIGHT];
    static uint16_t codes16[WIDTH * HEIGHT];
    const void     *samples = bits == 8 ? (void *)codes8 : bits == 16 ? (void *)codes16 : heights;
    char            name[32];
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int code = 1000 + 37 * (i % WIDTH) + 411 * (i / WIDTH);
        codes16[i]     = (uint16_t)code;
        codes8[i]      = (uint8_t)(code / 64);
        heights[i]     = bits == 8 ? (float)(codes8[i] / 255.0) : (float)(code / 65535.0);
    }
    (void)snprintf(name, sizeof name, "field%d", bits);
    write_bytes(folder, name, samples, (size_t)(WIDTH * HEIGHT * bits / 8));
    const hc_field field = { .heights   = heights,
                             .width     = WIDTH,
                             .height    = HEIGHT,
                             .elevation = { .low         = 236.0,
                                            .high        = 1076.0,
                                            .spacing_x   = 92.5,
                                            .spacing_y   = 74.5,
                                            .placed      = true,
                                            .origin_x    = 1000.0,
                                            .origin_y    = 2000.0,
                                            .has_nodata  = true,
                                            .nodata      = -9999.0,
                                            .source_bits = 16,
                                            .unit        = "m" } };
    for (int i = 0; endings[i] != NULL; i++) {
        char   path[PATH_SIZE];
        hc_log log = { .text = "" };
        (void)snprintf(path, sizeof path, "%s/%s%s", folder, name, endings[i]);
        require(hc_save_field(&field, path, &(hc_save_options){ true, bits, 0 }, &log), &log);
    }
}

static void write_map(const char *folder, const char *name, hc_map_info info,
                      const char *const *endings)
{
    info.width        = WIDTH;
    info.height       = HEIGHT;
    info.channels     = hc_layout_channels(info.layout);
    info.levels       = info.kind == HC_MAP_PYRAMID ? hc_pyramid_levels(WIDTH, HEIGHT) : 1;
    const size_t size = hc_map_bytes(&info);
    hc_map       map  = { .info = info, .texels = malloc(size) };
    if (map.texels == NULL) {
        exit(1);
    }
    for (size_t i = 0; i < size; i++) {
        ((uint8_t *)map.texels)[i] = (uint8_t)(i * 37 % 251);
    }
    for (size_t i = 0; info.bits == 32 && i < size / sizeof(float); i++) {
        ((float *)map.texels)[i] = (float)(i % 4096) / 4096.0F;
    }
    write_bytes(folder, name, map.texels, size);
    for (int i = 0; endings[i] != NULL; i++) {
        char   path[PATH_SIZE];
        hc_log log = { .text = "" };
        (void)snprintf(path, sizeof path, "%s/%s%s", folder, name, endings[i]);
        require(hc_save_map(&map, path, &(hc_save_options){ .overwrite = true }, &log), &log);
    }
    free(map.texels);
}

static int compare(const char *first, const char *second)
{
    hc_map maps[2];
    hc_log log = { .text = "" };
    require(hc_load_map(&maps[0], first, NULL, &log), &log);
    require(hc_load_map(&maps[1], second, NULL, &log), &log);
    const size_t size = hc_map_bytes(&maps[0].info);
    const bool   same =
        size == hc_map_bytes(&maps[1].info) && memcmp(maps[0].texels, maps[1].texels, size) == 0;
    hc_free_map(&maps[0]);
    hc_free_map(&maps[1]);
    return same ? 0 : 1;
}

int main(int count, char **arguments)
{
    static const char *const codes[]  = { ".png", ".tif", ".pgm", ".npy", NULL };
    static const char *const floats[] = { ".tif", ".exr", ".pfm", ".npy", NULL };
    static const char *const texels[] = { ".png", ".tif", ".npy", ".ktx2", ".dds", NULL };
    static const char *const real[]   = { ".exr", ".tif", ".npy", ".ktx2", ".dds", NULL };
    static const char *const levels[] = { ".tif", ".ktx2", ".dds", NULL };
    const hc_map_info dummer = { .layout = HC_LAYOUT_DUMMER, .max_ratio = 1.0F, .method = "exact" };
    const hc_map_info rg     = { .layout = HC_LAYOUT_RG, .max_ratio = 4.0F, .method = "exact" };
    const hc_map_info height = { .layout = HC_LAYOUT_HEIGHT };
    const hc_map_info quad   = { .layout = HC_LAYOUT_QUAD, .cones = HC_CONES_QUAD };
    const hc_map_info pyramid = { .kind = HC_MAP_PYRAMID, .layout = HC_LAYOUT_MINMAX };
    if (count == 3) {
        return compare(arguments[1], arguments[2]);
    }
    if (count != 2) {
        (void)fprintf(stderr, "usage: write_samples FOLDER | write_samples MAP MAP\n");
        return 1;
    }
    write_field(arguments[1], 8, codes);
    write_field(arguments[1], 16, codes);
    write_field(arguments[1], 32, floats);
    hc_map_info info = dummer;
    info.bits        = 8;
    write_map(arguments[1], "dummer8", info, texels);
    info      = height;
    info.bits = 8;
    write_map(arguments[1], "height8", info, texels);
    for (info = rg, info.bits = 8; info.bits <= 32; info.bits *= 2) {
        char name[32];
        (void)snprintf(name, sizeof name, "rg%d", info.bits);
        write_map(arguments[1], name, info, info.bits == 32 ? real : texels);
    }
    info      = quad;
    info.bits = 32;
    write_map(arguments[1], "quad32", info, real);
    for (info = pyramid, info.bits = 8; info.bits <= 32; info.bits *= 2) {
        char name[32];
        (void)snprintf(name, sizeof name, "pyramid%d", info.bits);
        write_map(arguments[1], name, info, levels);
    }
    return 0;
}
