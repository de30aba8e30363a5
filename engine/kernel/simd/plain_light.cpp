#include "engine/kernel/simd/plain_light.h"

#include <algorithm>
#include <array>
#include <limits>

namespace raytracer {
namespace {

template <typename T>
bool is_plain(const SimdLight<T>& light) {
  return light.is_distant && std::all_of(light.stencils.begin(), light.stencils.end(),
                                         [](const Stencil<T>& s) { return s.suffices; });
}

template <typename T>
bool is_plainly_lit(const SimdScene<T>& scene) {
  return (!scene.has_specular || scene.uniform_shininess >= 0) && scene.planes.empty() &&
         !scene.has_triangles && !scene.has_light_grids && scene.sphere_tree.is_empty() &&
         std::all_of(scene.lights.begin(), scene.lights.end(), is_plain<T>);
}

template <typename T>
void note_inner_cells(const std::vector<SimdLight<T>>& lights, std::size_t index,
                      SimdSquare<T>& square) {
  T reach = 0;
  for (const SimdLight<T>& light : lights) reach = std::max(reach, light.stencils[index].reach);
  square.inner_low_first = square.low_first + reach;
  square.inner_high_first = square.high_first - reach;
  square.inner_low_second = square.low_second + reach;
  square.inner_high_second = square.high_second - reach;
}

template <typename T>
void note_clear_heights(const std::vector<SimdLight<T>>& lights, SimdSquare<T>& square) {
  constexpr T never = std::numeric_limits<T>::infinity();
  square.clear_above = T(0.5);
  square.clear_below = T(-0.5);
  for (const SimdLight<T>& light : lights) {
    const std::array towards{light.place.x, light.place.y, light.place.z};
    const T rise = towards[static_cast<std::size_t>(square.axes[1])];
    if (rise <= 0) square.clear_above = never;
    if (rise >= 0) square.clear_below = -never;
  }
}

template <typename T>
void note_discs(const PackedLight& light, const PackedScene& scene, SimdLight<T>& simd) {
  const auto in_t = [](double value) { return static_cast<T>(value); };
  const Across plane = across(light.place);
  simd.across = {Triple<T>{in_t(plane.u.x), in_t(plane.u.y), in_t(plane.u.z)},
                 Triple<T>{in_t(plane.v.x), in_t(plane.v.y), in_t(plane.v.z)}};
  for (const PackedSphere& s : scene.spheres)
    simd.discs.push_back({in_t(dot(s.center, plane.u)), in_t(dot(s.center, plane.v)),
                          in_t(dot(s.center, light.place)), in_t(s.radius * s.radius),
                          static_cast<T>(scene.numbers(s.id))});
}

}  // namespace

template <typename T>
void prepare_plain_light(const PackedScene& scene, SimdScene<T>& packed) {
  packed.is_plainly_lit = is_plainly_lit(packed);
  if (!packed.is_plainly_lit || scene.shadows == Shadows::off) return;
  for (std::size_t i = 0; i < packed.squares.size(); ++i) {
    note_inner_cells(packed.lights, i, packed.squares[i]);
    note_clear_heights(packed.lights, packed.squares[i]);
  }
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    note_discs(scene.lights[i], scene, packed.lights[i]);
}

template void prepare_plain_light<float>(const PackedScene&, SimdScene<float>&);
template void prepare_plain_light<double>(const PackedScene&, SimdScene<double>&);

}  // namespace raytracer
