// What materials do with light and with rays: the one list of effects, each in a folder beside this
// file.
//
// An effect is a structure with `fields`, which the reader, the canonical text and the schema know.
// One that answers light has its definition and its packets in its folder; one that sends rays on
// does so where rays are followed: reference/radiance.h and kernel/simd/followed_rays-inl.h, and by
// plan/magnification.h the plan knows what their paths magnify.
#pragma once

#include <cstdint>
#include <tuple>

#include "engine/materials/blinn_phong/blinn_phong.h"
#include "engine/materials/mirror/mirror.h"

namespace raytracer {

/// All effects together, in the order of the documentation.
struct Material : BlinnPhong, Mirror {
  static constexpr auto fields = std::tuple_cat(BlinnPhong::fields, Mirror::fields);

  friend auto operator<=>(const Material&, const Material&) = default;
};

/// An index into Scene::materials.
using MaterialIndex = std::uint32_t;

}  // namespace raytracer
