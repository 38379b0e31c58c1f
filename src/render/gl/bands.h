/* Pictures by a fragment shader: bands of rows are drawn, read back and handed on, for each sample
 * in a pixel. The shader writes three planes:
 *   rgb, distance along the ray (1e30: nothing)
 *   normal, height
 *   steps, texels read, 0 or 1 + crossings if the ray came to anything, whether steps ran out
 * and has uniforms u_first_row, u_sample and those of hc_upload_eye. */
#ifndef HC_RENDER_GL_BANDS_H
#define HC_RENDER_GL_BANDS_H

#include "../eye.h"
#include "../sums.h"

enum { HC_GL_PLANES = 3 };

/* Triangles that are drawn first, in the depth buffer of what comes behind; bodies.vert's u_window
 * is set for each band. The shaders' depths are larger the nearer, and 0 where there is nothing. */
typedef struct hc_gl_bodies {
    unsigned program, array; /* array: of vertices */
    int      count;          /* of vertices; 0: there are none */
    /* The ground as triangles, by a program of its own; NULL: rays draw it. */
    const struct hc_gl_polygons *ground;
    unsigned                     ground_program;
} hc_gl_bodies;

typedef struct hc_bands {
    unsigned     program, exact; /* exact: its distances are the exact ones; 0: none is asked for */
    unsigned     vertices;       /* core profiles want an array, though nothing is in it */
    unsigned     frame, planes[HC_GL_PLANES];
    hc_gl_bodies bodies;
    unsigned     depth;
    int          width, rows; /* of a band */
    float       *back;        /* what was drawn: the planes, and one of exact distances */
} hc_bands;

/* Targets for pictures of this size, in a context that is current; `unit`: one of its texture units
 * that is free. hc_bands_free must follow, whatever the result, in the same context. */
hc_result hc_bands_make(hc_bands *bands, int width, int height, int unit, hc_log *log);
/* Draw them first. */
hc_result hc_bands_take_bodies(hc_bands *bands, const hc_gl_bodies *bodies, hc_log *log);
void      hc_bands_free(hc_bands *bands);

/* Drivers finish compiling when they draw for the first time: that is no time of drawing. */
void hc_bands_warm(const hc_bands *bands);

/* What becomes of a sample; direction: of its ray. */
typedef void hc_band_add(void *user, hc_pixel *pixel, const hc_sample *sample,
                         const double direction[3], int row);

/* seconds [out] of drawing alone. */
hc_result hc_bands_draw(hc_pixel *pixels, double *seconds, const hc_bands *bands, const hc_eye *eye,
                        const hc_progress *progress, hc_band_add *add, void *user, hc_log *log);

/* Distances of eye->width * eye->height rays through the middles of the pixels; 1e30: nothing. */
hc_result hc_bands_distances(float *distances, const hc_bands *bands, const hc_eye *eye,
                             const hc_progress *progress, hc_log *log);

#endif
