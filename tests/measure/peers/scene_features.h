// What a scene has that a peer may not: peers are told by this what they cannot draw.
#pragma once

#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "engine/engine.h"

namespace raytracer::peers {

struct SceneFeatures {
  std::set<std::string_view> objects;  ///< their types, as in documents
  std::set<std::string_view> lights;   ///< likewise; soft ones by names of their own
  bool has_item_colors = false;        ///< sets with a colour for each item
  bool has_vertex_colors = false;
  bool has_smooth_meshes = false;
  bool has_caps = false;                ///< cylinders or cones that are closed
  bool has_fading_points = false;       ///< lights that fall off with the distance
  bool has_highlights = false;          ///< some material's ks is above 0
  bool has_flat_highlights = false;     ///< of shininess 0
  bool has_colored_highlights = false;  ///< on materials that are not grey
  bool has_mirrors = false;
  bool has_glass = false;
  bool has_fresnel = false;
  bool has_transparent_background = false;
  bool has_uneven_lights = false;  ///< not all grey and of one intensity
  bool has_ambient_part = false;   ///< ambient light that surfaces answer
  int samples = 1;                 ///< per pixel
};

bool is_grey(const Rgb& color);

SceneFeatures features_of(const Scene& scene);

/// "objects of type cone" for the first of `present` that is not among `known`.
std::optional<std::string> first_unknown(const std::set<std::string_view>& present,
                                         std::initializer_list<std::string_view> known,
                                         std::string_view what);

/// The first reason of those whose condition holds.
std::optional<std::string> first_reason(
    std::initializer_list<std::pair<bool, std::string_view>> reasons);

}  // namespace raytracer::peers
