// R2: points of which the first n are spread evenly over the unit square, for any n (M. Roberts,
// The Unreasonable Effectiveness of Quasirandom Sequences, 2018). The nth is at the fractional
// parts of n / plastic_number and n / plastic_number^2.
#pragma once

namespace raytracer {

inline constexpr double plastic_number = 1.32471795724474602596;  ///< x^3 = x + 1

}  // namespace raytracer
