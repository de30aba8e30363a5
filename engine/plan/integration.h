// What a pixel's colour is made of under a contract: samples, or integrals along lines across it.
//
// Lines find the edges that cross them, and cost by what is seen; samples can show anything.
#pragma once

#include <cstdint>

#include "engine/plan/choice.h"
#include "engine/plan/features.h"
#include "engine/plan/structures.h"
#include "engine/scene/scene.h"

namespace raytracer {

enum class Integration : std::uint8_t { samples, lines };

/// The most lights of which the edges of their shadows are looked for.
inline constexpr std::size_t most_lights_of_lines = 8;

/// Lines for contracts on scenes of spheres and squares alone, without reflections, under few
/// distant lights whose shadows a few spheres and a square's neighbours cast.
Choice<Integration> choose_integration(const Scene& scene, const Features& features, Kernel kernel,
                                       const Structures& structures);

}  // namespace raytracer
