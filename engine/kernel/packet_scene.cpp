#include "engine/kernel/packet_scene.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

#include "engine/kernel/build_geometry.h"
#include "engine/parallel/chunks.h"

namespace raytracer {
namespace {

template <typename T>
PacketMaterials<T> make_materials(const PackedScene& scene, const Features& features) {
  PacketMaterials<T> materials{{}, {}, features.has_specular, features.integer_shininess};
  materials.rows.reserve(scene.materials.size());
  for (const Material& material : scene.materials)
    materials.rows.push_back(MaterialRow<T>::of(material, scene.ambient));
  if (!features.transmits) return materials;
  materials.glass.reserve(scene.materials.size());
  for (const Material& material : scene.materials)
    materials.glass.push_back(GlassRow<T>::of(material));
  return materials;
}

/// Rays that may still follow are counted down in singles, which know every integer up to here.
constexpr int most_counted = 1 << 24;

template <typename T>
PacketLight<T> packet_light(const PackedLight& light, std::size_t index) {
  return {light.kind,  light.rays, narrowed<T>(light.place), saturated<T>(light.emission),
          light.fades, index,      light.is_direction};
}

/// Adds a soft light; where rays to it share directions, each is one of the `lights` that
/// geometries have views of.
template <typename T>
void add_soft_light(const SoftLight& soft, std::vector<PackedLight>& lights,
                    PacketScene<T>& packed) {
  constexpr auto most = static_cast<double>(std::numeric_limits<T>::max());
  PacketSoftLight<T> to{packet_light<T>(soft.light, 0),
                        soft.light.shape,
                        static_cast<T>(std::min(soft.light.size, most)),
                        soft.numbers,
                        packed.told_places,
                        {},
                        {},
                        {}};
  const auto add_direction = [&](const Vec3& towards, bool is_opposite) {
    lights.push_back({soft.light.kind, LightRays::parallel, towards, {}, false});
    lights.back().is_direction = true;
    lights.back().is_opposite = is_opposite;
    (is_opposite ? to.opposites : to.directions)
        .push_back(packet_light<T>(lights.back(), lights.size() - 1));
  };
  if (soft.light.rays == LightRays::parallel) packed.told_places += soft.numbers.told();
  for (const Vec3& place : soft.places) {
    if (soft.light.rays != LightRays::parallel) {
      to.places.push_back(narrowed<T>(place));
      continue;
    }
    add_direction(place, false);
    if (soft.light.shape == LightShape::sky) add_direction(-place, true);
  }
  packed.soft_lights.push_back(std::move(to));
}

/// Whether any: paths are carried without.
bool finds_rays(const FinderTable& finders) {
  return std::any_of(finders.begin(), finders.end(), [](const FinderRow& row) {
    return std::any_of(row.begin(), row.end(), [](Finder f) { return f != Finder::none; });
  });
}

/// The rows of the table that hits look into.
template <class Kind, typename T>
void add_rows(const PrimitivesOf<Kind>& primitives, PacketScene<T>& packed) {
  using Layout = PacketLayout<Kind, T>;
  const PackedScene& scene = primitives.scene;
  for_each_range(primitives.all.size(), primitives.pool, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto& primitive = primitives.all[i];
      const std::int32_t number = scene.numbers(primitive.id);
      PrimitiveRow<T>& row = packed.primitives[static_cast<std::size_t>(number)];
      row = Layout::row(primitive, i);
      row.material = static_cast<T>(scene.material_index(primitive.id));
      if constexpr (HasCorners<typename Kind::Primitive>) {
        const CornerValues* const values = scene.corner_values_of(primitive.id);
        if (values == nullptr) continue;
        const std::size_t place = values->first + primitive.id.item;
        packed.corners[place] = corner_row<T>(corners_of(primitive), *values, primitive.id.item);
        row.item = static_cast<T>(place + 1);
      }
    }
  });
  const T curvature = Layout::row(primitives.all[0], 0).curvature;
  packed.has_flat = packed.has_flat || curvature == 0;
  packed.has_own_normals = packed.has_own_normals || curvature == PrimitiveRow<T>::own_normal;
}

/// Those of a kind that let light through, or those that do not.
template <class Kind>
std::vector<typename Kind::Primitive> chosen(const PrimitivesOf<Kind>& primitives, bool transmits) {
  std::vector<typename Kind::Primitive> some;
  for (const auto& primitive : primitives.all)
    if ((primitives.scene.material_of(primitive.id).transparency > 0) == transmits)
      some.push_back(primitive);
  return some;
}

/// The finders of some kinds of rays.
FinderRow finders_of(const FinderRow& finders, std::initializer_list<RayKind> rays) {
  FinderRow some{};
  for (const RayKind kind : rays) some[static_cast<std::size_t>(kind)] = finder_of(finders, kind);
  return some;
}

/// A kind of which some let light through and some do not.
template <class Kind, typename T>
void add_split(const PrimitivesOf<Kind>& primitives, const FinderRow& finders,
               const std::vector<PackedLight>& lights, PacketScene<T>& packed) {
  using enum RayKind;
  add_geometry(primitives, finders_of(finders, {from_eye, followed}), true, {}, packed.geometry);
  std::get<kind_index<Kind>>(packed.geometry.kinds).is_split = true;
  // Light is followed through what transmits; and to where rays share nothing, as others are.
  const FinderRow through =
      finders_of(finders, {to_distant_light, to_soft_light, to_point_light, followed});
  const bool follows_light =
      std::any_of(primitives.scene.soft_lights.begin(), primitives.scene.soft_lights.end(),
                  [](const SoftLight& soft) { return soft.light.rays == LightRays::neither; });
  FinderRow up_to = through;
  if (!follows_light) up_to[static_cast<std::size_t>(followed)] = Finder::none;
  const auto add = [&](bool transmits, const FinderRow& row, Geometries<T>& to) {
    const auto some = chosen(primitives, transmits);
    add_geometry(PrimitivesOf<Kind>{primitives.scene, some, primitives.pool}, row, transmits,
                 lights, to);
  };
  add(false, up_to, packed.opaque);
  add(true, through, packed.transmitting);
}

/// Whether there are of a kind both what lets light through and what does not.
template <class Kind>
bool has_both(const PrimitivesOf<Kind>& primitives) {
  const auto transmits = [&](const auto& primitive) {
    return primitives.scene.material_of(primitive.id).transparency > 0;
  };
  const bool first = transmits(primitives.all[0]);
  return std::any_of(primitives.all.begin(), primitives.all.end(),
                     [&](const auto& primitive) { return transmits(primitive) != first; });
}

/// Whether distant lights' grids are larger than what a processor's caches keep of them. Where they
/// are, cells fetched ahead save time: 250,000 spheres in two grids of 10 MB trace in 0.94 of it,
/// 1,000,000 in 0.74. Where they are not it is wasted: 100,000 take 1.04, 1,000 take 1.5 of it.
template <typename T>
bool exceed_caches(const Geometries<T>& geometries) {
  constexpr std::size_t caches = std::size_t{10} << 20;
  std::size_t bytes = 0;
  geometries.for_each([&]<class Kind>(const Geometry<Kind, T>& geometry) {
    if constexpr (HasLargeViews<typename PacketLayout<Kind, T>::LightView>)
      for (const auto& light : geometry.lights) bytes += light.bytes();
  });
  return bytes > caches;
}

}  // namespace

template <typename T>
PacketScene<T> make_packet_scene(const PackedScene& scene, const Features& features,
                                 const FinderTable& finders, WorkerPool& pool) {
  PacketScene<T> packed{};
  packed.view = scene.view;
  packed.forward = narrowed<T>(scene.view.forward);
  packed.right = narrowed<T>(scene.view.right);
  packed.up = narrowed<T>(scene.view.up);
  packed.primitives.resize(scene.numbers.count());
  for (const CornerValues& values : scene.corner_values)
    if (!values.empty()) packed.corners.resize(values.first + values.corners.size());
  std::vector<PackedLight> lights;
  if (finds_rays(finders)) {
    lights = scene.lights;
    for (std::size_t i = 0; i < lights.size(); ++i)
      packed.lights.push_back(packet_light<T>(lights[i], i));
    for (const SoftLight& soft : scene.soft_lights) add_soft_light(soft, lights, packed);
  }
  packed.light_sets = scene.light_sets;
  packed.sets_to_be_sure = scene.sets_to_be_sure;
  for_each_kind([&]<class Kind>(std::type_identity<Kind>) {
    const PrimitivesOf<Kind> primitives{scene, of_kind<Kind>(scene.primitives), pool};
    // None may be left of those that the finders were chosen for.
    if (primitives.all.empty()) return;
    const FinderRow& row = finders[kind_index<Kind>];
    const bool transmits = features.transmitting[kind_index<Kind>];
    add_rows(primitives, packed);
    if (transmits && finds_rays(finders) && has_both(primitives))
      add_split(primitives, row, lights, packed);
    else
      add_geometry(primitives, row, transmits, lights, packed.geometry);
  });
  packed.fetches_light_cells = exceed_caches(packed.geometry) || exceed_caches(packed.opaque);
  packed.geometry.for_each([&](const auto& geometry) {
    if (geometry.finder(RayKind::to_soft_light) == Finder::light_sweep)
      packed.sweeps_soft_light = true;
  });
  if (packed.sweeps_soft_light && packed.sets_to_be_sure > 1)
    throw std::logic_error("a sweep tells points of no other set than their own");
  packed.background = narrowed<T>(scene.background);
  packed.shadows = scene.shadows;
  packed.materials = make_materials<T>(scene, features);
  packed.transmits = features.transmits;
  packed.max_depth = std::min(features.max_depth, most_counted);
  return packed;
}

template PacketScene<float> make_packet_scene<float>(const PackedScene&, const Features&,
                                                     const FinderTable&, WorkerPool&);
template PacketScene<double> make_packet_scene<double>(const PackedScene&, const Features&,
                                                       const FinderTable&, WorkerPool&);

}  // namespace raytracer
