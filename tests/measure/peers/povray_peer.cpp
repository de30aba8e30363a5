#include "tests/measure/peers/povray_peer.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "tests/measure/peers/povray_scene.h"
#include "tests/measure/peers/scene_features.h"

namespace raytracer::peers {
namespace {

constexpr std::array thresholds{0.3, 0.1, 0.03, 0.01, 0.0};
constexpr std::array recursive_depths{1, 2, 3, 4, 5, 6};
constexpr std::array flat_depths{2, 3, 4, 5, 6, 8, 11, 16, 23};

int root_of(int samples) { return static_cast<int>(std::lround(std::sqrt(samples))); }

/// "Trace Time:  0 hours  0 minutes  0 seconds (0.088 seconds)".
std::string pattern_of(const char* stage) {
  return std::string(stage) + R"( Time:.*\(([0-9.]+) seconds\))";
}

std::string antialiasing(int method, double threshold, int depth) {
  return fmt::format("+AM{} +A{:.3f} +R{}", method, threshold, depth);
}

}  // namespace

std::string PovrayPeer::version() const {
  return stated_version("povray --version", R"(POV-Ray ([0-9.]*[0-9]))");
}

std::optional<std::string> PovrayPeer::refusal(const Scene& scene) const {
  const SceneFeatures features = features_of(scene);
  if (auto type = first_unknown(features.objects,
                                {"sphere", "spheres", "sphere_square", "plane", "mesh", "cylinder",
                                 "cylinders", "cone", "cones"},
                                "objects"))
    return type;
  if (auto type = first_unknown(features.lights, {"distant", "point"}, "lights")) return type;
  const int root = root_of(features.samples);
  return first_reason(
      {{features.has_transparent_background, "a transparent background"},
       {features.has_flat_highlights, "highlights of shininess 0"},
       {root * root != features.samples, "a number of samples that is not a square"}});
}

std::vector<std::string> PovrayPeer::differences(const Scene& scene) const {
  const SceneFeatures features = features_of(scene);
  std::vector<std::string> differences = ProgramPeer::differences(scene);
  if (features.has_colored_highlights)
    differences.push_back("highlights on coloured surfaces have a Fresnel term");
  if (features.has_smooth_meshes) differences.push_back("smooth meshes mirror by other rules");
  if (features.has_glass)
    differences.push_back("glass within glass is bent by the ratio of both indices");
  if (features.has_fresnel)
    differences.push_back("what goes through and is mirrored add up to 1 at every angle");
  if (features.samples > 1) differences.push_back("other sample positions");
  return differences;
}

void PovrayPeer::set_scene(const Scene& scene) {
  std::ofstream file(folder_.path() / "scene.pov");
  write_povray_scene(scene_drawn(*this, scene), file);
  if (!file.flush()) throw std::runtime_error("POV-Ray's scene could not be written");
  width_ = scene.camera.width;
  height_ = scene.camera.height;
  samples_ = scene.render.samples.value_or(1);
}

Drawing PovrayPeer::draw() {
  return run(samples_ == 1 ? "-A" : antialiasing(1, 0, root_of(samples_)));
}

std::vector<Ladder> PovrayPeer::ladders() {
  constexpr double worth_it = 0.85;
  std::vector<Ladder> ladders;
  for (const double threshold : thresholds) {
    const auto add = [&](int method, const auto& depths) {
      ladders.push_back({{}, worth_it});
      for (const int depth : depths) {
        const std::string options = antialiasing(method, threshold, depth);
        ladders.back().settings.push_back({options, [this, options] { return run(options); }});
      }
    };
    add(2, recursive_depths);
    add(1, flat_depths);
  }
  return ladders;
}

Drawing PovrayPeer::run(const std::string& antialiasing) const {
  const ProgramRun run = folder_.run(fmt::format(
      "povray +Iscene.pov +Oscene.ppm +FP16 File_Gamma=1.0 -D -V -P +W{} +H{} +WT{} {} -J", width_,
      height_, thread_count_, antialiasing));
  return {.times = {.read_ms = stated_ms(run.output, pattern_of("Parse")),
                    .build_ms = stated_ms(run.output, pattern_of("Bounding")),
                    .trace_ms = stated_ms(run.output, pattern_of("Trace")),
                    .whole_ms = run.whole_ms},
          .image = folder_.read_ppm("scene.ppm"),
          .way = {}};
}

}  // namespace raytracer::peers
