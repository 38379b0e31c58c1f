/* Stepping from cell to cell. The index is moved by the wall that was crossed: rounding of a
 * position on a wall may give back the cell it came from, and the ray would stall. */
#ifndef HC_TRACE_CURSOR_H
#define HC_TRACE_CURSOR_H

#include "tracer.h"

#include <math.h>

typedef struct hc_cursor {
    double s;
    int    cell[2];
} hc_cursor;

static inline double hc_path_at(const hc_path *path, int axis, double s)
{
    return path->place[axis] + s * path->along[axis];
}

/* When the ray comes to a coordinate. */
static inline double hc_path_reaches(const hc_path *path, int axis, double coordinate)
{
    return path->along[axis] == 0.0 ? INFINITY
                                    : (coordinate - path->place[axis]) / path->along[axis];
}

/* It runs along a wall, and where cells are tops, it touches both of them. */
static inline bool hc_path_on_wall(const hc_path *path, int axis)
{
    return path->along[axis] == 0.0 && path->place[axis] == floor(path->place[axis]);
}

/* When it leaves this column (row) of cells; never before the cursor. */
static inline double hc_cursor_wall(const hc_cursor *cursor, const hc_path *path, int axis)
{
    const int next = path->along[axis] > 0.0 ? cursor->cell[axis] + 1 : cursor->cell[axis];
    return fmax(hc_path_reaches(path, axis, next), cursor->s);
}

static inline double hc_cursor_exit(const hc_cursor *cursor, const hc_path *path)
{
    return fmin(hc_cursor_wall(cursor, path, 0), hc_cursor_wall(cursor, path, 1));
}

/* Into the next cell; through a corner, into the opposite one. */
static inline void hc_cursor_cross(hc_cursor *cursor, const hc_path *path)
{
    const double wall[2] = { hc_cursor_wall(cursor, path, 0), hc_cursor_wall(cursor, path, 1) };
    cursor->s            = fmin(wall[0], wall[1]);
    for (int i = 0; i < 2; i++) {
        if (wall[i] <= cursor->s) {
            cursor->cell[i] += path->along[i] > 0.0 ? 1 : -1;
        }
    }
}

/* Into the cell at a later s; never back. */
static inline void hc_cursor_jump(hc_cursor *cursor, const hc_path *path, double s)
{
    cursor->s = s;
    for (int i = 0; i < 2; i++) {
        const int cell = (int)floor(hc_path_at(path, i, s));
        if (path->along[i] > 0.0 ? cell > cursor->cell[i]
                                 : path->along[i] < 0.0 && cell < cursor->cell[i]) {
            cursor->cell[i] = cell;
        }
    }
}

#endif
