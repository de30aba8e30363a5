#include "client/formats/arrange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "client/failure.h"
#include "client/formats/lighting.h"
#include "client/formats/triple.h"

namespace raytracer::client {
namespace {

using model::Triple;

using Axes = std::array<Triple, 3>;

/// Calls `visit` with balls that hold all of the scene: centres and radii.
template <typename Visit>
void each_ball(const model::Scene& scene, Visit visit) {
  const auto ends = [&](const auto& from, const auto& to, const auto& from_radii,
                        const auto& to_radii) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      visit(from[i], from_radii[i]);
      visit(to[i], to_radii[i]);
    }
  };
  struct Balls {
    Visit& visit;
    decltype(ends)& ends_of;
    void operator()(const model::Spheres& all) const {
      for (std::size_t i = 0; i < all.centers.size(); ++i) visit(all.centers[i], all.radii[i]);
    }
    void operator()(const model::Cylinders& all) const {
      ends_of(all.from, all.to, all.radii, all.radii);
    }
    void operator()(const model::Cones& all) const {
      ends_of(all.from, all.to, all.radii_from, all.radii_to);
    }
    void operator()(const model::Mesh& mesh) const {
      for (const Triple& vertex : mesh.vertices) visit(vertex, 0.0);
    }
  };
  for (const model::Objects& objects : scene.objects) std::visit(Balls{visit, ends}, objects.shape);
}

/// Along some axes, around all balls.
struct Box {
  Axes axes{};
  Triple low{};
  Triple high{};

  Triple size() const { return {high[0] - low[0], high[1] - low[1], high[2] - low[2]}; }
  Triple center() const {
    Triple point{};
    for (std::size_t i = 0; i < 3; ++i)
      point = sum(point, scaled(axes[i], low[i] / 2 + high[i] / 2));
    return point;
  }
};

Box box_around(const model::Scene& scene, const Axes& axes) {
  constexpr double most = std::numeric_limits<double>::max();
  Box box{axes, {most, most, most}, {-most, -most, -most}};
  each_ball(scene, [&](const Triple& center, double radius) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double place = dot(center, axes[i]);
      box.low[i] = std::min(box.low[i], place - radius);
      box.high[i] = std::max(box.high[i], place + radius);
    }
  });
  return box;
}

/// The eigenvectors of a symmetric matrix, by C. Jacobi's rotations.
Axes eigenvectors(std::array<Triple, 3> matrix) {
  Axes vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  constexpr int sweeps = 20;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (const auto& [p, q] : {std::pair{0U, 1U}, std::pair{0U, 2U}, std::pair{1U, 2U}}) {
      if (std::abs(matrix[p][q]) < 1e-15) continue;
      const double theta = (matrix[q][q] - matrix[p][p]) / (2 * matrix[p][q]);
      const double t = std::copysign(1, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
      const double c = 1 / std::sqrt(t * t + 1);
      const double s = t * c;
      for (std::size_t k = 0; k < 3; ++k) {
        const double kp = matrix[k][p];
        const double kq = matrix[k][q];
        matrix[k][p] = c * kp - s * kq;
        matrix[k][q] = s * kp + c * kq;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const double pk = matrix[p][k];
        const double qk = matrix[q][k];
        matrix[p][k] = c * pk - s * qk;
        matrix[q][k] = s * pk + c * qk;
      }
      const Triple before = vectors[p];
      vectors[p] = sum(scaled(before, c), scaled(vectors[q], -s));
      vectors[q] = sum(scaled(before, s), scaled(vectors[q], c));
    }
  return vectors;
}

/// Of the balls' centres. `box` gives a measure, so that nothing overflows.
Axes principal_axes(const model::Scene& scene, const Box& box) {
  const Triple middle = box.center();
  const Triple size = box.size();
  const double scale = std::max({size[0], size[1], size[2]});
  std::array<Triple, 3> moments{};
  Triple mean{};
  double count = 0;
  each_ball(scene, [&](const Triple& center, double) {
    const Triple place{(center[0] - middle[0]) / scale, (center[1] - middle[1]) / scale,
                       (center[2] - middle[2]) / scale};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) moments[i][j] += place[i] * place[j];
    mean = sum(mean, place);
    ++count;
  });
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      moments[i][j] = moments[i][j] / count - mean[i] / count * mean[j] / count;
  return eigenvectors(moments);
}

/// The box whose axes are the longest, the middle and the shortest side.
Box sorted(Box box) {
  std::array<std::size_t, 3> order{0, 1, 2};
  const Triple size = box.size();
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
  const Box before = box;
  for (std::size_t i = 0; i < 3; ++i) {
    box.axes[i] = before.axes[order[i]];
    box.low[i] = before.low[order[i]];
    box.high[i] = before.high[order[i]];
  }
  return box;
}

double volume(const Box& box) {
  const Triple size = box.size();
  const double scale = std::max({size[0], size[1], size[2]});
  return size[0] / scale * size[1] / scale * size[2];
}

/// Where the eye stands, seen from the object, and what is up.
struct Standpoint {
  Triple towards_eye;
  Triple up;
};

/// A box's shadow in the direction n is the sum of n's components times the sides across them: it
/// is largest where n is in proportion to these.
Triple largest_shadow(const Triple& size) {
  const double scale = std::max({size[0], size[1], size[2]});
  const Triple side{size[0] / scale, size[1] / scale, size[2] / scale};
  return {side[1] * side[2], side[0] * side[2], side[0] * side[1]};
}

Standpoint upright_standpoint(const Box& box, std::size_t up_axis) {
  Triple n = largest_shadow(box.size());
  // What stands is looked at from the front, and from above by half a right angle at most.
  const std::size_t right_axis = 0;
  const std::size_t front_axis = up_axis == 1 ? 2 : 1;
  n[up_axis] = std::min(n[up_axis], std::hypot(n[right_axis], n[front_axis]));
  if (n[right_axis] == 0 && n[front_axis] == 0) n[front_axis] = n[up_axis] = 1;
  if (up_axis == 2) n[front_axis] = -n[front_axis];
  return {unit(n), box.axes[up_axis]};
}

Standpoint best_standpoint(const model::Scene& scene, Upright upright) {
  const Box straight = box_around(scene, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  const Triple size = straight.size();
  if (!(std::max({size[0], size[1], size[2]}) > 0)) throw InputError("has nothing with an extent");
  if (upright != Upright::none) return upright_standpoint(straight, upright == Upright::y ? 1 : 2);
  const Box own = box_around(scene, principal_axes(scene, straight));
  // Twenty percent: atoms stand out of any box, and axes are what a file's author had in mind.
  const Box best = sorted(volume(own) < 0.8 * volume(straight) ? own : straight);
  const Triple n = largest_shadow(best.size());
  Triple towards{};
  for (std::size_t i = 0; i < 3; ++i) towards = sum(towards, scaled(best.axes[i], n[i]));
  return {unit(towards), best.axes[1]};
}

/// How near the eye may be for balls to lie within each side of the picture. A ball touches the
/// plane through the eye and a side where the depth lets through as much as its place across, and
/// its radius over the plane's slope.
struct FrameFit {
  Triple right;
  Triple above;
  Triple towards_eye;
  double tangent_right;
  double tangent_up;
  std::array<double, 4> reach{none, none, none, none};  ///< left, right, below, above
  double x = 0;                                         ///< where the eye is, across
  double y = 0;

  static constexpr double none = -std::numeric_limits<double>::max();

  void add(const Triple& place, double radius) {
    const double depth = dot(place, towards_eye);
    const auto widen = [&](double& side, double across, double tangent) {
      side = std::max(side, depth + (across + radius * std::sqrt(1 + tangent * tangent)) / tangent);
    };
    widen(reach[0], -dot(place, right), tangent_right);
    widen(reach[1], dot(place, right), tangent_right);
    widen(reach[2], -dot(place, above), tangent_up);
    widen(reach[3], dot(place, above), tangent_up);
  }

  /// Moves the eye to where both sides are as near.
  void center() {
    x = (reach[1] / 2 - reach[0] / 2) * tangent_right;
    y = (reach[3] / 2 - reach[2] / 2) * tangent_up;
    reach[0] = reach[1] = reach[0] / 2 + reach[1] / 2;
    reach[2] = reach[3] = reach[2] / 2 + reach[3] / 2;
  }

  double distance() const { return *std::max_element(reach.begin(), reach.end()); }
};

/// As far as the eye has to be from a place for rounding not to swallow it; that far if `distance`
/// is less.
double discernible(double distance, const Triple& place) {
  const double largest = std::max({std::abs(place[0]), std::abs(place[1]), std::abs(place[2])});
  const double least = 16 * std::numeric_limits<double>::epsilon() * largest;
  const double enough = std::max(distance, least);
  return enough > 0 ? enough : 1;
}

double zoomed(double fov, double zoom) { return 2 * std::atan(std::tan(fov / 2) / zoom); }

}  // namespace

model::View view_of_all(const model::Scene& scene, const ImportOptions& options, Upright upright) {
  constexpr double fov = 0.5;
  constexpr double margin = 1.06;
  const Standpoint best = best_standpoint(scene, upright);
  const Triple towards_eye = options.view ? unit(*options.view) : best.towards_eye;
  Triple up = best.up;
  if (options.view) up = upright == Upright::y ? Triple{0, 1, 0} : Triple{0, 0, 1};
  constexpr double nearly_parallel = 0.999;
  if (std::abs(dot(up, towards_eye)) > nearly_parallel)
    up = std::abs(up[2]) > 0.5 ? Triple{0, 1, 0} : Triple{0, 0, 1};
  const Triple right = unit(cross(up, towards_eye));
  const Triple above = cross(towards_eye, right);

  const Box along = box_around(scene, {right, above, towards_eye});
  const Triple pivot = along.center();
  const double tangent_right = std::tan(fov / 2) / margin;
  FrameFit fit{right, above, towards_eye, tangent_right,
               tangent_right * options.height_px / options.width_px};
  each_ball(scene, [&](const Triple& center, double radius) {
    const Triple place = difference(center, pivot);
    if (!options.is_turned) return fit.add(place, radius);
    constexpr int turns = 16;
    for (int i = 0; i < turns; ++i)
      fit.add(turned(place, up, 2 * std::numbers::pi * i / turns), radius);
  });
  // What turns stays where its axis is.
  if (!options.is_turned) fit.center();

  model::View view{};
  view.at = sum(pivot, sum(scaled(right, fit.x), scaled(above, fit.y)));
  view.from = sum(view.at, scaled(towards_eye, discernible(fit.distance(), view.at)));
  view.up = up;
  view.fov = zoomed(fov, options.zoom);
  view.width_px = options.width_px;
  view.height_px = options.height_px;
  return view;
}

model::View view_through(const model::Camera& camera, const model::Scene& scene,
                         const ImportOptions& options) {
  const Triple ahead = unit(camera.ahead);
  const Box box = box_around(scene, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  const double radius = std::sqrt(dot(box.size(), box.size())) / 2;
  double distance = dot(difference(box.center(), camera.from), ahead);
  // What is behind the eye, or in it, is nothing to look at.
  constexpr double least = 0.01;
  if (!(distance > least * radius)) distance = radius;
  model::View view{};
  view.from = camera.from;
  view.at = sum(camera.from, scaled(ahead, discernible(distance, camera.from)));
  view.up = camera.up;
  const double width =
      2 * std::atan(std::tan(camera.fov / 2) * options.width_px / options.height_px);
  view.fov = zoomed(width, options.zoom);
  view.width_px = options.width_px;
  view.height_px = options.height_px;
  return view;
}

bool is_all_in_view(const model::Scene& scene) {
  const model::View& view = scene.view;
  const Triple ahead = unit(difference(view.at, view.from));
  const Triple right = unit(cross(ahead, view.up));
  const Triple above = cross(right, ahead);
  const double tangent_right = std::tan(view.fov / 2);
  const double tangent_up = tangent_right * view.height_px / view.width_px;
  bool is_in_view = true;
  each_ball(scene, [&](const Triple& center, double) {
    const Triple place = difference(center, view.from);
    const double depth = dot(place, ahead);
    if (!(std::abs(dot(place, right)) <= depth * tangent_right &&
          std::abs(dot(place, above)) <= depth * tangent_up))
      is_in_view = false;
  });
  return is_in_view;
}

void arrange(model::Scene& scene, const ImportOptions& options, const model::View& view) {
  scene.view = view;
  scene.background = options.background;
  if (scene.lights.empty())
    light_studio(scene);
  else
    expose(scene);
  scene.samples = 4;
  scene.is_srgb = true;
}

}  // namespace raytracer::client
