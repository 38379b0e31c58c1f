/* What a field is: names, distances, validity, and the surface between its samples. */
#include "shape.h"

#include "base/parallel.h"

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

static hc_result check_shape(const hc_field *field, hc_log *log)
{
    if (field == NULL || field->heights == NULL) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "%s is NULL",
                       field == NULL ? "field" : "field.heights");
    }
    if ((unsigned)field->wrap > HC_WRAP_UV) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "field.wrap is %d; known are 0 .. %d",
                       (int)field->wrap, (int)HC_WRAP_UV);
    }
    if ((unsigned)field->registration > HC_GRID) {
        return hc_fail(log, HC_ERROR_ARGUMENT, "field.registration is %d; known are 0 .. %d",
                       (int)field->registration, (int)HC_GRID);
    }
    return hc_check_shape("field", field->width, field->height, sizeof *field->heights, log);
}

static bool in_range(float height)
{
    return (height >= 0.0F) & (height <= 1.0F); /* false for NaN; no branch: vector code */
}

static bool row_in_range(const float *row, int width)
{
    int outside = 0; /* no early exit, so that the loop becomes vector code */
    for (int x = 0; x < width; x++) {
        outside |= !in_range(row[x]);
    }
    return outside == 0;
}

/* Rows of a field, and the first that each worker has found wrong. */
typedef struct check {
    const hc_field *field;
    int             first[HC_THREADS_MAX];
} check;

static const float *row_of(const hc_field *field, int y)
{
    return field->heights + (size_t)y * (size_t)field->width;
}

static void check_row(void *context, int y, int worker)
{
    check *c = context;
    if (y < c->first[worker] && !row_in_range(row_of(c->field, y), c->field->width)) {
        c->first[worker] = y;
    }
}

/* The first row that is wrong; the height, if there is none. */
static int find_wrong_row(const hc_field *field, int threads)
{
    check c = { .field = field };
    for (int i = 0; i < threads; i++) {
        c.first[i] = field->height;
    }
    (void)hc_parallel_for(field->height, threads, check_row, &c, (hc_progress){ 0 }, NULL);
    int first = field->height;
    for (int i = 0; i < threads; i++) {
        first = c.first[i] < first ? c.first[i] : first;
    }
    return first;
}

hc_result hc_field_check_on(const hc_field *field, int threads, hc_log *log)
{
    enum { FEW = 1 << 22 }; /* samples that are checked sooner than a thread is started */
    const hc_result shape = check_shape(field, log);
    if (shape != HC_OK) {
        return shape;
    }
    const bool few = field->height < FEW / field->width;
    const int  y   = find_wrong_row(field, few ? 1 : threads);
    if (y == field->height) {
        return HC_OK;
    }
    const float *row = row_of(field, y);
    int          x   = 0;
    while (in_range(row[x])) {
        x++;
    }
    return hc_fail(log, HC_ERROR_FIELD,
                   "field.heights[%d, %d] is %g; heights must be finite and in 0..1", x, y,
                   (double)row[x]);
}

hc_result hc_field_check(const hc_field *field, hc_log *log)
{
    return hc_field_check_on(field, 1, log);
}
