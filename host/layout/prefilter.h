// Prefilter: an environment blurred for lobes of several widths and for diffuse reflection, and the reflectance of
// lobes: the split-sum approximation of Karis, "Real Shading in Unreal Engine 4", 2013. Knows maps only.
#ifndef CLRT_LAYOUT_PREFILTER_H
#define CLRT_LAYOUT_PREFILTER_H

#include "base/types.h"
#include "shared/environment.h"

// Fills maps and table of the record; returns how many numbers they take in all.
u64 prefilter_plan(EnvironmentRecord *record);

// Fills the numbers from the texels. Returns false where memory is exhausted.
bool prefilter_run(const EnvironmentRecord *record, const f32 *texels, f32 *numbers);

#endif
