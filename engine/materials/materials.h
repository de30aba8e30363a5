// What materials do with light and with rays: the one list of effects, each in a folder beside this
// file.
//
// One that answers light has its definition and its packets in its folder; one that sends rays on
// does so where rays are followed: reference/radiance.h and kernel/simd/trace_followed-inl.h;
// plan/magnification.cpp knows what their paths magnify. What packets read of all of them is in
// material_row.h.
#pragma once

#include <compare>
#include <cstdint>
#include <tuple>

#include "engine/fields/field_table.h"
#include "engine/fields/types.h"
#include "engine/materials/blinn_phong/blinn_phong.h"
#include "engine/materials/glass/glass.h"
#include "engine/materials/mirror/mirror.h"

namespace raytracer {

/// Has fields, which the reader, the canonical bytes and the schema know; materials that are equal
/// in all effects are one.
template <class Effect>
concept MaterialEffect = HasFields<Effect> && std::three_way_comparable<Effect>;

/// In the order of the documentation.
using MaterialEffects = Types<BlinnPhong, Mirror, Glass>;
static_assert(
    each_satisfies<MaterialEffects>([]<MaterialEffect Effect>(std::type_identity<Effect>) {}));

/// All effects together.
struct Material : BlinnPhong, Mirror, Glass {
  static constexpr auto fields = std::tuple_cat(BlinnPhong::fields, Mirror::fields, Glass::fields);

  friend auto operator<=>(const Material&, const Material&) = default;
};

/// An index into Scene::materials.
using MaterialIndex = std::uint32_t;

}  // namespace raytracer
