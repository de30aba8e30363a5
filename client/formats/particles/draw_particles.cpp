#include "client/formats/particles/draw_particles.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "client/failure.h"
#include "client/formats/particles/color_map.h"
#include "client/formats/particles/elements.h"
#include "client/formats/particles/neighbors.h"
#include "client/formats/particles/palette.h"
#include "client/formats/screen_color.h"
#include "client/formats/spacing.h"
#include "client/formats/threads.h"

namespace raytracer::client {
namespace {

model::Material material_of(const model::Rgb& on_screen, std::string_view name) {
  const model::Rgb light = linear(on_screen);
  model::Material material{};
  const auto rounded = [](float share) {
    return std::round(1e4 * static_cast<double>(share)) / 1e4;
  };
  material.color = {rounded(light[0]), rounded(light[1]), rounded(light[2])};
  material.kd = 0.7;
  material.ks = 0.4;
  material.shininess = 30;
  material.ior = 1;
  material.name = name;
  return material;
}

/// What colours particles have: a material each, or all one material and a colour each.
struct Paint {
  std::vector<model::Material> materials;
  std::vector<std::uint32_t> material_of;  ///< none: the first
  std::vector<model::Rgb> colors;          ///< none, or one for each
};

/// Of what is known of them; nothing if all is the same.
std::optional<std::pair<float, float>> range_of(const std::vector<float>& values) {
  std::optional<std::pair<float, float>> range;
  for (const float value : values)
    if (!std::isnan(value)) {
      if (!range) range = {value, value};
      range = {std::min(range->first, value), std::max(range->second, value)};
    }
  if (range && range->first == range->second) range.reset();
  return range;
}

/// A material for each of 256 steps of the map that has a value: in a document a third as long as
/// with a colour for each particle. Gray are those whose value is unknown.
Paint mapped(const std::vector<float>& values, const ImportOptions& options, DrawingScale& scale) {
  const auto own = range_of(values);
  if (!scale.range) scale.range = own;
  if (own && (own->first < scale.range->first || own->second > scale.range->second))
    scale.is_exceeded = true;
  const auto [least, most] = scale.range.value_or(std::pair(0.0F, 0.0F));
  // Halves: the difference of two large numbers may be too large itself.
  const float width = most / 2 - least / 2;
  constexpr std::size_t steps = 256;
  constexpr std::uint32_t unseen = ~std::uint32_t{0};
  constexpr std::size_t unknown = steps;
  constexpr std::uint32_t gray = 0x808080;
  std::vector<std::uint32_t> material_of_step(steps + 1, unseen);
  Paint result;
  result.material_of.reserve(values.size());
  for (const float value : values) {
    const float share = width > 0 ? std::clamp((value / 2 - least / 2) / width, 0.0F, 1.0F) : 0.5F;
    const auto step =
        std::isnan(value) ? unknown : static_cast<std::size_t>(std::lround(share * (steps - 1)));
    std::uint32_t& material = material_of_step[step];
    if (material == unseen) {
      material = static_cast<std::uint32_t>(result.materials.size());
      const float on_map = static_cast<float>(step) / (steps - 1);
      const model::Rgb color = step == unknown
                                   ? screen_color(gray)
                                   : color_on_map(options.color_map.value_or("viridis"), on_map);
      result.materials.push_back(material_of(color, ""));
    }
    result.material_of.push_back(material);
  }
  return result;
}

/// Of the group that is met as the `nth`: that of its number, if its name is one, so that a type
/// has the same colour in every file.
std::size_t place_in_palette(const std::string& name, std::size_t nth) {
  std::size_t number = 0;
  const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  const bool is_number = error == std::errc() && stop == name.data() + name.size() && number > 0;
  return is_number ? number - 1 : nth;
}

Paint paint(Particles& particles, const ImportOptions& options, DrawingScale& scale) {
  if (!particles.values.empty()) return mapped(particles.values, options, scale);
  Paint result;
  constexpr model::Rgb white{1, 1, 1};
  if (!particles.groups.empty()) {
    for (std::size_t i = 0; i < particles.group_names.size(); ++i) {
      const auto known = residue_color(particles.group_names[i]);
      const bool is_residue = options.color == "residue" && known;
      const std::size_t place = place_in_palette(particles.group_names[i], i);
      result.materials.push_back(material_of(is_residue ? *known : palette_color(place), ""));
    }
    result.material_of = std::move(particles.groups);
  } else if (!particles.colors.empty()) {
    result.materials.push_back(material_of(white, ""));
    result.colors = std::move(particles.colors);
    for (model::Rgb& color : result.colors) color = linear(color);
  } else if (!particles.elements.empty()) {
    constexpr std::uint32_t unseen = ~std::uint32_t{0};
    std::vector<std::uint32_t> material_of_element(256, unseen);
    result.material_of.reserve(particles.elements.size());
    for (const std::uint8_t element : particles.elements) {
      std::uint32_t& material = material_of_element[element];
      if (material == unseen) {
        material = static_cast<std::uint32_t>(result.materials.size());
        result.materials.push_back(material_of(color_of(element), symbol_of(element)));
      }
      result.material_of.push_back(material);
    }
  } else {
    result.materials.push_back(material_of(palette_color(4), ""));
  }
  return result;
}

/// The indices of particles of each material.
std::vector<std::vector<std::uint32_t>> by_material(const Paint& paint, std::size_t count) {
  std::vector<std::vector<std::uint32_t>> result(paint.materials.size());
  for (std::uint32_t i = 0; i < count; ++i)
    result[paint.material_of.empty() ? 0 : paint.material_of[i]].push_back(i);
  return result;
}

void add_balls(const Particles& particles, const Paint& paint, const std::vector<double>& radii,
               model::Scene& scene) {
  const auto all = by_material(paint, particles.places.size());
  for (std::size_t material = 0; material < all.size(); ++material) {
    if (all[material].empty()) continue;
    model::Spheres spheres;
    spheres.centers.reserve(all[material].size());
    spheres.radii.reserve(all[material].size());
    for (const std::uint32_t i : all[material]) {
      spheres.centers.push_back(particles.places[i]);
      spheres.radii.push_back(radii[i]);
      if (!paint.colors.empty()) spheres.colors.push_back(paint.colors[i]);
    }
    scene.objects.push_back({std::move(spheres), material});
  }
}

/// Those that the file names, and those by distance of which it says nothing; each once.
std::vector<std::array<std::uint32_t, 2>> all_bonds(const Particles& particles) {
  auto bonds = bonds_by_distance(particles.places, particles.elements);
  if (const std::vector<bool>& has_all = particles.has_all_bonds; !has_all.empty()) {
    std::vector<bool> is_named(particles.places.size());
    for (const auto& [a, b] : particles.bonds) is_named[a] = is_named[b] = true;
    std::erase_if(bonds, [&](const auto& bond) {
      const auto& [a, b] = bond;
      return is_named[a] && is_named[b] && (has_all[a] || has_all[b]);
    });
  }
  for (const auto& [a, b] : particles.bonds) bonds.push_back({std::min(a, b), std::max(a, b)});
  std::sort(bonds.begin(), bonds.end());
  bonds.erase(std::unique(bonds.begin(), bonds.end()), bonds.end());
  return bonds;
}

/// Each bond in two halves, of the colours of its atoms.
void add_sticks(const Particles& particles, const Paint& paint, double radius,
                model::Scene& scene) {
  std::vector<model::Cylinders> sticks(paint.materials.size());
  const auto add_half = [&](std::uint32_t from, std::uint32_t to) {
    const model::Triple& start = particles.places[from];
    model::Triple middle{};
    for (std::size_t i = 0; i < 3; ++i) middle[i] = start[i] / 2 + particles.places[to][i] / 2;
    if (middle == start) return;
    model::Cylinders& same = sticks[paint.material_of.empty() ? 0 : paint.material_of[from]];
    same.from.push_back(start);
    same.to.push_back(middle);
    same.radii.push_back(radius);
    if (!paint.colors.empty()) same.colors.push_back(paint.colors[from]);
  };
  for (const auto& [a, b] : all_bonds(particles)) {
    add_half(a, b);
    add_half(b, a);
  }
  for (std::size_t material = 0; material < sticks.size(); ++material)
    if (!sticks[material].radii.empty())
      scene.objects.push_back({std::move(sticks[material]), material});
}

}  // namespace

void draw_particles(Particles particles, const ImportOptions& options, DrawingScale& scale,
                    model::Scene& scene) {
  const bool has_sticks = options.style != AtomStyle::spacefill;
  if (has_sticks && particles.elements.empty())
    throw InputError("has no elements, and so no bonds; leave --style out");
  const std::size_t count = particles.places.size();
  Paint colors = paint(particles, options, scale);
  std::vector<double> radii = std::move(particles.radii);
  constexpr double ball_share = 0.25;  // as PyMOL has it
  const double stick_radius = options.style == AtomStyle::sticks ? 0.25 : 0.15;
  if (options.style == AtomStyle::sticks) {
    radii.assign(count, stick_radius);
  } else if (!particles.elements.empty() && (radii.empty() || has_sticks)) {
    radii.clear();
    radii.reserve(count);
    for (const std::uint8_t element : particles.elements)
      radii.push_back((has_sticks ? ball_share : 1) * van_der_waals_radius(element));
  } else if (radii.empty()) {
    if (!scale.radius) scale.radius = typical_spacing(particles.places, useful_threads()) / 2;
    radii.assign(count, *scale.radius);
  }
  add_balls(particles, colors, radii, scene);
  if (has_sticks) add_sticks(particles, colors, stick_radius, scene);
  scene.materials = std::move(colors.materials);
}

}  // namespace raytracer::client
