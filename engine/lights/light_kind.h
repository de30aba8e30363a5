// What a kind of light tells the engine: one that is listed in lights.h and lacks a piece of the
// concept LightKind does not compile. Each is in its own folder beside this file: X.h has what the
// concept asks for, X-inl.h the same arriving() for packets.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "engine/fields/field_table.h"  // IWYU pragma: export
#include "engine/math/frame.h"          // IWYU pragma: export
#include "engine/math/ray.h"            // IWYU pragma: export
#include "engine/math/vec.h"            // IWYU pragma: export

namespace raytracer {

/// What rays to a light share, by which finders look for what is in their way. Those to a soft one
/// go to places on it, which are the same for many points.
enum class LightRays : std::uint8_t {
  parallel,    ///< a direction, or each of some directions
  converging,  ///< the point where they end
  neither,     ///< they are sought as followed rays are
};
inline constexpr std::size_t light_rays_count = 3;

/// Where a light shines from: all but a point's is soft.
enum class LightShape : std::uint8_t {
  point,  ///< a place or a direction
  disc,   ///< across the line towards its middle
  sky,    ///< every direction
};

/// A light in frame coordinates.
struct PackedLight {
  std::size_t kind;  ///< its place in LightKinds
  LightRays rays;
  Vec3 place;    ///< of parallel rays the unit vector towards the light; else where it is
  Rgb emission;  ///< i; of one that fades, at distance 1
  bool fades;    ///< with the distance's square
  LightShape shape = LightShape::point;
  /// Of a disc of directions the tangent of half its angle, of one around a place its radius; of a
  /// sky how far away what hides it may be.
  double size = 0;
  /// One of the directions that rays to a soft light share.
  bool is_direction = false;
  /// Of such a direction of a sky: the light before it shines from the other end of its axis.
  bool is_opposite = false;

  bool is_soft() const { return shape != LightShape::point; }
  /// Whether `place` is where its middle is.
  bool has_place() const {
    return rays == LightRays::converging ||
           (rays == LightRays::neither && shape == LightShape::disc);
  }
};

/// A light as a point sees it.
struct ArrivingLight {
  Vec3 towards;     ///< unit; zero where the light is exactly at the point
  double distance;  ///< infinite if the rays are parallel
  Rgb intensity;    ///< that arrives; finite
};

/// What the rays to it share, and where it shines from; the latter's size in frame coordinates, as
/// PackedLight has it.
template <class Light>
concept HasRays = requires(const Light& x, const Frame& frame) {
  { rays_of(x) } -> std::same_as<LightRays>;
  { shape_of(x) } -> std::same_as<LightShape>;
  { size_of(x, frame) } -> std::same_as<double>;
};

/// Shines from everywhere, so that nothing arrives from any one direction.
template <class Light>
concept ShinesFromEverywhere = requires {
  requires Light::shines_from_everywhere;
};

/// The space that it takes: calls include(point, reach).
template <class Light>
concept HasLightExtents = requires(const Light& x, void include(const Vec3&, double)) {
  for_each_extent(x, include);
};

/// What it is in frame coordinates, of colour times intensity `i`: PackedLight's place and
/// emission.
template <class Light>
concept IsPacked = requires(const Light& x, const Frame& frame, const Rgb& i) {
  { place_of(x, frame) } -> std::same_as<Vec3>;
  { emission_of(x, i, frame) } -> std::same_as<Rgb>;
};

/// Whether its light falls with the distance's square.
template <class Light>
concept HasFalloff = requires(const Light& x) {
  { fades(x) } -> std::same_as<bool>;
};

/// Its light on a surface that is `clearance` away, in the scene's unit, if colour times intensity
/// is i.
template <class Light>
concept HasBrightest = requires(const Light& x, double i, double clearance) {
  { brightest(x, i, clearance) } -> std::same_as<double>;
};

/// The definition: what arrives at a point, in double.
template <class Light>
concept Arrives = requires(const PackedLight& light, const SurfacePoint& point) {
  { arriving(std::type_identity<Light>(), light, point) } -> std::same_as<ArrivingLight>;
};

template <class Light>
concept LightKind = DocumentedType<Light> && HasRays<Light> && HasLightExtents<Light> &&
    IsPacked<Light> && HasFalloff<Light> && HasBrightest<Light> &&
    (Arrives<Light> || ShinesFromEverywhere<Light>);

}  // namespace raytracer
