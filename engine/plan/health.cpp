#include "engine/plan/health.h"

#include <fmt/format.h>

#include "engine/text/pluralised.h"

namespace raytracer {
namespace {

class Report {
 public:
  Report(const Scene& scene, const Plan& plan) : scene_(scene), plan_(plan) {}

  std::vector<std::string> strains() && {
    say_where_the_eye_is();
    say_what_is_lost();
    say_what_the_document_rounds();
    say_what_coincides();
    say_what_light_grazes();
    say_what_is_displaced();
    say_what_is_small();
    return std::move(strains_);
  }

 private:
  void add(std::string strain) { strains_.push_back(std::move(strain)); }

  void say_where_the_eye_is() {
    const SceneStatistics& statistics = plan_.statistics;
    constexpr double close = 1e-9;
    if (statistics.nearest == 0)
      add("The eye is on or inside a surface, so that every ray begins there and is traced several "
          "times slower: if that is not meant, move camera.origin.");
    else if (statistics.all.clearance < close * statistics.farthest)
      add(
          fmt::format("The nearest surface is {:.2g} of the scene's extent before the eye: if what "
                      "lies behind it is meant to be seen, move camera.origin.",
                      statistics.all.clearance / statistics.farthest));
  }

  void say_what_is_lost() {
    const double lost = plan_.statistics.lost;
    if (lost > 0)
      add(fmt::format(
          "{} than 1e-144 of the scene's extent, which double's squares do not hold, "
          "and {} left out: bring the largest and the smallest sizes and distances, "
          "those of point lights too, nearer to each other.",
          lost > 1 ? fmt::format("{:.10g} objects are smaller", lost) : "An object is smaller",
          lost > 1 ? "are" : "is"));
  }

  void say_what_the_document_rounds() {
    constexpr double visible = 1.0 / 4096;
    const double coarseness = plan_.statistics.all.coarseness();
    if (coarseness > visible)
      add(
          fmt::format("Coordinates are so large that they round to steps of {:.2g} of an object's "
                      "radius, before anything is rendered: move the scene and the camera towards "
                      "the coordinates' origin.",
                      coarseness));
  }

  void say_what_coincides() {
    constexpr double told_apart = 1e-13;  // by double, with a margin
    if (plan_.statistics.gap < told_apart)
      add(
          fmt::format("Two surfaces are only {:.2g} of their distance apart, and rounding may "
                      "decide which of them is seen: move them apart, or give both the same "
                      "numbers so that the first in the document is seen.",
                      plan_.statistics.gap));
  }

  void say_what_light_grazes() {
    for (const GrazingLight& grazing : plan_.statistics.grazing)
      for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
        if (kind_index<Kind> == grazing.kind)
          add(
              fmt::format("Light {} shines along the {} that is object {}, and rounding decides "
                          "which of its points it reaches: move or turn one of them a little.",
                          grazing.light, Kind::noun, grazing.object));
      });
  }

  void say_what_is_displaced() {
    // Single is chosen below 1/64 pixel or less; what double moves by more than 1/1024 is at its
    // end.
    constexpr double usual_in_single_px = 1.0 / 64;
    constexpr double usual_in_double_px = 1.0 / 1024;
    const ArithmeticError& error = plan_.arithmetic_error;
    const bool is_single = plan_.precision.value != Precision::double_precision;
    // Where single is the plan's choice, it is as good as it need be.
    if (is_single && scene_.render.precision == Precision::automatic) return;
    const char* const help =
        is_single ? "ask for precision \"auto\" or \"double\""
                  : "double holds no more digits, so widen camera.fov, move the camera away from "
                    "the nearest surface, or make small mirrors larger";
    if (error.displacement_px > (is_single ? usual_in_single_px : usual_in_double_px))
      add(
          fmt::format("Rounding may displace edges, shadows or reflections by up to {:.2g} pixels: "
                      "{}.",
                      error.displacement_px, help));
    if (error.levels > 1)
      add(fmt::format("Rounding may change shaded surfaces by up to {:.2g} levels of 255: {}.",
                      error.levels,
                      is_single ? help : "lower the intensity of lights, or shininess"));
  }

  void say_what_is_small() {
    const double small = plan_.statistics.all.subpixel;
    const int samples = scene_.render.samples.value_or(1);
    if (!(small > 0) || scene_.render.target_rmse || scene_.render.budget_ms || samples > 1) return;
    const std::string objects = small < 1e18
                                    ? pluralised(static_cast<std::uint64_t>(small), "object")
                                    : fmt::format("{:.3g} objects", small);
    add(fmt::format(
        "Up to {} may be seen smaller than a pixel, and one sample a pixel misses such: "
        "ask for more samples or a target_rmse.",
        objects));
  }

  const Scene& scene_;
  const Plan& plan_;
  std::vector<std::string> strains_;
};

}  // namespace

std::vector<std::string> find_strains(const Scene& scene, const Plan& plan) {
  return Report(scene, plan).strains();
}

}  // namespace raytracer
