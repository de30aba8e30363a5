#include "client/turntable.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "client/failure.h"

namespace raytracer::client {
namespace {

using Vector = std::array<double, 3>;

std::string text_of(const Vector& vector) { return fmt::format("{}", fmt::join(vector, ",")); }

}  // namespace

Overrides Orbit::at(double share) const {
  // O. Rodrigues's formula.
  const double length = std::hypot(up[0], up[1], up[2]);
  const Vector k{up[0] / length, up[1] / length, up[2] / length};
  const Vector v{origin[0] - look_at[0], origin[1] - look_at[1], origin[2] - look_at[2]};
  const Vector k_cross_v{k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2],
                         k[0] * v[1] - k[1] * v[0]};
  const double k_dot_v = k[0] * v[0] + k[1] * v[1] + k[2] * v[2];
  const double angle = share * 2 * std::numbers::pi;
  Vector turned{};
  for (std::size_t i = 0; i < 3; ++i)
    turned[i] = look_at[i] + v[i] * std::cos(angle) + k_cross_v[i] * std::sin(angle) +
                k[i] * k_dot_v * (1 - std::cos(angle));
  return {{"origin", text_of(share == 0 ? origin : turned)},
          {"look_at", text_of(look_at)},
          {"up", text_of(up)}};
}

Orbit orbit_of(const SceneText& scene) {
  using nlohmann::json;
  // Of a large document only the camera is kept.
  const auto keep = [](int depth, json::parse_event_t event, const json& parsed) {
    return depth != 1 || event != json::parse_event_t::key || parsed == "camera";
  };
  const json document = json::parse(scene.text, keep, false);
  try {
    const json& camera = document.at("camera");
    const Orbit orbit{camera.at("origin"), camera.at("look_at"),
                      camera.value("up", Vector{0, 1, 0})};
    if (orbit.up == Vector{0, 0, 0}) throw InputError("");
    return orbit;
  } catch (const std::exception&) {
    throw InputError(fmt::format("{}: has no camera to go round with", scene.label));
  }
}

}  // namespace raytracer::client
