#include "polygons.h"

#include "base/fail.h"
#include "gl/context.h"

#include <epoxy/gl.h>

#include <stdint.h>
#include <stdlib.h>

/* Vertices as ground.vert numbers them: those of a block, row by row, then those of its hem, edge
 * by edge: top, right, bottom, left. */
enum { ALONG = HC_BLOCK_SIDE + 1, INNER = ALONG * ALONG, EDGES = 4 };
/* At the finest level: two triangles for each square, and for each piece of the hem. */
enum { CORNERS_MAX = 2 * 6 * (HC_BLOCK_SIDE * HC_BLOCK_SIDE + EDGES * HC_BLOCK_SIDE) };

static int add_square(uint16_t *corners, int a, int b, int c, int d)
{
    const int all[6] = { a, b, c, b, d, c };
    for (int i = 0; i < 6; i++) {
        corners[i] = (uint16_t)all[i];
    }
    return 6;
}

static int add_level(uint16_t *corners, int step)
{
    int count = 0;
    for (int y = 0; y < HC_BLOCK_SIDE; y += step) {
        for (int x = 0; x < HC_BLOCK_SIDE; x += step) {
            const int at = y * ALONG + x;
            count += add_square(&corners[count], at, at + step, at + step * ALONG,
                                at + step * ALONG + step);
        }
    }
    return count;
}

static int add_hem(uint16_t *corners, int step)
{
    static const int first[EDGES]  = { 0, HC_BLOCK_SIDE, INNER - ALONG, 0 };
    static const int stride[EDGES] = { 1, ALONG, 1, ALONG };
    int              count         = 0;
    for (int edge = 0; edge < EDGES; edge++) {
        for (int k = 0; k < HC_BLOCK_SIDE; k += step) {
            const int at  = first[edge] + k * stride[edge];
            const int low = INNER + edge * ALONG + k;
            count += add_square(&corners[count], at, at + step * stride[edge], low, low + step);
        }
    }
    return count;
}

/* The finest have no hem where all are fine. */
static void fill_corners(uint16_t *corners, hc_gl_polygons *polygons, bool lod)
{
    int count = 0;
    for (int level = 0; level < HC_BLOCK_LEVELS; level++) {
        polygons->firsts[level] = count;
        count += add_level(&corners[count], 1 << level);
        count += lod ? add_hem(&corners[count], 1 << level) : 0;
    }
    polygons->firsts[HC_BLOCK_LEVELS] = count;
}

static void load_corners(hc_gl_polygons *polygons, const uint16_t *corners)
{
    const size_t bytes = (size_t)polygons->firsts[HC_BLOCK_LEVELS] * sizeof *corners;
    glGenVertexArrays(1, &polygons->array);
    glBindVertexArray(polygons->array);
    glGenBuffers(1, &polygons->corners);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, polygons->corners);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)bytes, corners, GL_STATIC_DRAW);
    glGenBuffers(1, &polygons->instances);
    glBindBuffer(GL_ARRAY_BUFFER, polygons->instances);
    glEnableVertexAttribArray(0);
    glVertexAttribDivisor(0, 1);
}

hc_result hc_polygons_make(hc_gl_polygons *polygons, const hc_terrain *terrain, hc_log *log)
{
    *polygons        = (hc_gl_polygons){ .places = NULL };
    hc_result result = hc_blocks_make(&polygons->blocks, terrain, log);
    if (result != HC_OK) {
        return result;
    }
    const size_t count   = (size_t)polygons->blocks.columns * (size_t)polygons->blocks.rows;
    uint16_t    *corners = malloc(CORNERS_MAX * sizeof *corners);
    polygons->places     = malloc(count * sizeof *polygons->places);
    if (corners == NULL || polygons->places == NULL) {
        free(corners);
        return hc_fail(log, HC_ERROR_MEMORY, "no memory for %zu blocks of triangles", count);
    }
    fill_corners(corners, polygons, terrain->scene.polygons == HC_POLYGONS_LOD);
    load_corners(polygons, corners);
    free(corners);
    return hc_gl_check("triangles of the ground", log);
}

void hc_polygons_free(hc_gl_polygons *polygons)
{
    glDeleteVertexArrays(1, &polygons->array);
    glDeleteBuffers(1, &polygons->corners);
    glDeleteBuffers(1, &polygons->instances);
    hc_blocks_free(&polygons->blocks);
    free(polygons->places);
}

void hc_polygons_aim(hc_gl_polygons *polygons, const hc_terrain *terrain, const hc_eye *eye)
{
    int count = 0;
    hc_blocks_choose(polygons->places, polygons->counts, &polygons->blocks, terrain, eye,
                     terrain->scene.polygons == HC_POLYGONS_LOD);
    for (int level = 0; level < HC_BLOCK_LEVELS; level++) {
        count += polygons->counts[level];
    }
    glBindBuffer(GL_ARRAY_BUFFER, polygons->instances);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)((size_t)count * sizeof *polygons->places),
                 polygons->places, GL_STREAM_DRAW);
}

void hc_polygons_draw(const hc_gl_polygons *polygons)
{
    size_t first = 0;
    glBindVertexArray(polygons->array);
    glBindBuffer(GL_ARRAY_BUFFER, polygons->instances);
    for (int level = 0; level < HC_BLOCK_LEVELS; level++) {
        const int    begin  = polygons->firsts[level];
        const size_t place  = first * sizeof *polygons->places;
        const size_t corner = (size_t)begin * sizeof(uint16_t);
        if (polygons->counts[level] > 0) {
            glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof *polygons->places,
                                  (const void *)place);
            glDrawElementsInstanced(GL_TRIANGLES, polygons->firsts[level + 1] - begin,
                                    GL_UNSIGNED_SHORT, (const void *)corner,
                                    polygons->counts[level]);
        }
        first += (size_t)polygons->counts[level];
    }
}
