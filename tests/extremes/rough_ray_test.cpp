// What is left out of the exact pictures' searches is missed by numbers of 113 bits as well.
#include "tests/extremes/rough_ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace raytracer::extremes {
namespace {

/// Draws scenes of one sphere and one plane, of sizes and places sixteen orders of magnitude apart.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}

  double size() { return std::pow(10, between(-8, 8)); }
  Vec3 place() {
    const double scale = size();
    return {scale * between(-1, 1), scale * between(-1, 1), scale * between(-1, 1)};
  }

 private:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  std::mt19937 random_;
};

TEST(RoughRay, leaves_out_only_what_is_missed) {
  Draw draw(1);
  int left_out = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 eye = draw.place();
    const QuadVec from(draw.place());
    const QuadVec direction = unit(QuadVec(draw.place()));
    const RoughRay ray(eye, from, direction);

    const Vec3 center = draw.place();
    const Quad radius = draw.size();
    const QuadVec f = QuadVec(center) - QuadVec(eye) - from;
    const Quad along = dot(f, direction);
    const QuadVec across = f - direction * along;
    if (ray.passes_by(center, static_cast<long double>(radius))) {
      ++left_out;
      EXPECT_TRUE(dot(f, f) > radius * radius) << i;
      EXPECT_TRUE(along < 0 || dot(across, across) > radius * radius) << i;
    }

    const Plane plane{draw.place(), draw.place()};
    const QuadVec normal(plane.normal);
    const Quad t = dot(normal, QuadVec(plane.point) - QuadVec(eye) - from) / dot(normal, direction);
    const Quad end = draw.size();
    if (ray.does_not_reach(plane, end)) {
      ++left_out;
      EXPECT_TRUE(t < 0 || t > end) << i;
    }
  }
  EXPECT_GT(left_out, 10'000);
}

}  // namespace
}  // namespace raytracer::extremes
