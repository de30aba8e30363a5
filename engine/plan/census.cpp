#include "engine/plan/census.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>
#include <vector>

#include "engine/math/block.h"
#include "engine/parallel/chunks.h"
#include "engine/plan/coincidence.h"
#include "engine/plan/magnification.h"
#include "engine/plan/sphere_tally.h"
#include "engine/plan/view.h"

namespace raytracer {
namespace {

/// The distance from the origin to the nearest of a square's spheres near the eye, or to the box
/// around all of them where that is far.
double distance_to_square(const SphereSquare& s, const Vec3& center, double r) {
  // The square's own axes: first, across, second.
  const Vec3 p = s.axes == Axes::xz   ? Vec3{-center.x, -center.y, -center.z}
                 : s.axes == Axes::xy ? Vec3{-center.x, -center.z, -center.y}
                                      : Vec3{-center.y, -center.x, -center.z};
  const double half = 2 * static_cast<double>(s.n) * r;
  const Vec3 outside{std::max(std::abs(p.x) - half, 0.0), std::max(std::abs(p.y) - r, 0.0),
                     std::max(std::abs(p.z) - half, 0.0)};
  const double to_box = length(outside);
  if (to_box > 0) return to_box;
  // Between the spheres: the nearest is in the eye's cell or a neighbouring one.
  const auto nearest_center = [&](double place, int neighbour) {
    const double cell = std::floor(place / (2 * r)) + neighbour;
    return (2 * cell + 1) * r;
  };
  double nearest = std::numeric_limits<double>::infinity();
  for (const int i : {-1, 0, 1})
    for (const int k : {-1, 0, 1})
      nearest = std::min(
          nearest, length({p.x - nearest_center(p.x, i), p.y, p.z - nearest_center(p.z, k)}) - r);
  return nearest;
}

/// A ball around a triangle, and a lower bound of the origin's distance to the triangle: that of
/// the ball or of the plane.
struct TriangleBall {
  double reach;
  double distance;

  TriangleBall(const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 middle = (a + b + c) / 3;
    reach = std::max({length(a - middle), length(b - middle), length(c - middle)});
    const double to_plane = std::abs(dot(unit(cross(b - a, c - a)), a));
    distance = std::max(to_plane, length(middle) - reach);
  }
};

/// At the image's middle.
double pixel_angle(const Camera& camera) {
  return 2 * std::abs(std::tan(camera.fov / 2)) / camera.width;
}

class Counter {
 public:
  Counter(const Frame& frame, const Camera& camera, WorkerPool* pool, Census& census)
      : frame_(frame),
        pool_(pool),
        census_(census),
        pixel_angle_(pixel_angle(camera)),
        blocks_per_radian_(stretch(camera) / (block_side * pixel_angle(camera))),
        block_columns_(1 + static_cast<double>(camera.width) / block_side),
        block_rows_(1 + static_cast<double>(camera.height) / block_side) {}

  /// All objects, once.
  void count_all(const SharedArray<Object>& objects) {
    for (const Object& object : objects)
      std::visit([&](const auto& shape) { (*this)(shape); }, object.shape);
    add(single_spheres_);
  }

  void operator()(const Sphere& s) { count(s.center, s.radius, single_spheres_); }

  void operator()(const Spheres& s) {
    // In as many parts whatever the number of threads: the sums are the same.
    std::array<SphereTally, 16> tallies;
    const std::size_t part_count = s.centers.size() < few_items ? 1 : tallies.size();
    const auto count_part = [&](std::size_t part, std::size_t begin, std::size_t end) {
      SphereTally tally;
      for (std::size_t i = begin; i < end; ++i) count(s.centers[i], s.radius(i), tally);
      tallies[part] = tally;
    };
    for_each_chunk(s.centers.size(), part_count, pool_, count_part);
    for (std::size_t part = 0; part < part_count; ++part) add(tallies[part]);
  }

  void operator()(const SphereSquare& s) {
    const Vec3 center = frame_.frame_from_scene(s.center);
    const double r = frame_.frame_from_scene(s.radius);
    if (is_lost(r)) return;
    const double reach = length(center) + 2 * std::sqrt(2.0) * static_cast<double>(s.n) * r + r;
    const double distance = distance_to_square(s, center, r);
    approach(distance);
    clearance_of_structures_ = std::min(clearance_of_structures_, std::abs(distance));
    census_.farthest = std::max(census_.farthest, reach);
    census_.distance_in_radii = std::max(census_.distance_in_radii, reach / r);
    census_.coarseness =
        std::max(census_.coarseness, max_abs(s.center) * step_of_doubles / s.radius);
    if (2 * r < reach * pixel_angle_) {  // none of them is farther
      census_.small_spheres += 4 * std::pow(static_cast<double>(s.n), 2);
      census_.has_small_squares = true;
    }
  }

  void operator()(const Plane& p) {
    const double height = std::abs(dot(unit(p.normal), frame_.frame_from_scene(p.point)));
    approach(height);
  }

  void operator()(const Mesh& m) {
    std::vector<Vec3> vertices;
    vertices.reserve(m.vertices.size());
    for (const Vec3& vertex : m.vertices) {
      vertices.push_back(frame_.frame_from_scene(vertex));
      add(std::numeric_limits<double>::infinity(), length(vertices.back()));
    }
    for (const auto& corners : m.triangles) {
      const Vec3& a = vertices[corners[0]];
      const Vec3& b = vertices[corners[1]];
      const Vec3& c = vertices[corners[2]];
      if (is_lost(std::max({max_abs(a), max_abs(b), max_abs(c)}))) continue;
      const TriangleBall ball(a, b, c);
      add(std::max(ball.distance, 0.0), 0);
      clearance_of_structures_ = std::min(clearance_of_structures_, std::max(ball.distance, 0.0));
      census_.triangle_blocks += blocks(ball.reach / ball.distance);
    }
  }

  double farthest_but_squares() const { return farthest_but_squares_; }
  /// Of triangles and squares.
  double clearance_of_structures() const { return clearance_of_structures_; }

 private:
  bool is_lost(double size) {
    if (!Frame::carries(size)) {
      census_.lost += 1;
      return true;
    }
    census_.smallest = std::min(census_.smallest, size);
    return false;
  }

  /// To a surface; negative inside of it.
  void approach(double distance) {
    census_.nearest = std::min(census_.nearest, std::max(distance, 0.0));
    census_.clearance = std::min(census_.clearance, std::abs(distance));
  }

  void add(double nearest, double farthest) {
    approach(nearest);
    census_.farthest = std::max(census_.farthest, farthest);
    farthest_but_squares_ = std::max(farthest_but_squares_, farthest);
  }

  void count(const Vec3& scene_center, double scene_radius, SphereTally& tally) const {
    const double r = frame_.frame_from_scene(scene_radius);
    if (!Frame::carries(r)) {
      tally.lost += 1;
      return;
    }
    const double distance = length(frame_.frame_from_scene(scene_center));
    const double sine = r / distance;
    tally.note_distance(distance, r, sine);
    tally.note_place(scene_center, scene_radius);
    if (2 * r < distance * pixel_angle_) tally.small += 1;
    tally.blocks += blocks(tangent_seen(distance, r, sine));
  }

  void add(const SphereTally& tally) {
    census_.lost += tally.lost;
    census_.smallest = std::min(census_.smallest, tally.smallest);
    census_.nearest = std::min(census_.nearest, std::max(tally.nearest, 0.0));
    census_.clearance = std::min(census_.clearance, tally.clearance);
    census_.farthest = std::max(census_.farthest, tally.farthest);
    farthest_but_squares_ = std::max(farthest_but_squares_, tally.farthest);
    census_.distance_in_radii = std::max(census_.distance_in_radii, tally.distance_in_radii);
    census_.coarseness = std::max(census_.coarseness, tally.place_in_radii * step_of_doubles);
    census_.small_spheres += tally.small;
    census_.sphere_blocks += tally.blocks;
  }

  /// That something touches which is seen under twice this angle; its tangent.
  double blocks(double half_angle) const {
    const double across = 2 * half_angle * blocks_per_radian_ + 1;
    return std::min(across, block_columns_) * std::min(across, block_rows_);
  }

  /// How much larger a thing is in the image's corner than in its middle.
  static double stretch(const Camera& camera) {
    const double half_width = std::tan(camera.fov / 2);
    const double half_height = half_width * camera.height / camera.width;
    return 1 + half_width * half_width + half_height * half_height;
  }

  const Frame& frame_;
  WorkerPool* pool_;
  Census& census_;
  double pixel_angle_;
  double blocks_per_radian_;
  double block_columns_;
  double block_rows_;
  SphereTally single_spheres_{};
  double farthest_but_squares_ = 0;
  double clearance_of_structures_ = std::numeric_limits<double>::infinity();
};

/// How high above or below a square's spheres anything else may receive their shadow: heights over
/// the plane through its centre; the farthest extent where that is not known.
double receiver_height(const Scene& scene, const Frame& frame, const SphereSquare& square,
                       double farthest) {
  const Vec3 axis = axis_across(square);
  const Vec3 center = frame.frame_from_scene(square.center);
  double highest = 0;
  const auto height_of = [&](const Vec3& point) {
    return std::abs(dot(axis, frame.frame_from_scene(point) - center));
  };
  for (const Object& object : scene.objects) {
    if (const auto* sphere = std::get_if<Sphere>(&object.shape)) {
      highest =
          std::max(highest, height_of(sphere->center) + frame.frame_from_scene(sphere->radius));
    } else if (const auto* plane = std::get_if<Plane>(&object.shape)) {
      const bool parallel = cross(unit(plane->normal), axis) == Vec3{};
      highest = std::max(highest, parallel ? height_of(plane->point) : farthest);
    } else if (const auto* other = std::get_if<SphereSquare>(&object.shape)) {
      if (other == &square) continue;
      const double cells = axis_across(*other) == axis ? 1 : 2 * static_cast<double>(other->n);
      highest = std::max(highest,
                         height_of(other->center) + cells * frame.frame_from_scene(other->radius));
    } else {
      highest = std::max(highest, farthest);
    }
  }
  return highest;
}

/// The longest way from a point to an occluder that can matter. A square shadows itself from cell
/// to cell, which no distance makes less accurate; other things it shadows only from as far as a
/// light's slope takes a ray from their height to the square's. Of very many objects it is not
/// known.
double shadow_path(const Scene& scene, const Frame& frame, std::size_t square_count,
                   double farthest, double farthest_but_squares) {
  constexpr double most_pairs = 1e7;  // a few hundredths of a second
  const auto squares = static_cast<double>(square_count);
  if (squares * static_cast<double>(scene.objects.size()) > most_pairs)
    return std::max(farthest_but_squares, 2 * farthest);
  double longest = farthest_but_squares;
  for (const Object& object : scene.objects) {
    const auto* square = std::get_if<SphereSquare>(&object.shape);
    if (square == nullptr) continue;
    const Vec3 axis = axis_across(*square);
    const double height = receiver_height(scene, frame, *square, farthest) +
                          2 * frame.frame_from_scene(square->radius);
    for (const Light& light : scene.lights) {
      const auto* distant = std::get_if<DistantLight>(&light.source);
      const double slope = distant ? std::abs(dot(unit(distant->direction), axis)) : 0;
      longest = std::max(longest, std::min(height / slope, 2 * farthest));
    }
  }
  return longest;
}

/// How far from the eye points of planes are in view.
double reach_of_planes(const Scene& scene, const Frame& frame) {
  constexpr double pixels_to_horizon = 1.0 / 16;
  const double to_horizon = pixels_to_horizon * pixel_angle(scene.camera);
  const View view = make_view(scene.camera);
  const auto width = static_cast<double>(view.width);
  const auto height = static_cast<double>(view.height);
  double reach = 0;
  for (const Object& object : scene.objects) {
    const auto* plane = std::get_if<Plane>(&object.shape);
    if (plane == nullptr) continue;
    const Vec3 normal = unit(plane->normal);
    const double above = dot(normal, frame.frame_from_scene(plane->point));
    for (const Vec3& corner : {view.direction(0, 0), view.direction(width, 0),
                               view.direction(0, height), view.direction(width, height)}) {
      // Of a corner over the horizon, or nearly: as far as can be told from the horizon.
      const double sine = above > 0 ? dot(normal, corner) : -dot(normal, corner);
      reach = std::max(reach, std::abs(above) / std::max(sine, to_horizon));
    }
  }
  return reach;
}

}  // namespace

Census take_census(const Scene& scene, const Frame& frame, const Features& features,
                   WorkerPool* pool) {
  Census census;
  Counter counter(frame, scene.camera, pool, census);
  counter.count_all(scene.objects);
  for (const Light& light : scene.lights) {
    const auto* point = std::get_if<PointLight>(&light.source);
    if (point == nullptr) continue;
    census.farthest = std::max(census.farthest, length(frame.frame_from_scene(point->position)));
  }
  const double planes_reach = reach_of_planes(scene, frame);
  // What the eye's distances are to the eye, a light's are to the light.
  for (const Light& light : scene.lights) {
    const auto* point = std::get_if<PointLight>(&light.source);
    const double emitted = max_abs(light.color) * light.intensity;
    if (point == nullptr) {
      census.brightest = std::max(census.brightest, emitted);
      continue;
    }
    Census around_light;
    const Frame light_frame(point->position, frame.exponent());
    Counter light_counter(light_frame, scene.camera, pool, around_light);
    light_counter.count_all(scene.objects);
    census.light_clearance =
        std::min(census.light_clearance, around_light.clearance / census.farthest);
    census.shadow_spread = std::max(
        census.shadow_spread, std::max(around_light.farthest, census.farthest + planes_reach) /
                                  light_counter.clearance_of_structures());
    const double clearance = std::ldexp(around_light.clearance, frame.exponent());
    census.brightest =
        std::max(census.brightest, emitted / (4 * std::numbers::pi) / clearance / clearance);
  }
  census.shadow_path =
      shadow_path(scene, frame, features.squares, census.farthest, counter.farthest_but_squares());
  if (features.reflects)
    census.magnification = magnification(scene, frame, features, census.farthest);
  census.gap = least_gap(scene, frame);
  census.pixel_angle = pixel_angle(scene.camera);
  return census;
}

}  // namespace raytracer
