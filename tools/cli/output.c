#include "output.h"

#include "interrupt.h"

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
    const bool there = lstat(path, &status) == 0;
    if (!there && errno != ENOENT) {
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "cannot write %s: %s", path, strerror(errno));
    }
    const bool leads_nowhere = there && S_ISLNK(status.st_mode) && stat(path, &status) != 0;
    if (there && !leads_nowhere && !S_ISREG(status.st_mode)) {
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT,
                           "%s is not a regular file; name another output", path);
    }
    if (there && !cli->settings.save.overwrite) {
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "%s exists; --overwrite replaces it", path);
    }
    if (!directory_of(path, directory, sizeof directory)) {
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "%s: the name is too long", path);
    }
    if (access(directory, W_OK) != 0) {
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "cannot write %s: %s", path, strerror(errno));
    }
    return HC_CLI_DONE;
}

static const char *name_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash == NULL ? path : slash + 1;
}

int hc_cli_check_apart(hc_cli *cli, const char *first, const char *a, const char *second,
                       const char *b)
{
    char        folder_a[4096];
    char        folder_b[4096];
    struct stat x;
    struct stat y;
    if (a == NULL || b == NULL || strcmp(name_of(a), name_of(b)) != 0
        || !directory_of(a, folder_a, sizeof folder_a)
        || !directory_of(b, folder_b, sizeof folder_b) || stat(folder_a, &x) != 0
        || stat(folder_b, &y) != 0 || x.st_dev != y.st_dev || x.st_ino != y.st_ino) {
        return HC_CLI_DONE;
    }
    return hc_cli_fail(cli, HC_CLI_USAGE, "--%s and --%s are the same file, %s", first, second, a);
}

double hc_cli_file_bytes(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 ? (double)status.st_size : 0.0;
}

int hc_cli_write_text(hc_cli *cli, const char *path, const char *text)
{
    char      temporary[4096];
    const int folder = (int)(name_of(path) - path);
    if (snprintf(temporary, sizeof temporary, "%.*sheightcast-%ld.tmp", folder, path,
                 (long)getpid())
        >= (int)sizeof temporary) {
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "%s: the name is too long", path);
    }
    hc_cli_defer_signals(true);
    FILE *file       = fopen(temporary, "wx"); /* not into what is somebody else's */
    bool  good       = file != NULL && fputs(text, file) >= 0;
    good             = file != NULL && fclose(file) == 0 && good;
    good             = good && rename(temporary, path) == 0;
    const int reason = errno;
    if (!good && file != NULL) {
        (void)remove(temporary);
    }
    hc_cli_defer_signals(false);
    return good ? HC_CLI_DONE
                : hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "cannot write %s: %s", path,
                              strerror(reason));
}

int hc_cli_check_picture(hc_cli *cli, const char *option, const char *path)
{
    const hc_container *container = hc_container_of(path);
    if (container == NULL || strcmp(container->name, "PNG") != 0) {
        return hc_cli_fail(cli, HC_CLI_USAGE, "--%s %s: the ending must be .png", option, path);
    }
    return hc_cli_check_output(cli, path);
}
