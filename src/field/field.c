/* What a field is: names, distances, validity, and the surface between its samples. */
#include "shape.h"

#include <math.h>

const char *hc_wrap_name(hc_wrap wrap)
{
    static const char *const names[] = { "none", "u", "v", "uv" };
    const unsigned           index   = (unsigned)wrap;
    return index < sizeof names / sizeof *names ? names[index] : "unknown";
}

const char *hc_registration_name(hc_registration registration)
{
    static const char *const names[] = { "texel", "grid" };
    const unsigned           index   = (unsigned)registration;
    return index < sizeof names / sizeof *names ? names[index] : "unknown";
}

size_t hc_sample_size(hc_sample_type type)
{
    switch (type) {
    case HC_U8: return 1;
    case HC_U16:
    case HC_I16: return 2;
    case HC_U32:
    case HC_I32:
    case HC_F32: return 4;
    case HC_F64: return 8;
    }
    return 0;
}

/* One axis of a field. */
typedef struct axis {
    int    side;
    bool   wrapped;
    double steps; /* sample distances per texture unit   */
    double first; /* sample distances from 0 to sample 0 */
} axis;

static axis make_axis(int side, bool wrapped, hc_registration registration)
{
    const bool posts = registration == HC_GRID && !wrapped && side > 1;
    return (axis){ .side    = side,
                   .wrapped = wrapped,
                   .steps   = posts ? side - 1 : side,
                   .first   = registration == HC_GRID ? 0.0 : 0.5 };
}

static axis axis_u(const hc_field *field)
{
    return make_axis(field->width, ((unsigned)field->wrap & HC_WRAP_U) != 0, field->registration);
}

static axis axis_v(const hc_field *field)
{
    return make_axis(field->height, ((unsigned)field->wrap & HC_WRAP_V) != 0, field->registration);
}

double hc_field_step_u(const hc_field *field)
{
    return 1.0 / axis_u(field).steps;
}

double hc_field_step_v(const hc_field *field)
{
    return 1.0 / axis_v(field).steps;
}

/* The two samples around a place, and the second one's weight. */
typedef struct span {
    int    low, high;
    double weight;
} span;

static span find_span(axis along, double place)
{
    if (along.wrapped) {
        /* floor first: scaling a large coordinate would round away what is left of its fraction */
        const double x   = (place - floor(place)) * along.steps - along.first;
        const int    low = (int)floor(x);
        return (span){ (low + along.side) % along.side, (low + 1) % along.side, x - low };
    }
    const double x    = fmin(fmax(place * along.steps - along.first, 0.0), along.side - 1);
    const int    low  = (int)x;
    const int    high = low + 1 < along.side ? low + 1 : low;
    return (span){ low, high, x - low };
}

static double mix(double from, double to, double weight)
{
    return from * (1.0 - weight) + to * weight;
}

double hc_field_surface(const hc_field *field, double u, double v)
{
    const span   x     = find_span(axis_u(field), u);
    const span   y     = find_span(axis_v(field), v);
    const float *upper = field->heights + (size_t)y.low * (size_t)field->width;
    const float *lower = field->heights + (size_t)y.high * (size_t)field->width;
    return mix(mix((double)upper[x.low], (double)upper[x.high], x.weight),
               mix((double)lower[x.low], (double)lower[x.high], x.weight), y.weight);
}

hc_result hc_field_check(const hc_field *field, hc_log *log)
{
    return hc_field_check_on(field, 1, log);
}
