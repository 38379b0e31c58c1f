/* A file that is a field or a map, whichever it turns out to be. */
#ifndef HC_CLI_ANYFILE_H
#define HC_CLI_ANYFILE_H

#include "figures.h"

typedef struct hc_cli_anyfile {
    hc_file_info   info; /* all zero for standard input and raw samples */
    bool           is_map;
    hc_map         map;
    hc_field       field;
    int            width, height;
    int            channel_count;
    hc_cli_channel channels[HC_CLI_CHANNELS_MAX];
} hc_cli_anyfile;

/* Load `path` with the settings' options. Free with hc_cli_anyfile_free, whatever the result. */
hc_result hc_cli_anyfile_load(hc_cli_anyfile *file, hc_cli *cli, const char *path);
void      hc_cli_anyfile_free(hc_cli_anyfile *file);

size_t hc_cli_anyfile_texels(const hc_cli_anyfile *file); /* of all levels */
float  hc_cli_anyfile_value(const hc_cli_anyfile *file, int channel, size_t texel);

#endif
