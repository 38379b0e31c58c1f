#include "anyfile.h"

#include <string.h>

static hc_result load_map(hc_cli_anyfile *file, hc_cli *cli, const char *path)
{
    const hc_result result = hc_load_map(&file->map, path, &cli->settings.load.limits, &cli->log);
    if (result == HC_OK) {
        file->is_map        = true;
        file->width         = file->map.info.width;
        file->height        = file->map.info.height;
        file->channel_count = hc_cli_map_channels(file->channels, &file->map.info);
    }
    return result;
}

static hc_result load_field(hc_cli_anyfile *file, hc_cli *cli, const char *path)
{
    const hc_result result = hc_load_field(&file->field, path, &cli->settings.load, &cli->log);
    if (result == HC_OK) {
        file->width         = file->field.width;
        file->height        = file->field.height;
        file->channel_count = 1;
        file->channels[0]   = (hc_cli_channel){ .name = "height", .cone = -1 };
    }
    return result;
}

hc_result hc_cli_anyfile_load(hc_cli_anyfile *file, hc_cli *cli, const char *path)
{
    const hc_load_options *load = &cli->settings.load;
    *file                       = (hc_cli_anyfile){ 0 };
    /* Standard input can be read once only, and raw samples have no header. */
    if (strcmp(path, "-") != 0 && load->raw_width == 0) {
        const hc_result result = hc_read_file_info(&file->info, path, &load->limits, &cli->log);
        if (result != HC_OK) {
            return result;
        }
    }
    return file->info.has_map ? load_map(file, cli, path) : load_field(file, cli, path);
}

void hc_cli_anyfile_free(hc_cli_anyfile *file)
{
    hc_free_map(&file->map);
    hc_free_field(&file->field);
}

size_t hc_cli_anyfile_texels(const hc_cli_anyfile *file)
{
    return file->is_map ? hc_cli_map_texels(&file->map.info)
                        : (size_t)file->width * (size_t)file->height;
}

float hc_cli_anyfile_value(const hc_cli_anyfile *file, int channel, size_t texel)
{
    return file->is_map ? hc_cli_map_value(&file->map, &file->channels[channel], texel)
                        : file->field.heights[texel];
}
