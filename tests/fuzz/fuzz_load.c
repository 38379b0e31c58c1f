/* libFuzzer target of a file reader, or with HC_FUZZ_ENDING empty of everything that takes any
 * file. Beyond not crashing: what is accepted must be a valid field or map, within the limits. */
#include "base/fail.h"
#include "io/io_internal.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static const hc_limits limits = { .max_samples = 1 << 18, .max_bytes = 1 << 22 };

static void require(bool condition)
{
    if (!condition) {
        abort();
    }
}

/* An error comes with one line that names the file, and leaves nothing to free. */
static void require_report(hc_result result, const void *left, const hc_log *log)
{
    require(result == HC_OK || (left == NULL && strstr(log->text, "fuzz") != NULL));
    require(strchr(log->text, '\n') == NULL);
}

static void read_one(const hc_format *format, const hc_source *source)
{
    hc_log          log    = { .text = "" };
    hc_image        image  = { .levels = 1 };
    hc_image        header = { .levels = 1 };
    const hc_result result = format->read(&image, source, false, &log);
    if (result == HC_OK) {
        require(image.data != NULL && hc_image_samples(&image) <= limits.max_samples);
        require(format->read(&header, source, true, &log) == HC_OK);
        require(header.data == NULL && header.width == image.width && header.height == image.height
                && header.channels == image.channels && header.type == image.type);
    }
    hc_image_free(&image);
}

static void load_all(const hc_source *source)
{
    const hc_load_options options = { .normalise.holes = HC_HOLES_FILL };
    hc_log                log     = { .text = "" };
    hc_field              field;
    hc_map                map;
    hc_file_info          info;
    hc_result             result = hc_load_field_source(&field, source, &options, &log);
    require_report(result, field.heights, &log);
    require(result != HC_OK || hc_field_check(&field, NULL) == HC_OK);
    hc_free_field(&field);

    log    = (hc_log){ .text = "" };
    result = hc_load_map_source(&map, source, &log);
    require_report(result, map.texels, &log);
    if (result == HC_OK) {
        require(hc_map_info_check(&map.info, NULL) == HC_OK);
        (void)hc_map_height_at(&map, map.info.width - 1, map.info.height - 1);
    }
    hc_free_map(&map);

    log = (hc_log){ .text = "" };
    require_report(hc_read_source_info(&info, source, &log), NULL, &log);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    const hc_source  source = hc_source_memory(bytes, size, "fuzz", &limits);
    const hc_format *format = hc_format_by_ending("x" HC_FUZZ_ENDING);
    if (format == NULL) {
        load_all(&source);
    } else if (format->recognise(bytes, size)) {
        read_one(format, &source);
    }
    return 0;
}
