/* Triangle meshes from Wavefront OBJ: vertices and faces. */
#include "io_internal.h"

#include "base/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct parser {
    const hc_source *source;
    const char      *text, *end; /* of the file, which ends with '\0' */
    hc_mesh         *mesh;       /* NULL while vertices and triangles are counted */
    int64_t          vertices, triangles;
    int64_t          line;
} parser;

static hc_result bad(const parser *p, const char *what, hc_log *log)
{
    return hc_fail(log, HC_ERROR_FORMAT, "%s, line %lld: %s", p->source->name, (long long)p->line,
                   what);
}

static const char *skip_blanks(const char *at)
{
    while (*at == ' ' || *at == '\t') {
        at++;
    }
    return at;
}

static bool ends_line(const char *at)
{
    return *at == '\0' || *at == '\n' || *at == '\r' || *at == '#';
}

/* ---- lines --------------------------------------------------------------------------------- */

static hc_result take_vertex(parser *p, const char *at, hc_log *log)
{
    for (int k = 0; k < 3; k++) {
        char *stop        = NULL;
        at                = skip_blanks(at);
        const float value = ends_line(at) ? NAN : (float)hc_parse_number(at, &stop);
        if (!isfinite(value) || stop == at) {
            return bad(p, "a vertex is three finite numbers", log);
        }
        if (p->mesh != NULL) {
            p->mesh->vertices[3 * p->vertices + k] = value;
        }
        at = stop;
    }
    p->vertices++;
    return HC_OK;
}

/* One corner, "3", "3/1", "3//2" or "-1", which counts back: the index of its vertex, or -1. */
static int32_t take_corner(const parser *p, const char **at)
{
    const bool back  = **at == '-';
    int64_t    index = 0;
    *at += back ? 1 : 0;
    const char *first = *at;
    while (**at >= '0' && **at <= '9' && index <= HC_MESH_MAX) {
        index = 10 * index + (*(*at)++ - '0');
    }
    const bool whole = *at > first;
    *at += strcspn(*at, " \t\r\n"); /* texture coordinates and normals */
    index = back ? p->vertices - index : index - 1;
    return whole && index >= 0 && index < p->vertices ? (int32_t)index : -1;
}

/* A polygon is a fan of triangles. */
static hc_result take_face(parser *p, const char *at, hc_log *log)
{
    int32_t first = -1, before = -1;
    int64_t corners = 0;
    for (at = skip_blanks(at); !ends_line(at); at = skip_blanks(at), corners++) {
        const int32_t corner = take_corner(p, &at);
        if (corner < 0) {
            return bad(p, "a face is of indices of vertices that stand before it", log);
        }
        if (corners >= 2 && p->mesh != NULL) {
            const int32_t triangle[3] = { first, before, corner };
            memcpy(p->mesh->triangles + 3 * p->triangles, triangle, sizeof triangle);
        }
        p->triangles += corners >= 2 ? 1 : 0;
        first  = corners == 0 ? corner : first;
        before = corner;
    }
    return corners >= 3 ? HC_OK : bad(p, "a face has three corners at least", log);
}

static hc_result take_lines(parser *p, hc_log *log)
{
    hc_result result = HC_OK;
    p->vertices      = 0;
    p->triangles     = 0;
    p->line          = 1;
    for (const char *at = p->text; result == HC_OK && at < p->end; p->line++) {
        const char *word = skip_blanks(at);
        if (word[0] == 'v' && (word[1] == ' ' || word[1] == '\t')) {
            result = take_vertex(p, word + 1, log);
        } else if (word[0] == 'f' && (word[1] == ' ' || word[1] == '\t')) {
            result = take_face(p, word + 1, log);
        }
        const char *next = memchr(at, '\n', (size_t)(p->end - at));
        at               = next != NULL ? next + 1 : p->end;
    }
    return result;
}

/* ---- files --------------------------------------------------------------------------------- */

static hc_result read_text(char **text, const hc_source *source, hc_log *log)
{
    *text = malloc((size_t)source->size + 1);
    if (*text == NULL) {
        return hc_fail(log, HC_ERROR_MEMORY, "%s: no memory for %llu bytes", source->name,
                       (unsigned long long)source->size);
    }
    (*text)[source->size] = '\0';
    return hc_source_need(source, 0, *text, (size_t)source->size, log);
}

static hc_result take_mesh(parser *p, hc_log *log)
{
    hc_result result = take_lines(p, log);
    if (result != HC_OK) {
        return result;
    }
    if (p->triangles == 0) {
        return hc_fail(log, HC_ERROR_FORMAT, "%s: there is no face in it", p->source->name);
    }
    if (p->vertices > HC_MESH_MAX || p->triangles > HC_MESH_MAX) {
        return hc_fail(log, HC_ERROR_LIMIT, "%s: %lld vertices and %lld triangles; at most %d",
                       p->source->name, (long long)p->vertices, (long long)p->triangles,
                       HC_MESH_MAX);
    }
    result = hc_mesh_create(&p->mesh, (int)p->vertices, (int)p->triangles, log);
    return result == HC_OK ? take_lines(p, log) : result;
}

hc_result hc_load_mesh_source(hc_mesh **mesh, const hc_source *source, hc_log *log)
{
    char     *text   = NULL;
    hc_result result = read_text(&text, source, log);
    parser    p      = { .source = source, .text = text };
    *mesh            = NULL;
    if (result == HC_OK) {
        p.end  = text + source->size;
        result = take_mesh(&p, log);
    }
    if (result == HC_OK) {
        *mesh = p.mesh;
    } else {
        hc_mesh_destroy(p.mesh);
    }
    free(text);
    return result;
}

hc_result hc_load_mesh(hc_mesh **mesh, const char *path, const hc_limits *limits, hc_log *log)
{
    hc_source source;
    hc_result result = hc_source_open(&source, path, limits, log);
    *mesh            = NULL;
    if (result == HC_OK) {
        result = hc_load_mesh_source(mesh, &source, log);
    }
    hc_source_close(&source);
    return result;
}
