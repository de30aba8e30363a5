// The square of spheres against the same spheres one by one, and at a size that allows no list.

#include <gtest/gtest.h>

#include <vector>

#include "tests/support/cpu_stopwatch.h"
#include "tests/support/rays.h"

namespace raytracer::test {
namespace {

double& coordinate(Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// {first, second, across} of "xz", "xy" and "yz".
constexpr std::array<std::array<int, 3>, 3> all_axes{{{0, 2, 1}, {0, 1, 2}, {1, 2, 0}}};

PackedLattice square_of(const Vec3& center, double radius, std::int64_t n,
                        const std::array<int, 3>& axes) {
  return {center, radius, 2 * n, axes[0], axes[1], axes[2], {}};
}

/// The spheres that define a square, with indices in [i_begin, i_end) x [k_begin, k_end).
std::vector<PackedSphere> spheres_of(const PackedLattice& square, std::int64_t i_begin,
                                     std::int64_t i_end, std::int64_t k_begin, std::int64_t k_end) {
  std::vector<PackedSphere> spheres;
  for (std::int64_t i = i_begin; i < i_end; ++i) {
    for (std::int64_t k = k_begin; k < k_end; ++k) {
      Vec3 center = square.center;
      coordinate(center, square.first_axis) +=
          static_cast<double>(2 * i + 1 - square.side) * square.radius;
      coordinate(center, square.second_axis) +=
          static_cast<double>(2 * k + 1 - square.side) * square.radius;
      spheres.push_back(
          {center, square.radius, {0, static_cast<std::uint64_t>(i * square.side + k)}});
    }
  }
  return spheres;
}

/// Compares one ray; returns what the spheres answer, for a ray that leaves from there.
std::optional<SurfacePoint> expect_same_hit(const Ray& ray, const PackedLattice& square,
                                            const std::vector<PackedSphere>& spheres) {
  NearestHit of_spheres(ray);
  AnyHit any_of_spheres(ray, 5 * square.radius);
  for (const PackedSphere& sphere : spheres) {
    of_spheres.add(sphere);
    any_of_spheres.add(sphere);
  }
  NearestHit of_square(ray);
  of_square.add(square);
  AnyHit any_of_square(ray, 5 * square.radius);
  any_of_square.add(square);
  const Vec3 from = ray.origin.point();
  const auto where = [&] {
    return testing::Message() << "n " << square.side / 2 << " from " << from.x << ' ' << from.y
                              << ' ' << from.z << " along " << ray.direction.x << ' '
                              << ray.direction.y << ' ' << ray.direction.z;
  };
  EXPECT_EQ(of_square.found(), of_spheres.found()) << where();
  EXPECT_EQ(any_of_square.found(), any_of_spheres.found()) << where();
  if (!of_square.found() || !of_spheres.found()) return {};
  const double t = of_spheres.t_max();
  EXPECT_NEAR(of_square.t_max(), t, 1e-12 * (t + square.radius)) << where();
  if (std::abs(of_square.t_max() - t) > 0) return {};  // a touching point: either may answer
  if (of_square.point().id == of_spheres.point().id) {
    EXPECT_EQ(of_square.point().anchor, of_spheres.point().anchor) << where();
    EXPECT_EQ(of_square.point().normal, of_spheres.point().normal) << where();
  }
  return of_spheres.point();
}

class SquareOf : public testing::TestWithParam<std::tuple<std::size_t, std::int64_t>> {
 protected:
  const std::array<int, 3>& axes_ = all_axes[std::get<0>(GetParam())];
  std::int64_t n_ = std::get<1>(GetParam());
  PackedLattice square_ = square_of({0.3, -0.2, 0.1}, 0.7 / static_cast<double>(n_), n_, axes_);
  std::vector<PackedSphere> spheres_ = spheres_of(square_, 0, 2 * n_, 0, 2 * n_);
  Random random_{static_cast<std::uint64_t>(n_) + 100 * std::get<0>(GetParam())};

  /// A point by its coordinates on the three axes, relative to the centre.
  Vec3 place(double first, double second, double across) const {
    Vec3 point = square_.center;
    coordinate(point, axes_[0]) += first;
    coordinate(point, axes_[1]) += second;
    coordinate(point, axes_[2]) += across;
    return point;
  }
  double somewhere() { return random_.between(-1.6, 1.6); }
};

TEST_P(SquareOf, spheres_is_hit_like_the_spheres_by_rays_from_anywhere) {
  for (int i = 0; i < 3000; ++i)
    expect_same_hit(ray_towards(random_.point(-3, 3), place(somewhere(), somewhere(), 0)), square_,
                    spheres_);
  for (int i = 0; i < 1000; ++i)
    expect_same_hit(ray_from(random_.point(-3, 3), random_.direction()), square_, spheres_);
}

TEST_P(SquareOf, spheres_is_hit_like_the_spheres_by_rays_that_leave_them) {
  int left = 0;
  for (int i = 0; i < 1500; ++i) {
    const Vec3 target = place(random_.between(-1.4, 1.4), random_.between(-1.4, 1.4), 0);
    const auto surface =
        expect_same_hit(ray_towards(random_.point(-3, 3), target), square_, spheres_);
    if (!surface) continue;
    ++left;
    Vec3 direction = random_.direction();
    if (dot(direction, surface->normal) < 0) direction = -direction;
    expect_same_hit(ray_leaving(*surface, direction), square_, spheres_);
  }
  EXPECT_GT(left, 700);
}

TEST_P(SquareOf, spheres_is_hit_like_the_spheres_from_inside_of_one) {
  for (int i = 0; i < 1000; ++i) {
    const PackedSphere& sphere = spheres_[random_.below(spheres_.size())];
    const Vec3 inside =
        sphere.center + random_.between(0, 0.999) * sphere.radius * random_.direction();
    const auto surface = expect_same_hit(ray_from(inside, random_.direction()), square_, spheres_);
    if (!surface) continue;
    Vec3 direction = random_.direction();
    if (dot(direction, surface->normal) < 0) direction = -direction;
    expect_same_hit(ray_leaving(*surface, direction), square_, spheres_);
  }
}

TEST_P(SquareOf, spheres_is_hit_like_the_spheres_by_rays_along_the_axes) {
  const double r = square_.radius;
  for (int i = 0; i < 1000; ++i) {
    for (const int axis : axes_) {
      Vec3 direction;
      coordinate(direction, axis) = random_.below(2) == 0 ? 1 : -1;
      // On a centre line, beside a border between rows, or anywhere. On a border itself the ray
      // is a tangent, and rounding decides.
      const auto offset = [&] {
        const auto step = static_cast<double>(random_.below(static_cast<std::size_t>(4 * n_ + 3))) -
                          2 * static_cast<double>(n_) - 1;
        const double beside = random_.below(2) == 0 ? 1e-6 : -1e-6;
        return random_.below(3) == 0 ? somewhere() : (step + beside * std::fmod(step + 1, 2)) * r;
      };
      const double height = random_.below(2) == 0 ? 0 : random_.between(-1.1, 1.1) * r;
      Vec3 origin = place(offset(), offset(), height);
      if (random_.below(2) == 0) coordinate(origin, axis) -= 5 * coordinate(direction, axis);
      expect_same_hit(ray_from(origin, direction), square_, spheres_);
    }
  }
}

TEST_P(SquareOf, spheres_is_hit_like_the_spheres_by_rays_along_its_plane) {
  for (int i = 0; i < 2000; ++i) {
    const double height = random_.between(-1, 1) * square_.radius;
    const double angle = random_.between(0, 2 * std::numbers::pi);
    Vec3 direction = place(std::cos(angle), std::sin(angle), 0) - place(0, 0, 0);
    if (i % 2 == 0)
      coordinate(direction, axes_[2]) = random_.magnitude(-18, -3);
    else
      coordinate(direction, axes_[2]) = 0;
    expect_same_hit(ray_from(place(2 * somewhere(), 2 * somewhere(), height), direction), square_,
                    spheres_);
  }
}

TEST_P(SquareOf, spheres_is_hit_like_the_spheres_from_far_away) {
  for (int i = 0; i < 1000; ++i)
    expect_same_hit(ray_towards(std::abs(random_.magnitude(1, 5)) * random_.direction(),
                                place(somewhere(), somewhere(), 0)),
                    square_, spheres_);
}

std::string name_of(const testing::TestParamInfo<std::tuple<std::size_t, std::int64_t>>& row) {
  constexpr std::array<const char*, 3> names{"Xz", "Xy", "Yz"};
  return names[std::get<0>(row.param)] + std::to_string(std::get<1>(row.param));
}

INSTANTIATE_TEST_SUITE_P(AllAxes, SquareOf,
                         testing::Combine(testing::Range<std::size_t>(0, 3),
                                          testing::Values(1, 2, 14)),
                         name_of);

constexpr std::int64_t billion = 1'000'000'000;

TEST(SquareOfABillion, is_hit_at_the_right_sphere_at_once) {
  const CpuStopwatch watch;
  for (const auto& axes : all_axes) {
    const PackedLattice square = square_of({}, 1, billion, axes);
    for (const std::int64_t index : {std::int64_t{0}, std::int64_t{7}, billion - 1, billion,
                                     billion + 12345, 2 * billion - 1}) {
      Vec3 origin;
      coordinate(origin, axes[0]) = static_cast<double>(2 * index + 1 - square.side);
      coordinate(origin, axes[1]) = 1;
      coordinate(origin, axes[2]) = 5;
      Vec3 down;
      coordinate(down, axes[2]) = -1;
      const Ray ray = ray_from(origin, down);
      NearestHit query(ray);
      query.add(square);
      ASSERT_TRUE(query.found()) << index << " on axis " << axes[0];
      EXPECT_EQ(query.t_max(), 4);
      EXPECT_EQ(query.point().id.item, static_cast<std::uint64_t>(index * square.side + billion));
    }
  }
  EXPECT_LT(watch.elapsed_ms(), 100);
}

TEST(SquareOfABillion, is_hit_like_the_spheres_nearby) {
  Random random(12);
  double in_square_ms = 0;
  for (const auto& axes : all_axes) {
    const PackedLattice square = square_of({}, 0.5, billion, axes);
    const std::vector<PackedSphere> near =
        spheres_of(square, billion - 12, billion + 12, billion - 12, billion + 12);
    for (int i = 0; i < 500; ++i) {
      Vec3 origin = random.point(-1, 1);
      coordinate(origin, axes[2]) = random.magnitude(-0.1, 0.5) * 2;
      const Ray ray = ray_towards(origin, random.point(-3, 3) * 0.3);
      const CpuStopwatch watch;
      NearestHit query(ray);
      query.add(square);
      in_square_ms += watch.elapsed_ms();
      if (query.found() && query.t_max() < 8) expect_same_hit(ray, square, near);
    }
  }
  EXPECT_LT(in_square_ms, 500);
}

TEST(SquareOfABillion, is_crossed_almost_in_its_plane_at_once) {
  Random random(13);
  const PackedLattice square = square_of({}, 1, billion, all_axes[0]);
  const CpuStopwatch watch;
  for (int i = 0; i < 100; ++i) {
    const double angle = random.between(0, 2 * std::numbers::pi);
    const double height = random.between(-0.999, 0.999);
    const Ray ray = ray_from({-1e6, height, 3e5},
                             {std::cos(angle), random.magnitude(-15, -9), std::sin(angle)});
    NearestHit query(ray);
    query.add(square);
    EXPECT_TRUE(query.found());
  }
  EXPECT_LT(watch.elapsed_ms(), 500);
}

TEST(SquareOfMany, is_crossed_in_the_tangent_plane_of_its_spheres_at_once) {
  // One ray of a photograph with the horizon at the spheres' tops. A walk over all rows would take
  // minutes for n = 1e9; here n is such that it is merely too long.
  const PackedLattice square = square_of({}, 1, 10'000'000, all_axes[0]);
  const CpuStopwatch watch;
  const Ray ray = ray_from({-3e7, 1, -2e7}, {1, 0, 0.7123});
  AnyHit query(ray, 1e30);
  query.add(square);
  EXPECT_LT(watch.elapsed_ms(), 100);
}

}  // namespace
}  // namespace raytracer::test
