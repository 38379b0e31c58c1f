#include "objects.h"

#include "options.h"
#include "textfile.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WORDS_MIN = 5, WORDS_MAX = 9, OBJECTS_MAX = 100000 };

/* ---- meshes ---------------------------------------------------------------------------------- */

/* The name of a body, else a file: beside the one that names it, unless it is absolute. */
static hc_result make_mesh(hc_mesh **mesh, hc_cli *cli, const char *what)
{
    const char  *list   = cli->settings.terrain.objects;
    const char  *slash  = strrchr(list, '/');
    const size_t folder = slash != NULL && what[0] != '/' ? (size_t)(slash - list) + 1 : 0;
    char         path[4096];
    for (int i = 0; hc_solid_name((hc_solid)i) != NULL; i++) {
        if (strcmp(what, hc_solid_name((hc_solid)i)) == 0) {
            return hc_solid_create(mesh, (hc_solid)i, &cli->log);
        }
    }
    if (folder + strlen(what) >= sizeof path) {
        (void)snprintf(cli->log.text, sizeof cli->log.text, "%s: the name is too long", list);
        return HC_ERROR_IO;
    }
    memcpy(path, list, folder);
    memcpy(path + folder, what, strlen(what) + 1);
    return hc_load_mesh(mesh, path, &cli->settings.load.limits, &cli->log);
}

/* ---- lines ----------------------------------------------------------------------------------- */

/* "12.5", "ground" or "ground+12.5" */
static bool take_height(hc_object *object, const char *word)
{
    static const char ground[] = "ground";
    const size_t      length   = sizeof ground - 1;
    object->grounded           = strncmp(word, ground, length) == 0;
    if (!object->grounded) {
        return hc_cli_word_number(&object->place[2], word);
    }
    return word[length] == '\0'
           || (word[length] == '+' && hc_cli_word_number(&object->place[2], word + length + 1));
}

static bool take_words(hc_object *object, char **words, int count)
{
    double colour[3] = { 0.0, 0.0, 0.0 };
    bool   good      = hc_cli_word_number(&object->place[0], words[1])
                && hc_cli_word_number(&object->place[1], words[2]) && take_height(object, words[3])
                && hc_cli_word_number(&object->size, words[4]) && object->size > 0.0;
    good = good && (count < 6 || hc_cli_word_number(&object->turn, words[5]));
    for (int k = 0; k < 3 && count == WORDS_MAX; k++) {
        good = good && hc_cli_word_number(&colour[k], words[6 + k]) && colour[k] >= 0.0
               && colour[k] <= 1.0;
        object->colour[k] = (float)colour[k];
    }
    return good && (count <= 6 || count == WORDS_MAX);
}

static bool grow(hc_cli_objects *o)
{
    const size_t room = 2 * (size_t)o->count + 8;
    if (o->objects != NULL && (o->count < 8 || (o->count & (o->count - 1)) != 0)) {
        return true; /* there is room up to the next power of two */
    }
    hc_object *objects = realloc(o->objects, room * sizeof *objects);
    o->objects         = objects != NULL ? objects : o->objects;
    hc_mesh **meshes   = realloc(o->meshes, room * sizeof *meshes);
    o->meshes          = meshes != NULL ? meshes : o->meshes;
    return objects != NULL && meshes != NULL;
}

static const char *solid_words(int index)
{
    return hc_solid_name((hc_solid)index);
}

static int take_line(void *user, hc_cli *cli, char **words, int count, int line)
{
    hc_cli_objects *o      = user;
    hc_object       object = { .size = 0.0 };
    const char     *path   = cli->settings.terrain.objects;
    if (count < WORDS_MIN || !take_words(&object, words, count)) {
        return hc_cli_fail(
            cli, HC_CLI_BAD_FILE,
            "%s, line %d: an object is a body or a file, x, y, z, a size above 0, and "
            "then a turn in degrees, and then a colour of 3 numbers from 0 to 1",
            path, line);
    }
    if (o->count == OBJECTS_MAX) {
        return hc_cli_fail(cli, HC_CLI_MEMORY, "%s: more than %d objects", path, OBJECTS_MAX);
    }
    if (!grow(o)) {
        return hc_cli_fail_memory(cli);
    }
    const hc_result result = make_mesh(&o->meshes[o->count], cli, words[0]);
    if (result == HC_ERROR_IO) { /* a body's name, perhaps */
        char known[64];
        hc_cli_join_words(known, sizeof known, solid_words, ", ");
        return hc_cli_fail(cli, HC_CLI_INPUT_OUTPUT, "%s, line %d: %s; bodies are %s", path, line,
                           cli->log.text, known);
    }
    if (result != HC_OK) {
        return hc_cli_fail_result(cli, result);
    }
    object.mesh            = o->meshes[o->count];
    o->objects[o->count++] = object;
    return HC_CLI_DONE;
}

int hc_cli_objects_load(hc_cli_objects *objects, hc_cli *cli)
{
    *objects = (hc_cli_objects){ .count = 0 };
    return cli->settings.terrain.objects == NULL
               ? HC_CLI_DONE
               : hc_cli_read_lines(cli, cli->settings.terrain.objects, take_line, objects);
}

void hc_cli_objects_free(hc_cli_objects *objects)
{
    for (int i = 0; i < objects->count; i++) {
        hc_mesh_destroy(objects->meshes[i]);
    }
    free(objects->meshes);
    free(objects->objects);
}
