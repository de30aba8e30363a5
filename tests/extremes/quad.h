// Numbers of 113 bits and an exponent of 15, for the exact pictures.
//
// The compiler's own type: __float128 on x86-64 (g++ and clang), long double where that has as many
// bits. What it has no functions for in the standard library is computed here: a square root by
// Newton's method, sine and cosine by their series.
#pragma once

#include <cmath>

#include "engine/math/vec.h"

namespace raytracer::extremes {

#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128;
#else
using Quad = long double;
static_assert(sizeof(long double) == 16, "the exact pictures need numbers of 113 bits");
#endif

inline Quad absolute(Quad a) { return a < 0 ? -a : a; }

/// Of a >= 0.
inline Quad square_root(Quad a) {
  if (!(a > 0)) return 0;
  // A long double has the range of a Quad, and 64 bits or more: one step doubles them.
  Quad root = std::sqrt(static_cast<long double>(a));
  for (int step = 0; step < 2; ++step) root = (root + a / root) / 2;
  return root;
}

/// For angles up to pi.
inline Quad sine(Quad angle) {
  Quad term = angle;
  Quad sum = angle;
  for (int i = 1; i < 40; ++i) {
    term *= -angle * angle / ((2 * i) * (2 * i + 1));
    sum += term;
  }
  return sum;
}

inline Quad pi() {
  // In parts that a double holds exactly: 2^-53 and 2^-107 of pi after the first.
  return static_cast<Quad>(3.141592653589793116) + static_cast<Quad>(1.2246467991473532e-16) +
         static_cast<Quad>(-2.9947698097183397e-33);
}

struct QuadVec {
  Quad x = 0;
  Quad y = 0;
  Quad z = 0;

  QuadVec() = default;
  QuadVec(Quad x_value, Quad y_value, Quad z_value) : x(x_value), y(y_value), z(z_value) {}
  explicit QuadVec(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}

  friend QuadVec operator+(const QuadVec& a, const QuadVec& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend QuadVec operator-(const QuadVec& a, const QuadVec& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend QuadVec operator*(const QuadVec& a, Quad s) { return {a.x * s, a.y * s, a.z * s}; }
};

inline Quad dot(const QuadVec& a, const QuadVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline QuadVec cross(const QuadVec& a, const QuadVec& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

inline Quad length(const QuadVec& a) { return square_root(dot(a, a)); }

/// Zero stays zero.
inline QuadVec unit(const QuadVec& a) {
  const Quad size = length(a);
  return size > 0 ? a * (1 / size) : a;
}

}  // namespace raytracer::extremes
