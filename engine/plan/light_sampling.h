// At how many places soft lights are sampled.
#pragma once

#include <cstddef>

#include "engine/lights/light_places.h"
#include "engine/plan/choice.h"
#include "engine/plan/finders.h"
#include "engine/scene/features.h"
#include "engine/scene/scene.h"

namespace raytracer {

/// For a render whose first pass has so many samples per pixel.
Choice<LightSampling> choose_light_sampling(const Scene& scene, const Features& features,
                                            int first_samples);

/// How rays to soft lights that share directions look for what is in their way.
SoftLightSearch choose_soft_light_search(const RenderSettings& settings, const Features& features,
                                         const LightSampling& sampling);

/// The places of each soft light that a pixel with so many samples, or in their mean, looks at.
int light_samples_per_pixel(const LightSampling& sampling, double samples);

/// How many rays a sample sends to lights, about.
std::size_t light_rays_per_sample(const Scene& scene);

}  // namespace raytracer
