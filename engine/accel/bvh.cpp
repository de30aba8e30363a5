#include "engine/accel/bvh.h"

#include <algorithm>
#include <numeric>

namespace raytracer {
namespace {

Box bound(const PackedSphere& sphere) {
  const Vec3 r{sphere.radius, sphere.radius, sphere.radius};
  return {sphere.center - r, sphere.center + r};
}

Box bound(const PackedTriangle& triangle) {
  Box box;
  for (const Vec3& vertex : triangle.vertices) box.include(vertex);
  return box;
}

double component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

}  // namespace

/// Splits a range of primitives, then its halves; works on `order` in place.
struct Bvh::Builder {
  static constexpr std::uint32_t bin_count = 16;
  static constexpr std::uint32_t smallest_split = 4;  // up to so many primitives stay a leaf
  static constexpr std::uint32_t largest_leaf = 16;
  static constexpr double cost_of_node = 1.0;  // in intersections with a primitive

  std::vector<Box> boxes;     // of the primitives
  std::vector<Vec3> centers;  // of the boxes
  Bvh& bvh;

  /// A cut between bins on an axis, and what it would cost.
  struct Split {
    int axis = -1;
    std::uint32_t bin = 0;  // the first that goes to the second half
    double cost = std::numeric_limits<double>::infinity();
  };

  struct Range {
    std::uint32_t begin;
    std::uint32_t end;
    std::uint32_t size() const { return end - begin; }
  };

  static std::uint32_t bin_of(double center, double low, double scale) {
    return std::min(static_cast<std::uint32_t>((center - low) * scale), bin_count - 1);
  }

  Split best_split(const Range& range, const Box& center_box) const {
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = component(center_box.low, axis);
      const double scale = bin_count / component(center_box.extent(), axis);
      if (!std::isfinite(scale)) continue;
      std::array<Box, bin_count> bin_boxes;
      std::array<std::uint32_t, bin_count> bin_sizes{};
      for (std::uint32_t i = range.begin; i < range.end; ++i) {
        const std::uint32_t primitive = bvh.order_[i];
        const std::uint32_t bin = bin_of(component(centers[primitive], axis), low, scale);
        bin_boxes[bin].include(boxes[primitive]);
        ++bin_sizes[bin];
      }
      std::array<double, bin_count> cost_behind{};
      Box box;
      std::uint32_t size = 0;
      for (std::uint32_t bin = bin_count - 1; bin > 0; --bin) {
        box.include(bin_boxes[bin]);
        size += bin_sizes[bin];
        cost_behind[bin] = size > 0 ? size * box.half_area() : 0;
      }
      box = {};
      size = 0;
      for (std::uint32_t bin = 1; bin < bin_count; ++bin) {
        box.include(bin_boxes[bin - 1]);
        size += bin_sizes[bin - 1];
        if (size == 0 || size == range.size()) continue;
        const double cost = size * box.half_area() + cost_behind[bin];
        if (cost < best.cost) best = {axis, bin, cost};
      }
    }
    return best;
  }

  /// Where a range's second half begins, and across which axis it was cut.
  struct Halves {
    std::uint32_t middle;
    int axis;
  };

  /// Reorders the range into halves; the middle is the range's end for a leaf.
  Halves split(const Range& range, const Box& box, const Box& center_box, int depth) {
    if (range.size() <= smallest_split) return {range.end, 0};
    const auto begin = bvh.order_.begin();
    const Split best = depth < deepest_by_heuristic ? best_split(range, center_box) : Split{};
    if (best.axis >= 0) {
      const double area = box.half_area();
      const bool leaf_is_cheaper = best.cost + cost_of_node * area >= range.size() * area;
      if (leaf_is_cheaper && range.size() <= largest_leaf) return {range.end, 0};
      const double low = component(center_box.low, best.axis);
      const double scale = bin_count / component(center_box.extent(), best.axis);
      const auto middle =
          std::partition(begin + range.begin, begin + range.end, [&](std::uint32_t primitive) {
            return bin_of(component(centers[primitive], best.axis), low, scale) < best.bin;
          });
      return {static_cast<std::uint32_t>(middle - begin), best.axis};
    }
    // Too deep, or all centres in one place: any halves will do.
    if (range.size() <= largest_leaf) return {range.end, 0};
    return {range.begin + range.size() / 2, 0};
  }

  void build(std::uint32_t node, const Range& range, int depth) {
    Box box;
    Box center_box;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      box.include(boxes[bvh.order_[i]]);
      center_box.include(centers[bvh.order_[i]]);
    }
    bvh.nodes_[node].box = box;
    const auto [middle, axis] = split(range, box, center_box, depth);
    if (middle == range.end) {
      bvh.nodes_[node].first = range.begin;
      bvh.nodes_[node].count = range.size();
      return;
    }
    const auto child = static_cast<std::uint32_t>(bvh.nodes_.size());
    bvh.nodes_[node].first = child;
    bvh.nodes_[node].count = 0;
    bvh.nodes_[node].axis = axis;
    bvh.nodes_.resize(bvh.nodes_.size() + 2);
    build(child, {range.begin, middle}, depth + 1);
    build(child + 1, {middle, range.end}, depth + 1);
  }
};

Bvh Bvh::build(const PackedScene& scene) {
  Bvh bvh;
  bvh.scene_ = &scene;
  const std::size_t count = scene.spheres.size() + scene.triangles.size();
  if (count == 0) return bvh;

  Builder builder{{}, {}, bvh};
  builder.boxes.reserve(count);
  for (const PackedSphere& sphere : scene.spheres) builder.boxes.push_back(bound(sphere));
  for (const PackedTriangle& triangle : scene.triangles) builder.boxes.push_back(bound(triangle));
  double magnitude = 0;
  for (const Box& box : builder.boxes)
    magnitude = std::max({magnitude, max_abs(box.low), max_abs(box.high)});
  builder.centers.reserve(count);
  for (Box& box : builder.boxes) {
    builder.centers.push_back(box.low * 0.5 + box.high * 0.5);
    box = box.padded(magnitude);
  }

  bvh.order_.resize(count);
  std::iota(bvh.order_.begin(), bvh.order_.end(), 0U);
  bvh.nodes_.reserve(count);
  bvh.nodes_.resize(1);
  builder.build(0, {0, static_cast<std::uint32_t>(count)}, 0);
  bvh.nodes_.shrink_to_fit();
  return bvh;
}

}  // namespace raytracer
