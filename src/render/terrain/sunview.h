/* What the sun sees: a map of depths, from which shadows can be read instead of cast. */
#ifndef HC_RENDER_SUNVIEW_H
#define HC_RENDER_SUNVIEW_H

#include "../eye.h"

struct hc_terrain;

typedef struct hc_sunview {
    int    side;                /* texels; 0: there is no map                           */
    float *depths;              /* side * side, from the plane `top` along the sun's rays;
                                        HC_SUNVIEW_FAR: nothing                              */
    double across[3], along[3]; /* unit, of the map's axes                               */
    double first[2];            /* coordinates of its corner, from the terrain's low one */
    double texel[2];            /* world units                                          */
    double top;                 /* coordinate along the sun, likewise                   */
} hc_sunview;

#define HC_SUNVIEW_FAR 1e30F

/* Place the map, and take memory for its depths. hc_sunview_free must follow, whatever the
 * result. */
hc_result hc_sunview_place(hc_sunview *view, const struct hc_terrain *terrain, int side,
                           hc_log *log);
/* Cast its rays on all threads; or */
hc_result hc_sunview_cast(hc_sunview *view, const struct hc_terrain *terrain, hc_log *log);
/* draw them: the eye that sees the map, texel by texel. */
void hc_sunview_eye(hc_eye *eye, const struct hc_terrain *terrain);
void hc_sunview_free(hc_sunview *view);

/* Share of the sun's light that comes to a place, counted from the terrain's low corner, on a
 * surface whose normal has this cosine to the sun: the four texels around it, weighed. */
double hc_sunview_light(const hc_sunview *view, const double sun[3], const double place[3],
                        double facing);

#endif
