/* The check of a field: its sizes, its enums, and every height. */
#include "shape.h"

#include "base/parallel.h"

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
