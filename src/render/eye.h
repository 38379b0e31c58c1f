/* A camera made ready: rays through the places of a picture. */
#ifndef HC_RENDER_EYE_H
#define HC_RENDER_EYE_H

#include <heightcast/render.h>

typedef struct hc_eye {
    int    width, height; /* of the picture */
    int    samples;       /* in each pixel  */
    bool   parallel;
    double place[3], forward[3]; /* forward: unit */
    double right[3], down[3];    /* perspective: from the middle of the picture to its edges, at
                                 distance 1; else in the world */
} hc_eye;

/* `camera` with fov and samples resolved. One that looks nowhere looks along y. */
hc_eye hc_eye_of(const hc_camera *camera, int width, int height);

/* Where in a pixel sample `index` lies, 0 .. 1 along each axis. */
void hc_eye_sample_place(const hc_eye *eye, double place[2], int index);

/* The ray through the point (x, y) of the picture, in pixels; direction of unit length. */
void hc_eye_ray(const hc_eye *eye, double origin[3], double direction[3], double x, double y);

#endif
