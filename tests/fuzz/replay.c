/* Run a fuzz target on each file of the folders that are named: `make test` keeps what fuzzing
 * found. */
#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

enum { PATH_SIZE = 4096, FILE_MAX = 1 << 20 };

static int replay_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) {
        perror(path);
        return 1;
    }
    uint8_t     *whole = malloc(FILE_MAX);
    const size_t size  = whole != NULL ? fread(whole, 1, FILE_MAX, file) : 0;
    (void)fclose(file);
    /* of the exact size, so that sanitizers see a read beyond the end */
    uint8_t *bytes = realloc(whole, size > 0 ? size : 1);
    if (bytes == NULL) {
        free(whole);
        return 1;
    }
    (void)LLVMFuzzerTestOneInput(bytes, size);
    free(bytes);
    return 0;
}

static int replay_folder(const char *folder)
{
    DIR *listing = opendir(folder);
    int  failed  = listing == NULL;
    int  files   = 0;
    for (struct dirent *entry = failed ? NULL : readdir(listing); entry != NULL;
         entry                = readdir(listing)) {
        char path[PATH_SIZE];
        if (entry->d_name[0] != '.') {
            (void)snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
            failed |= replay_file(path);
            files++;
        }
    }
    if (listing != NULL) {
        (void)closedir(listing);
    }
    printf("%s: %d files\n", folder, files);
    return failed != 0 || files == 0;
}

int main(int count, char **folders)
{
    int failed = count < 2;
    for (int i = 1; i < count; i++) {
        failed |= replay_folder(folders[i]);
    }
    return failed;
}
