/* Draws a flat field: needs libheightcast-render and libheightcast. */
#include <heightcast/render.h>

#include <stdio.h>

int main(void)
{
    static float   heights[16 * 16], rgb[8 * 8 * 3];
    const hc_scene scene   = { .relief = {
                                   .field = { .heights = heights, .width = 16, .height = 16 } } };
    hc_picture     picture = { .width = 8, .height = 8, .rgb = rgb };
    hc_log         log     = { 0 };
    if (hc_render(&picture, &scene, NULL, &log) != HC_OK) {
        (void)fprintf(stderr, "%s\n", log.text);
        return 1;
    }
    return picture.figures.hits == 0;
}
