/* What stands in a landscape: a text file, an object on each line. */
#ifndef HC_CLI_OBJECTS_H
#define HC_CLI_OBJECTS_H

#include "cli.h"

#include <heightcast/terrain.h>

typedef struct hc_cli_objects {
    hc_object *objects;
    hc_mesh  **meshes; /* of each, or of one before */
    int        count;
} hc_cli_objects;

/* Read --objects if there is one. Returns the exit code. hc_cli_objects_free must follow, whatever
 * it is. */
int  hc_cli_objects_load(hc_cli_objects *objects, hc_cli *cli);
void hc_cli_objects_free(hc_cli_objects *objects);

#endif
