// What is left out of the exact pictures' searches is missed by numbers of 113 bits as well.
#include "tests/extremes/rough_ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace raytracer::extremes {
namespace {

/// Draws scenes of one sphere and one plane, of sizes and places sixteen orders of magnitude apart,
/// and rays that all but touch them.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  double size() { return std::pow(10, between(-8, 8)); }
  Vec3 place() {
    const double scale = size();
    return {scale * between(-1, 1), scale * between(-1, 1), scale * between(-1, 1)};
  }
  /// So little that even numbers of 113 bits are hardly changed by it, or more; of either sign.
  Quad little() { return (between(-1, 1) < 0 ? -1 : 1) * Quad{std::pow(10, between(-30, -5))}; }
  /// All but touches a sphere that is seen at `center`, if that is not around the eye.
  QuadVec past(const QuadVec& center, Quad radius) {
    const Quad sine = radius / length(center) * (1 + little());
    const QuadVec aside = unit(cross(center, QuadVec(place())));
    return sine < 1 ? unit(center) * square_root(1 - sine * sine) + aside * sine : aside;
  }
  /// All but on a plane through `point`.
  QuadVec at(const QuadVec& point, const QuadVec& normal) {
    return point + unit(normal) * (length(point) * little());
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  std::mt19937 random_;
};

/// How many of a sphere and a plane were left out; `nearly` draws what is all but met.
int count_left_out(Draw& draw, bool nearly) {
  const Vec3 eye = draw.place();
  const Plane plane{draw.place(), draw.place()};
  const QuadVec normal(plane.normal);
  const QuadVec point = QuadVec(plane.point) - QuadVec(eye);
  const QuadVec from = nearly ? draw.at(point, normal) : QuadVec(draw.place());
  const Vec3 center = draw.place();
  const Quad radius = draw.size();
  const QuadVec f = QuadVec(center) - QuadVec(eye) - from;
  const QuadVec direction = nearly ? draw.past(f, radius) : unit(QuadVec(draw.place()));
  const RoughRay ray(eye, from, direction);
  int left_out = 0;
  if (ray.passes_by(center, static_cast<long double>(radius))) {
    ++left_out;
    const Quad along = dot(f, direction);
    const QuadVec across = f - direction * along;
    EXPECT_TRUE(dot(f, f) > radius * radius);
    EXPECT_TRUE(along < 0 || dot(across, across) > radius * radius);
  }
  const Quad t = dot(normal, point - from) / dot(normal, direction);
  const Quad end = nearly ? absolute(t) * (1 + draw.little()) : Quad{draw.size()};
  if (ray.does_not_reach(plane, end)) {
    ++left_out;
    EXPECT_TRUE(t < 0 || t > end);
  }
  return left_out;
}

TEST(RoughRay, leaves_out_only_what_is_missed) {
  Draw draw(1);
  int left_out = 0;
  for (int i = 0; i < 20'000; ++i) {
    SCOPED_TRACE(i);
    left_out += count_left_out(draw, false);
    count_left_out(draw, true);
  }
  EXPECT_GT(left_out, 10'000);
}

}  // namespace
}  // namespace raytracer::extremes
