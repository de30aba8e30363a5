#include "client/formats/particles/atom_collector.h"

#include <gemmi/resinfo.hpp>
#include <utility>

namespace raytracer::client {
namespace {

bool is_water(std::string_view residue) {
  return gemmi::find_tabulated_residue(std::string(residue)).is_water();
}

}  // namespace

AtomCollector::AtomCollector(const Wishes& wishes) : wishes_(wishes) {
  if (wishes.color.empty()) wishes_.color = "element";
  const std::string& color = wishes_.color;
  if (color != "element" && color != "chain" && color != "residue") color_column_ = color;
}

void AtomCollector::omit(int line, std::string_view one, std::string_view many) {
  add_omission(particles_.omissions, line, one, many);
}

std::optional<std::uint32_t> AtomCollector::add(int line, const Atom& atom, float color_value) {
  if (!wishes_.with_water && is_water(atom.residue)) {
    omit(line, "atom of water left out (--water shows it)",
         "atoms of water left out (--water shows them)");
    has_left_out_ = true;
    return std::nullopt;
  }
  // Of a residue that the file has in several places the first one is shown.
  const auto is_same_residue = [&] {
    return residue_.size() == atom.chain.size() + 1 + atom.number.size() &&
           residue_.starts_with(atom.chain) && residue_.ends_with(atom.number);
  };
  if (!is_same_residue()) {
    residue_.assign(atom.chain).append(" ").append(atom.number);
    alternate_.clear();
  }
  if (!atom.alternate.empty()) {
    if (alternate_.empty()) alternate_ = atom.alternate;
    if (alternate_ != atom.alternate) {
      omit(line, "atom in an alternate location left out", "atoms in alternate locations left out");
      return std::nullopt;
    }
  }
  const auto index = static_cast<std::uint32_t>(particles_.places.size());
  particles_.places.push_back(atom.place);
  particles_.elements.push_back(atom.element);
  if (color_column_)
    particles_.values.push_back(color_value);
  else if (wishes_.color != "element")
    particles_.groups.push_back(
        groups_.number_of(wishes_.color == "chain" ? atom.chain : atom.residue));
  return index;
}

Particles AtomCollector::take(int line) {
  if (particles_.places.empty())
    throw LineError{line, has_left_out_ ? "the model has nothing but water; --water shows it"
                                        : "the file has no atoms"};
  particles_.group_names = groups_.names();
  residue_.clear();
  return std::exchange(particles_, {});
}

}  // namespace raytracer::client
