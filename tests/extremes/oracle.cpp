#include "tests/extremes/oracle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
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

namespace {

constexpr int strata_across = 16;

constexpr int place_count = strata_across * strata_across;

/// The middle of a cell in the unit disc, and how high the unit sphere is above it.
struct DiscPlace {
  Quad x;
  Quad y;
  Quad height;
};

/// Those of cells of equal area.
const std::array<DiscPlace, place_count>& disc_places() {
  static const auto places = [] {
    std::array<DiscPlace, place_count> made;
    for (int i = 0; i < place_count; ++i) {
      const int ring = i / strata_across;
      const int sector = i % strata_across;
      const double radius = std::sqrt((ring + 0.5) / strata_across);
      const double angle = 2 * std::numbers::pi * (sector + 0.5) / strata_across;
      const Quad x = radius * std::cos(angle);
      const Quad y = radius * std::sin(angle);
      made[static_cast<std::size_t>(i)] = {x, y, square_root(1 - x * x - y * y)};
    }
    return made;
  }();
  return places;
}

/// Two unit vectors across a third.
struct Across {
  explicit Across(const QuadVec& v)
      : first(unit(cross(stand_in_for_up(v), v))), second(cross(v, first)) {}
  QuadVec at(const DiscPlace& place) const { return first * place.x + second * place.y; }

  QuadVec first;
  QuadVec second;
};

}  // namespace

Quad Oracle::visible_share_of_disc(const OraclePlace& place, const QuadVec& centre, bool is_near,
                                   Quad radius) const {
  if (radius == 0) return visible_share(place, unit(centre), is_near ? length(centre) : Quad(0));
  const Across across(unit(centre));
  Quad sum = 0;
  for (const DiscPlace& at : disc_places()) {
    const QuadVec path = centre + across.at(at) * radius;
    if (!(dot(place.normal, path) > 0)) continue;
    const Quad distance = length(path);
    sum += visible_share(place, path * (1 / distance), is_near ? distance : Quad(0));
  }
  return sum / place_count;
}

Quad Oracle::visible_share_of_sky(const OraclePlace& place, Quad reach) const {
  const QuadVec& normal = place.shading_normal();
  const Across across(normal);
  Quad sum = 0;
  for (const DiscPlace& at : disc_places()) {
    const QuadVec towards = across.at(at) + normal * at.height;
    if (dot(place.normal, towards) > 0) sum += visible_share(place, towards, reach);
  }
  return sum / place_count;
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
    Quad share = light.intensity;
    Quad direct = 0;
    if (const auto* sky = std::get_if<SkyLight>(&light.source)) {
      const Quad open = visible_share_of_sky(
          place, std::isfinite(sky->reach) ? static_cast<Quad>(sky->reach) : Quad(0));
      if (!(open > 0)) continue;
      direct = open * m.kd * share;
    } else {
      QuadVec centre;
      Quad radius = 0;
      const auto* point = std::get_if<PointLight>(&light.source);
      if (point) {
        centre = relative(point->position, scene_.camera.origin) - place.point;
        if (dot(centre, centre) == 0) continue;
        radius = point->radius;
        if (point->falloff == Falloff::inverse_square)
          share = share / (4 * pi() * dot(centre, centre));
      } else {
        const auto& distant = std::get<DistantLight>(light.source);
        centre = unit(QuadVec(distant.direction)) * Quad(-1);
        radius = std::tan(distant.angle / 2);
      }
      const QuadVec towards = unit(centre);
      const Quad incidence = dot(normal, towards);
      if (!(incidence > 0 && (radius > 0 || dot(place.normal, towards) > 0))) continue;
      const Quad visible = visible_share_of_disc(place, centre, point != nullptr, radius);
      if (!(visible > 0)) continue;
      const QuadVec half = unit(towards + view);
      direct =
          visible *
          (m.kd * incidence + m.ks * static_cast<Quad>(power(dot(half, normal), m.shininess))) *
          share;
    }
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
