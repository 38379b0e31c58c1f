/* libFuzzer target of the OBJ reader. Beyond not crashing: what is accepted must be a valid mesh,
 * and an error names the file. */
#include "io/io_internal.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);

static void require(bool condition)
{
    if (!condition) {
        abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    const hc_limits limits = { .max_bytes = 1 << 22 };
    const hc_source source = hc_source_memory(bytes, size, "fuzz", &limits);
    hc_log          log    = { .text = "" };
    hc_mesh        *mesh   = NULL;
    const hc_result result = hc_load_mesh_source(&mesh, &source, &log);
    require((result == HC_OK) == (mesh != NULL));
    require(result == HC_OK ? hc_mesh_check(mesh, NULL) == HC_OK
                            : strstr(log.text, "fuzz") != NULL);
    require(strchr(log.text, '\n') == NULL);
    hc_mesh_destroy(mesh);
    return 0;
}
