// The kernels in double precision, once for each set of instructions.
#include "engine/kernel/simd/render_tile.h"
#include "engine/kernel/simd/sample_pixels.h"
#include "engine/kernel/this_machine.h"

namespace raytracer {
using Real = double;
}

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/kernel/simd/double_precision.cpp"  // this file, once per target
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

// clang-format off
#include "engine/kernel/simd/kernel-inl.h"
#include "engine/kernel/simd/turn_in_double-inl.h"
#include "engine/kernel/simd/trace_in_double-inl.h"
#include "engine/kernel/simd/entries-inl.h"
// clang-format on
