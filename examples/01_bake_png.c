/* Load a height map, bake the exact cone map, save it as the RGBA texture of the 2006 paper.
 *
 * usage: 01_bake_png IN.png OUT.png */
#include <heightcast/heightcast.h>
#include <heightcast/io.h>

#include <stdio.h>
#include <stdlib.h>

static void print_warning(void *user, const char *line)
{
    (void)user;
    (void)fprintf(stderr, "warning: %s\n", line);
}

static hc_result bake_file(const char *in, const char *out, hc_log *log)
{
    hc_field  field;
    hc_result result = hc_load_field(&field, in, &(hc_load_options){ .wrap = HC_WRAP_UV }, log);
    if (result != HC_OK) {
        return result;
    }
    const hc_map_options options = { .layout = HC_LAYOUT_DUMMER };

    hc_map map = { 0 };
    result     = hc_map_info_for(&map.info, &field, &options, log);
    if (result == HC_OK) {
        map.texels = malloc(hc_map_bytes(&map.info));
        result = map.texels != NULL ? hc_bake_map(&map, &field, &options, log) : HC_ERROR_MEMORY;
    }
    if (result == HC_OK) {
        result = hc_save_map(&map, out, &(hc_save_options){ .overwrite = true }, log);
    }
    free(map.texels);
    hc_free_field(&field);
    return result;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        (void)fprintf(stderr, "usage: %s IN.png OUT.png\n", argv[0]);
        return EXIT_FAILURE;
    }
    hc_log          log    = { .warn = print_warning };
    const hc_result result = bake_file(argv[1], argv[2], &log);
    if (result != HC_OK) {
        (void)fprintf(stderr, "%s: %s\n", hc_result_name(result), log.text);
        return EXIT_FAILURE;
    }
    (void)printf("%s is baked into %s\n", argv[1], argv[2]);
    return EXIT_SUCCESS;
}
