#include "tests/extremes/cases.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>

namespace raytracer::extremes {

namespace {

std::vector<Extreme> extremes_in(const std::filesystem::path& directory) {
  std::vector<Extreme> extremes;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    Result<Scene> scene = read_scene(text, Limits{});
    if (!scene.ok())
      throw std::runtime_error(entry.path().string() + ": " + scene.errors()[0].pointer + " " +
                               scene.errors()[0].detail);
    extremes.push_back({entry.path().stem().string(), nlohmann::json::parse(text).at("description"),
                        std::move(scene).value()});
  }
  std::sort(extremes.begin(), extremes.end(),
            [](const Extreme& a, const Extreme& b) { return a.name < b.name; });
  return extremes;
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming)
void PrintTo(const Extreme& extreme, std::ostream* out) { *out << extreme.name; }

std::vector<Extreme> all_extremes() {
  return extremes_in(std::filesystem::path(EXTREMES_DIRECTORY) / "scenes");
}

std::vector<Extreme> soft_extremes() {
  return extremes_in(std::filesystem::path(EXTREMES_DIRECTORY) / "soft");
}

Image render_as(Scene scene, Precision precision, WorkerPool& pool) {
  scene.render.precision = precision;
  RenderProgress progress;
  return render(scene, Limits{}, pool, progress).image;
}

}  // namespace raytracer::extremes
