/* heightcast: height maps to cone step maps and max-mip pyramids, and rays cast at height fields.
 *
 * Conventions: field.h. Results and messages: result.h. Baked data: maps.h. Baking: bake.h. Rays:
 * ray.h, trace.h. Files: io.h, a library of its own (heightcast-io), so that a program that ships
 * baked maps links no image libraries. */
#ifndef HEIGHTCAST_HEIGHTCAST_H
#define HEIGHTCAST_HEIGHTCAST_H

#include <heightcast/bake.h>
#include <heightcast/field.h>
#include <heightcast/maps.h>
#include <heightcast/ray.h>
#include <heightcast/result.h>
#include <heightcast/trace.h>
#include <heightcast/version.h>

#endif
