#include "tests/extremes/oracle.h"

#include <algorithm>
#include <array>
#include <vector>

namespace raytracer::extremes {
namespace {

/// The axis of x, y, z that is least aligned with d; ties: x, then z, then y.
QuadVec stand_in_for_up(const QuadVec& d) {
  const Quad x = absolute(d.x);
  const Quad y = absolute(d.y);
  const Quad z = absolute(d.z);
  if (x <= y && x <= z) return {1, 0, 0};
  if (z <= y) return {0, 0, 1};
  return {0, 1, 0};
}

/// cosine^exponent; both factors of the exponent are near enough in double.
double power(Quad cosine, double exponent) {
  if (exponent == 0) return 1;
  if (!(cosine > 0)) return 0;
  const double below_one = static_cast<double>(cosine - 1);
  return std::exp(exponent * std::log1p(std::min(below_one, 0.0)));
}

}  // namespace

Oracle::Oracle(const Scene& scene) : scene_(scene) {
  for (const Material& m : scene.materials)
    if (m.transparency > 0) least_weight_ = 0x1p-14;
  const Camera& camera = scene.camera;
  const QuadVec d = unit(relative(camera.look_at, camera.origin));
  QuadVec across = cross(unit(QuadVec(camera.up)), d);
  if (length(across) < 1e-12) across = cross(stand_in_for_up(d), d);
  const QuadVec u = unit(across);
  const QuadVec v = cross(d, u);
  const Quad turn = 2 * pi();
  const Quad turns = std::floor(static_cast<long double>(static_cast<Quad>(camera.fov) / turn));
  const Quad alpha = static_cast<Quad>(camera.fov) - turns * turn;
  // tan(alpha / 2) without its pole: both sides of the division times the cosine.
  const Quad sine_of_half = sine(alpha / 2);
  forward_ = d * sine((pi() - alpha) / 2);
  right_ = u * sine_of_half;
  up_ = v * (sine_of_half * camera.height / camera.width);
}

Quad Oracle::visible_share(const OraclePlace& place, const QuadVec& towards, Quad distance) const {
  if (scene_.shadows == Shadows::off) return 1;
  Quad share = 1;
  Quad t = 0;
  OraclePlace from = place;
  // From surface to surface; rays cross what of them lets light through.
  while (share > 0) {
    const OraclePlace met = OracleSearch(scene_, from, towards).nearest();
    t += met.t;
    if (met.kind == OraclePlace::Kind::none) break;
    if (distance != 0 && !(t < distance * (1 - same))) break;
    share *= material_of(met).transparency;
    from = met.other_side();
  }
  return share;
}

QuadVec Oracle::shade(const OraclePlace& place, const QuadVec& view) const {
  const Material& m = material_of(place);
  const Quad ambient = static_cast<Quad>(m.ka) * scene_.ambient;
  const bool brings_ambient = scene_.shadows == Shadows::black;
  std::array<Quad, 3> sum{};
  const QuadVec tint = place.is_tinted ? place.tint : QuadVec(m.color);
  const std::array<Quad, 3> color{tint.x, tint.y, tint.z};
  const QuadVec& normal = place.shading_normal();
  if (!brings_ambient) sum = {ambient * color[0], ambient * color[1], ambient * color[2]};
  for (const Light& light : scene_.lights) {
    QuadVec towards;
    Quad distance = 0;  // infinite
    Quad share = light.intensity;
    if (const auto* distant = std::get_if<DistantLight>(&light.source)) {
      towards = unit(QuadVec(distant->direction)) * Quad(-1);
    } else {
      const auto& point = std::get<PointLight>(light.source);
      const QuadVec path = relative(point.position, scene_.camera.origin) - place.point;
      distance = length(path);
      if (distance == 0) continue;
      towards = unit(path);
      if (point.falloff == Falloff::inverse_square)
        share = share / (4 * pi() * distance * distance);
    }
    const Quad incidence = dot(normal, towards);
    if (!(incidence > 0 && dot(place.normal, towards) > 0)) continue;
    const Quad visible = visible_share(place, towards, distance);
    if (!(visible > 0)) continue;
    const QuadVec half = unit(towards + view);
    const Quad direct =
        visible *
        (m.kd * incidence + m.ks * static_cast<Quad>(power(dot(half, normal), m.shininess))) *
        share;
    const std::array<double, 3> light_color{light.color.x, light.color.y, light.color.z};
    for (std::size_t c = 0; c < 3; ++c)
      sum[c] += color[c] * (direct * light_color[c] + (brings_ambient ? ambient : Quad(0)));
  }
  return {sum[0], sum[1], sum[2]};
}

namespace {

QuadVec mirrored(const QuadVec& direction, const OraclePlace& at) {
  const auto by = [&](const QuadVec& normal) {
    return unit(direction - normal * (2 * dot(direction, normal)));
  };
  const QuadVec above = by(at.shading_normal());
  return dot(above, at.normal) > 0 ? above : by(at.normal);
}

/// Snell's law; zero where all is reflected.
QuadVec refracted(const QuadVec& direction, const QuadVec& normal, Quad index) {
  const Quad cosine = -dot(direction, normal);
  const Quad square = 1 - index * index * (1 - cosine * cosine);
  if (!(square > 0)) return {};
  return unit(direction * index + normal * (index * cosine - square_root(square)));
}

/// The unpolarised reflectance between two cosines, of the refractive index of here over there.
Quad fresnel(Quad cosine, Quad beyond, Quad index) {
  const Quad across = (index * cosine - beyond) / (index * cosine + beyond);
  const Quad along = (index * beyond - cosine) / (index * beyond + cosine);
  return (across * across + along * along) / 2;
}

}  // namespace

QuadVec Oracle::radiance(const OraclePlace& from, const QuadVec& direction, Quad weight,
                         int depth) const {
  if (weight < least_weight_) return {};
  const OraclePlace met = OracleSearch(scene_, from, direction).nearest();
  if (met.kind == OraclePlace::Kind::none)
    return QuadVec(scene_.background.value_or(Rgb{})) * weight;
  QuadVec sum = shade(met, direction * Quad(-1)) * weight;
  if (depth == scene_.render.max_depth) return sum;
  const Material& m = material_of(met);
  Quad mirrors = m.reflectivity;
  if (m.transparency > 0) {
    const Quad index = met.is_inside ? Quad(m.ior) : 1 / Quad(m.ior);
    QuadVec on = direction;
    Quad reflectance = 0;
    if (met.has_inside) {
      QuadVec normal = met.shading_normal();
      on = refracted(direction, normal, index);
      if (!(dot(direction, normal) < 0) || dot(on, met.normal) > 0) {
        normal = met.normal;
        on = refracted(direction, normal, index);
      }
      if (dot(on, on) == 0)
        reflectance = 1;
      else if (m.fresnel)
        reflectance = fresnel(-dot(direction, normal), -dot(on, normal), index);
    }
    mirrors += m.transparency * reflectance;
    if (reflectance < 1)
      sum = sum +
            radiance(met.other_side(), on, weight * m.transparency * (1 - reflectance), depth + 1);
  }
  if (mirrors > 0) sum = sum + radiance(met, mirrored(direction, met), weight * mirrors, depth + 1);
  return sum;
}

Vec3 Oracle::color(double x, double y, double dx, double dy) const {
  const Camera& camera = scene_.camera;
  const Quad across = (2 * (static_cast<Quad>(x) + dx)) / camera.width - 1;
  const Quad upwards = (2 * (static_cast<Quad>(y) + dy)) / camera.height - 1;
  const QuadVec seen = radiance({}, unit(forward_ + right_ * across + up_ * upwards), 1, 0);
  const auto clamped = [](Quad c) {
    return static_cast<double>(c < 0 ? Quad(0) : c > 1 ? Quad(1) : c);
  };
  return {clamped(seen.x), clamped(seen.y), clamped(seen.z)};
}

}  // namespace raytracer::extremes
