// Bullet's height field with its accelerator. It tests triangles and knows no rays without end.
#include "peers.h"
#include "trace_rays.h"

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletCollision/NarrowPhaseCollision/btRaycastCallback.h>

#include <cmath>

namespace {

const float FAR = 4.0F; // sides: beyond any point of the field

struct nearest_callback : public btTriangleRaycastCallback {
    nearest_callback(const btVector3 &from, const btVector3 &to)
        : btTriangleRaycastCallback(from, to)
    {
    }
    btScalar reportHit(const btVector3 &, btScalar fraction, int, int) override
    {
        return fraction;
    }
};

// Heights are centred on the origin, x and y on the field's middle.
btVector3 place(const hc_ray *ray, float t)
{
    const float x = ray->origin[0] + t * ray->direction[0] - 0.5F;
    const float y = ray->origin[1] + t * ray->direction[1] - 0.5F;
    const float z = ray->origin[2] + t * ray->direction[2] - 0.5F * (float)HC_RAYS_RELIEF;
    return btVector3(x, y, z);
}

void *create(const hc_field *field, hc_isa)
{
    btHeightfieldTerrainShape *shape =
        new btHeightfieldTerrainShape(field->width, field->height, field->heights, 1.0F, 0.0F, 1.0F,
                                      2, PHY_FLOAT, false);
    shape->setLocalScaling(btVector3(1.0F / (float)field->width, 1.0F / (float)field->height,
                                     (float)HC_RAYS_RELIEF));
    shape->buildAccelerator();
    return shape;
}

void destroy(void *scene)
{
    delete static_cast<btHeightfieldTerrainShape *>(scene);
}

double bytes(const void *)
{
    return 0.0;
}

float cast(const btHeightfieldTerrainShape *shape, const hc_ray *ray)
{
    const float length = std::sqrt(ray->direction[0] * ray->direction[0]
                                   + ray->direction[1] * ray->direction[1]
                                   + ray->direction[2] * ray->direction[2]);
    const float end    = std::fmin(ray->tmax, FAR / length);
    const btVector3  from = place(ray, ray->tmin);
    const btVector3  to   = place(ray, end);
    nearest_callback found(from, to);
    shape->performRaycast(&found, from, to);
    return found.m_hitFraction < 1.0F ? ray->tmin + found.m_hitFraction * (end - ray->tmin)
                                      : INFINITY;
}

void nearest(const void *scene, int, hc_hit *hits, const hc_ray *rays, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        hits[i]   = hc_hit();
        hits[i].t = cast(static_cast<const btHeightfieldTerrainShape *>(scene), &rays[i]);
    }
}

void any(const void *scene, int, uint8_t *hit, const hc_ray *rays, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        hit[i] = cast(static_cast<const btHeightfieldTerrainShape *>(scene), &rays[i]) < INFINITY;
    }
}

} // namespace

extern "C" const hc_bench_peer hc_peer_bullet = { "bullet", { "", nullptr, nullptr, nullptr }, 64,
                                                  create,   destroy, bytes, nearest, any };
