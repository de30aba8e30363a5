// What straight lines leave of a plane: of a triangle's picture three, of a long thing's two.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace raytracer {

/// A line of the plane: 0 on it, positive inside, linear.
struct Line {
  double at_origin;
  double per_x;
  double per_y;
};

/// Some of a rectangle's 4 x 4 equal parts: bit 4 * row + column of each.
using Parts = std::uint16_t;
inline constexpr int parts_across = 4;

/// A line against the parts of rectangles of one size.
struct PartLine {
  /// What it is at a rectangle that begins at the origin, at the corner of its first part that is
  /// farthest inside. In steps from part to part, so that float holds it whatever the scale.
  Line in_steps;
  float along_row;  ///< a step, likewise
  float along_column;
};

/// Of parts, each of which is `margin` larger on all sides.
PartLine part_line(const Line& line, double width, double height, double margin);

/// The parts of a rectangle that begins at (x, y) that all lines leave something of.
Parts parts_inside(std::span<const PartLine> lines, double x, double y);

/// What lies inside of some lines, against the parts of rectangles of one size.
template <std::size_t count>
class PartOutline {
 public:
  /// Generous by `margin`.
  PartOutline(const std::array<Line, count>& lines, double width, double height, double margin) {
    for (std::size_t i = 0; i < count; ++i) lines_[i] = part_line(lines[i], width, height, margin);
  }

  /// The parts of the rectangle that begins at (x, y) of which something may be left.
  Parts parts_reached(double x, double y) const { return parts_inside(lines_, x, y); }

 private:
  std::array<PartLine, count> lines_;
};

}  // namespace raytracer
