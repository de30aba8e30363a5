#include "client/turntable.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "client/failure.h"
#include "client/formats/triple.h"

namespace raytracer::client {
namespace {

using Vector = std::array<double, 3>;

std::string text_of(const Vector& vector) { return fmt::format("{}", fmt::join(vector, ",")); }

}  // namespace

Overrides Orbit::at(double share) const {
  const double angle = share * 2 * std::numbers::pi;
  const Vector around = sum(look_at, turned(difference(origin, look_at), unit(up), angle));
  return {{"origin", text_of(share == 0 ? origin : around)},
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
