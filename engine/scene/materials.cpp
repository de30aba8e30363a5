#include "engine/scene/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>

#include "engine/scene/nearest_key.h"

namespace raytracer {

MaterialReader::MaterialReader(const Field& field) {
  const auto object = read_object(field);
  if (!object) return;
  object->for_each([&](std::string_view name, const Field& member) {
    const auto material = read_structure<Material>(member).value_or(Material{});
    if (!named_.try_emplace(name, Named{material, {}}).second) return;  // a duplicate, noted before
    names_.push_back(name);
  });
}

std::optional<MaterialIndex> MaterialReader::read_use(const Field& field) {
  if (field.value.is_object()) return use(*read_structure<Material>(field));
  std::string_view name;
  if (field.value.get(name)) {
    field.refuse("must be the name of a material, or a material in place");
    return {};
  }
  const auto found = named_.find(name);
  if (found == named_.end()) {
    field.refuse([&] { return fmt::format("there is no material \"{}\"{}", name, others(name)); });
    return {};
  }
  Named& named = found->second;
  if (!named.index) named.index = use(named.material);
  return named.index;
}

std::string MaterialReader::others(std::string_view name) const {
  if (names_.empty()) return ": \"materials\" has none";
  constexpr std::size_t most_compared = 256;  // a document may have a thousand wrong names
  constexpr std::size_t most_listed = 8;
  const std::span<const std::string_view> names(names_);
  const std::string slip = did_you_mean(name, names.first(std::min(names.size(), most_compared)));
  if (!slip.empty()) return slip;
  return fmt::format(": \"materials\" has \"{}\"{}",
                     fmt::join(names.first(std::min(names.size(), most_listed)), "\", \""),
                     names.size() > most_listed ? " and more" : "");
}

MaterialIndex MaterialReader::use(const Material& material) {
  const auto next = static_cast<MaterialIndex>(used_.size());
  const auto [place, is_new] = indices_.try_emplace(material, next);
  if (is_new) used_.push_back(material);
  return place->second;
}

}  // namespace raytracer
