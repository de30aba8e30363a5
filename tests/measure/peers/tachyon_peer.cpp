#include "tests/measure/peers/tachyon_peer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <stdexcept>

#include "tests/measure/peers/scene_features.h"
#include "tests/measure/peers/tachyon_scene.h"

namespace raytracer::peers {
namespace {

std::ptrdiff_t sky_count(const Scene& scene) {
  return std::count_if(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
    return std::holds_alternative<SkyLight>(light.source);
  });
}

}  // namespace

std::string TachyonPeer::version() const {
  return stated_version("tachyon -version", R"(([0-9][0-9.]*))");
}

std::optional<std::string> TachyonPeer::refusal(const Scene& scene) const {
  const SceneFeatures features = features_of(scene);
  if (auto type = first_unknown(
          features.objects,
          {"sphere", "spheres", "sphere_square", "plane", "mesh", "cylinder", "cylinders"},
          "objects"))
    return type;
  if (auto type = first_unknown(features.lights, {"distant", "point", "sky"}, "lights"))
    return type;
  return first_reason(
      {{features.has_transparent_background, "a transparent background"},
       {features.has_item_colors, "sets with a colour for each item"},
       {features.has_vertex_colors, "meshes with a colour for each vertex"},
       {features.has_glass, "glass, which it does not bend light in"},
       {sky_count(scene) > 1, "more than one sky"},
       {features.has_highlights && features.has_fading_points,
        "highlights of point lights, which do not fall off with the distance there"}});
}

std::vector<std::string> TachyonPeer::differences(const Scene& scene) const {
  const SceneFeatures features = features_of(scene);
  std::vector<std::string> differences = ProgramPeer::differences(scene);
  if (features.has_colored_highlights && features.has_uneven_lights)
    differences.push_back(
        "highlights on coloured surfaces have the same brightness and no colour of any light");
  if (features.has_mirrors)
    differences.push_back("what was reflected max_depth times sees the background");
  if (features.lights.contains("sky"))
    differences.push_back("64 random directions of the sky in every point");
  if (features.samples > 1) differences.push_back("random sample positions");
  return differences;
}

void TachyonPeer::set_scene(const Scene& scene) {
  std::ofstream file(folder_.path() / "scene.dat");
  write_tachyon_scene(scene_drawn(*this, scene), file);
  if (!file.flush()) throw std::runtime_error("Tachyon's scene could not be written");
  has_shadows_ = scene.shadows != Shadows::off;
  samples_ = scene.render.samples.value_or(1);
}

std::vector<Ladder> TachyonPeer::ladders() {
  constexpr double worth_it = 1;
  Ladder ladder{{}, worth_it};
  for (const int samples : {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512})
    ladder.settings.push_back(
        {fmt::format("{} samples", samples), [this, samples] { return run(samples - 1); }});
  return {ladder};
}

Drawing TachyonPeer::run(int further_samples) const {
  // It ends with status 0 whatever happens.
  const std::filesystem::path picture = folder_.path() / "scene.ppm";
  std::filesystem::remove(picture);
  const ProgramRun run = folder_.run(
      fmt::format("tachyon scene.dat {} -shade_blinn -numthreads {} -aasamples {} "
                  "-format PPM48 -o scene.ppm",
                  has_shadows_ ? "-fullshade" : "-mediumshade", thread_count_, further_samples));
  if (!std::filesystem::exists(picture)) throw std::runtime_error("Tachyon failed:\n" + run.output);
  const auto stage_ms = [&](const char* stage) {
    return stated_ms(run.output, std::string(stage) + R"( Time: *([0-9.]+) seconds)");
  };
  return {.times = {.read_ms = stage_ms("Scene Parsing"),
                    .build_ms = stage_ms("Preprocessing"),
                    .trace_ms = stage_ms("Ray Tracing"),
                    .whole_ms = run.whole_ms},
          .image = folder_.read_ppm("scene.ppm"),
          .way = {}};
}

}  // namespace raytracer::peers
