// Rows of a table of records, one row a lane: a broadcast where all lanes want the same row, else a gather.
#ifndef CLRT_KERNELS_BASE_TABLE_H
#define CLRT_KERNELS_BASE_TABLE_H

#include "base/vec.h"
#if HAS_PATH
#include "base/gather4.h"
#endif

typedef struct {
    global const f32 *base;
    vi offset; // of the lane's record in numbers
    int first;
    bool uniform;
} Row;

// Records of `numbers` 4-byte numbers; every index must be valid.
static inline Row row_make(global const void *records, vi index, int numbers)
{
    Row row;
    LanesI lanes;
    lanes.v = index * numbers;
    row.base = (global const f32 *)records;
    row.offset = lanes.v;
    row.first = lanes.s[0];
    row.uniform = vm_all(lanes.v == (vi)(row.first));
    return row;
}

static inline vf row_real(const Row *row, int k)
{
    return row->uniform ? (vf)(row->base[row->first + k]) : vf_gather(row->base, row->offset + k);
}

static inline vi row_int(const Row *row, int k)
{
    global const int *base = (global const int *)row->base;
    return row->uniform ? (vi)(base[row->first + k]) : vi_gather(base, row->offset + k);
}

#if HAS_PATH
// Number k + 3 must be there, too.
static inline v3 row_real3(const Row *row, int k)
{
    if (row->uniform)
        return v3_make((vf)(row->base[row->first + k]), (vf)(row->base[row->first + k + 1]),
                       (vf)(row->base[row->first + k + 2]));
    const Gather4 four = gather4(row->base, row->offset + k);
    return v3_make(four.x, four.y, four.z);
}

static inline Gather4 row_real4(const Row *row, int k)
{
    Gather4 four;
    if (!row->uniform)
        return gather4(row->base, row->offset + k);
    four.x = (vf)(row->base[row->first + k]);
    four.y = (vf)(row->base[row->first + k + 1]);
    four.z = (vf)(row->base[row->first + k + 2]);
    four.w = (vf)(row->base[row->first + k + 3]);
    return four;
}
#else
static inline v3 row_real3(const Row *row, int k)
{
    return v3_make(row_real(row, k), row_real(row, k + 1), row_real(row, k + 2));
}
#endif

#endif
