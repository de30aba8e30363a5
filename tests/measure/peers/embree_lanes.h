// As many floats as a packet has rays, and vectors of them: the Embree peer's arithmetic.
//
// GCC's vector types, which become the widest instructions that the source is compiled for. Only
// embree_kernel.cpp may include this; it says why.
#pragma once

#include <math.h>
#include <string.h>

namespace raytracer::peers {

template <int width>
using Floats __attribute__((vector_size(4 * width))) = float;
template <int width>
using Mask __attribute__((vector_size(4 * width))) = int;  // 0 or -1

template <int width>
struct Lanes {
  using F = Floats<width>;
  using M = Mask<width>;

  struct Vector {
    F x, y, z;
  };

  static F splat(float value) { return F{} + value; }
  static Vector splat(const float (&v)[3]) { return {splat(v[0]), splat(v[1]), splat(v[2])}; }
  static F dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  static Vector times(const Vector& a, F s) { return {a.x * s, a.y * s, a.z * s}; }
  static Vector plus(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  static Vector unit(const Vector& a) { return times(a, 1 / root(dot(a, a))); }

  static F root(F a) {
    F result;
#pragma omp simd
    for (int i = 0; i < width; ++i) result[i] = sqrtf(a[i]);
    return result;
  }

  /// a^b for a > 0, by the vector functions of the C library.
  static F power(F a, F b) {
    alignas(64) float bases[width];
    alignas(64) float exponents[width];
    alignas(64) float results[width];
    memcpy(bases, &a, sizeof a);
    memcpy(exponents, &b, sizeof b);
#pragma omp simd
    for (int i = 0; i < width; ++i) results[i] = powf(bases[i], exponents[i]);
    return load(results);
  }

  static F load(const float* from) {
    F result;
    memcpy(&result, from, sizeof result);
    return result;
  }
  static M load(const unsigned* from) {
    M result;
    memcpy(&result, from, sizeof result);
    return result;
  }
  static void store(float* to, F value) { memcpy(to, &value, sizeof value); }
  static void store(float* x, float* y, float* z, const Vector& v) {
    store(x, v.x);
    store(y, v.y);
    store(z, v.z);
  }

  static bool any(M mask) {
    int result = 0;
    for (int i = 0; i < width; ++i) result |= mask[i];
    return result != 0;
  }

  static float total(F a) {
    float sum = 0;
    for (int i = 0; i < width; ++i) sum += a[i];
    return sum;
  }

  static F clamped(F a) {
    a = a > 1.0F ? splat(1) : a;
    return a < 0.0F ? F{} : a;
  }
  static Vector clamped(const Vector& a) { return {clamped(a.x), clamped(a.y), clamped(a.z)}; }
};

}  // namespace raytracer::peers
