// What the kernels have in common: parts of code for packets, each after those that it builds on.
//
// A kernel's source is compiled once for each instruction set (hwy/foreach_target.h) and reads this
// list each time. Every other part is read by one file alone, so that none needs an include guard.

// clang-format off
#include "engine/packets/packet-inl.h"
#include "engine/packets/rows-inl.h"
#include "engine/packets/hit-inl.h"
#include "engine/packets/flat-inl.h"
#include "engine/finders/cells-inl.h"
#include "engine/finders/light_grid-inl.h"
#include "engine/finders/point_grid-inl.h"
#include "engine/finders/tree_walk-inl.h"
#include "engine/finders/tree-inl.h"
#include "engine/lights/lights-inl.h"
#include "engine/materials/materials-inl.h"
#include "engine/objects/items-inl.h"
#include "engine/objects/objects-inl.h"
#include "engine/objects/kind-inl.h"
#include "engine/kernel/simd/block-inl.h"
#include "engine/kernel/simd/find-inl.h"
#include "engine/kernel/simd/surface-inl.h"
#include "engine/kernel/simd/soft_light-inl.h"
#include "engine/kernel/simd/shade-inl.h"
#include "engine/kernel/simd/path_error-inl.h"
#include "engine/kernel/simd/followed_rays-inl.h"
#include "engine/kernel/simd/transmission-inl.h"
#include "engine/kernel/simd/branching_rays-inl.h"
#include "engine/kernel/simd/eye_rays-inl.h"
#include "engine/kernel/simd/doubtful-inl.h"
#include "engine/kernel/simd/eye-inl.h"
#include "engine/kernel/simd/candidates-inl.h"
#include "engine/kernel/simd/resolve-inl.h"
// clang-format on
