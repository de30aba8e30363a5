// What the shading of a scene under the plainest light finds ready in it: distant lights alone,
// whose light must pass but a few spheres, which are discs across it, and the neighbours in a
// square.
#pragma once

#include "engine/kernel/simd/simd_scene.h"
#include "engine/pack/packed_scene.h"

namespace raytracer {

/// Tells whether `packed`, complete otherwise, is plainly lit, and notes in it what follows.
template <typename T>
void prepare_plain_light(const PackedScene& scene, SimdScene<T>& packed);

extern template void prepare_plain_light<float>(const PackedScene&, SimdScene<float>&);
extern template void prepare_plain_light<double>(const PackedScene&, SimdScene<double>&);

}  // namespace raytracer
