/* A pinhole camera above a scene: rays out, pixels in. */
#ifndef HC_CLI_CAMERA_H
#define HC_CLI_CAMERA_H

#include "scene.h"

typedef struct hc_cli_camera {
    int    width, height;
    double eye[3];
    double forward[3];        /* unit; t of a ray is the depth along it      */
    double right[3], down[3]; /* from the middle of the picture to its edges */
    double sun[3];            /* unit, towards it                            */
    float  lift;              /* start of a shadow ray above the surface     */
} hc_cli_camera;

/* The camera that the settings ask for; what they do not say is chosen so that the field is in
 * view. */
hc_cli_camera hc_cli_camera_of(const hc_cli_settings *settings, const hc_cli_scene *scene);

/* Rays `first` to `first + count - 1`, in the order of the pixels. */
void hc_cli_camera_rays(const hc_cli_camera *camera, hc_ray *rays, uint64_t first, size_t count);

/* The ray from a hit to the sun; of a miss one that hits nothing. */
hc_ray hc_cli_camera_shadow(const hc_cli_camera *camera, const hc_tracer *tracer, const hc_ray *ray,
                            const hc_hit *hit);

/* The colour of pixel `index`, 8-bit RGB. */
void hc_cli_camera_shade(uint8_t rgb[3], const hc_cli_camera *camera, const hc_tracer *tracer,
                         const hc_hit *hit, uint64_t index, bool shadowed);

#endif
