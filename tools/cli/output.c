#include "output.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int hc_cli_container_bits(const hc_container *container, hc_cli_content content)
{
    switch (content) {
    case HC_CLI_FIELD: return container->field_bits;
    case HC_CLI_MAP: return container->map_bits;
    case HC_CLI_PYRAMID: break;
    }
    return container->levels ? container->map_bits : 0;
}

void hc_cli_list_endings(char *text, size_t size, hc_cli_content content, int bits)
{
    size_t used = 0;
    text[0]     = '\0';
    for (int i = 0; hc_container_at(i) != NULL && used < size; i++) {
        const hc_container *container = hc_container_at(i);
        if ((hc_cli_container_bits(container, content) & bits) != 0) {
            const int wrote = snprintf(text + used, size - used, "%s%s", used == 0 ? "" : ", ",
                                       container->endings[0]);
            used += wrote > 0 ? (size_t)wrote : 0;
        }
    }
}

/* The directory part of `path`; false if it is longer than any path may be. */
static bool directory_of(const char *path, char *directory, size_t size)
{
    const char  *slash  = strrchr(path, '/');
    const size_t length = slash == NULL ? 0 : (size_t)(slash - path) + 1;
    if (length + 2 > size) {
        return false;
    }
    memcpy(directory, path, length);
    memcpy(directory + length, ".", 2);
    return true;
}

/* The library checks again when it writes, this only saves the wait. */
int hc_cli_check_output(hc_cli *cli, const char *path)
{
    struct stat status;
    char        directory[4096];
    if (strcmp(path, "-") == 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE,
                           "an output cannot be standard output; give the name of a file");
    }
    if (stat(path, &status) == 0) {
        if (!S_ISREG(status.st_mode)) {
            return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "%s is not a regular file", path);
        }
        if (!cli->settings.save.overwrite) {
            return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "%s exists; --overwrite replaces it",
                               path);
        }
    }
    if (!directory_of(path, directory, sizeof directory)) {
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "%s: the name is too long", path);
    }
    if (access(directory, W_OK) != 0) {
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "cannot write %s: %s", path, strerror(errno));
    }
    return HC_CLI_DONE;
}

double hc_cli_file_bytes(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 ? (double)status.st_size : 0.0;
}

int hc_cli_write_text(hc_cli *cli, const char *path, const char *text)
{
    char temporary[4096];
    if (snprintf(temporary, sizeof temporary, "%s.part", path) >= (int)sizeof temporary) {
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "%s: the name is too long", path);
    }
    FILE *file = fopen(temporary, "w");
    bool  good = file != NULL && fputs(text, file) >= 0;
    good       = file != NULL && fclose(file) == 0 && good;
    if (!good || rename(temporary, path) != 0) {
        const int reason = errno;
        (void)remove(temporary);
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "cannot write %s: %s", path, strerror(reason));
    }
    return HC_CLI_DONE;
}

int hc_cli_check_picture(hc_cli *cli, const char *option, const char *path)
{
    const hc_container *container = hc_container_of(path);
    if (container == NULL || strcmp(container->name, "PNG") != 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--%s %s: the ending must be .png", option, path);
    }
    return hc_cli_check_output(cli, path);
}
