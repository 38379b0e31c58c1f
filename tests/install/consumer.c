/* Writes a made field and reads it back: needs both libraries and what they need. */
#include <heightcast/heightcast.h>
#include <heightcast/io.h>

#include <stdio.h>
#include <string.h>

int main(void)
{
    static float          heights[64 * 64];
    const hc_field        field   = { .heights = heights, .width = 64, .height = 64 };
    const hc_save_options options = { .overwrite = true };
    hc_log                log     = { 0 };
    hc_field              read    = { 0 };
    if (hc_synth(heights, 64, 64, "noise", 1, &log) != HC_OK
        || hc_save_field(&field, "consumer.exr", &options, &log) != HC_OK
        || hc_load_field(&read, "consumer.exr", NULL, &log) != HC_OK) {
        (void)fprintf(stderr, "%s\n", log.text);
        return 1;
    }
    hc_free_field(&read);
    return strcmp(hc_version(), HC_VERSION_STRING) != 0;
}
