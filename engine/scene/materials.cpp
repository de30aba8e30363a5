#include "engine/scene/materials.h"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>

#include "engine/scene/nearest_key.h"

namespace raytracer {
namespace {

/// The material as far as it is right: what is wrong was noted, and the scene is refused anyway.
Material read_material(const Field& field) {
  Material material;
  const auto read_all = [&]<class... Effect>(Types<Effect...>) {
    static constexpr auto fields = std::tuple_cat(Effect::fields...);
    const ObjectReader object(field, keys_of(fields, std::array<std::string_view, 0>{}));
    read_fields(object, fields, material);
  };
  read_all(MaterialEffects{});
  return material;
}

}  // namespace

void MaterialReader::read_named(const Field& field) {
  if (field.value.kind() != JsonKind::object) {
    const ObjectReader complain(field, {});
    return;
  }
  field.value.for_each_member([&](std::string_view name, JsonValue value) {
    const Path path = field.path.child(name);
    const auto [named, is_new] = named_.try_emplace(name);
    const Material material = read_material({value, path, field.errors});
    if (!is_new) return;  // a duplicate key, already noted
    named->second.material = material;
    names_.push_back(name);
  });
}

std::optional<MaterialIndex> MaterialReader::read_use(const Field& field) {
  if (field.value.kind() == JsonKind::object) return use(read_material(field));
  if (field.value.kind() != JsonKind::string) {
    field.refuse("must be the name of a material, or a material in place");
    return {};
  }
  const std::string_view name = field.value.string();
  const auto found = named_.find(name);
  if (found == named_.end()) {
    field.refuse_by([&] {
      if (names_.empty())
        return fmt::format("there is no material \"{}\": \"materials\" has none", name);
      constexpr std::size_t most_compared = 256;  // a document may have a thousand wrong names
      const std::span<const std::string_view> names(names_);
      return fmt::format("there is no material \"{}\"; did you mean \"{}\"?", name,
                         nearest_key(name, names.first(std::min(names.size(), most_compared))));
    });
    return {};
  }
  Named& named = found->second;
  if (!named.index) named.index = use(named.material);
  return named.index;
}

MaterialIndex MaterialReader::use(const Material& material) {
  const auto next = static_cast<MaterialIndex>(used_.size());
  const auto [place, is_new] = indices_.try_emplace(material, next);
  if (is_new) used_.push_back(material);
  return place->second;
}

}  // namespace raytracer
