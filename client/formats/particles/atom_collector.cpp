#include "client/formats/particles/atom_collector.h"

#include <cmath>
#include <gemmi/resinfo.hpp>
#include <utility>

namespace raytracer::client {
namespace {

bool is_water(std::string_view residue) {
  // GROMACS's, and CHARMM's and Amber's as three columns hold them.
  for (const char* const known : {"SOL", "TIP", "TP3", "TP4", "SPC"})
    if (residue == known) return true;
  return gemmi::find_tabulated_residue(std::string(residue)).is_water();
}

}  // namespace

AtomCollector::AtomCollector(const ImportOptions& options) : options_(options) {
  if (options.color.empty()) options_.color = "element";
  const std::string& color = options_.color;
  if (color != "element" && color != "chain" && color != "residue") color_column_ = color;
}

void AtomCollector::omit(int line, std::string_view one, std::string_view many) {
  add_omission(particles_.omissions, line, one, many);
}

/// Whether the atom has been shown in another place, or where it stands another residue has.
bool AtomCollector::is_second_place(const Atom& atom) {
  const auto is_same_residue = [&] {
    return residue_.size() == atom.chain.size() + 1 + atom.number.size() &&
           residue_.starts_with(atom.chain) && residue_.ends_with(atom.number);
  };
  if (!is_same_residue()) {
    residue_.assign(atom.chain).append(" ").append(atom.number);
    name_ = atom.residue;
    shown_.clear();
  }
  if (atom.alternate.empty()) return false;
  return atom.residue != name_ || !shown_.emplace(atom.name).second;
}

std::optional<std::uint32_t> AtomCollector::add(int line, const Atom& atom, float color_value) {
  const bool is_left_out = !options_.with_water && is_water(atom.residue);
  if (is_left_out) {
    omit(line, "atom of water left out (--water shows it)",
         "atoms of water left out (--water shows them)");
    if (!particles_.places.empty()) return std::nullopt;
  } else {
    water_ = {};
  }
  if (is_second_place(atom)) {
    omit(line, "atom in an alternate location left out", "atoms in alternate locations left out");
    return std::nullopt;
  }
  Particles& among = is_left_out ? water_ : particles_;
  const auto index = static_cast<std::uint32_t>(among.places.size());
  among.places.push_back(atom.place);
  among.elements.push_back(atom.element);
  if (is_colored_by_words_)
    among.groups.push_back(groups_.number_of(atom.color_word));
  else if (color_column_)
    among.values.push_back(color_value);
  else if (options_.color != "element")
    among.groups.push_back(
        groups_.number_of(options_.color == "chain" ? atom.chain : atom.residue));
  if (is_left_out) return std::nullopt;
  if (color_column_ && !is_colored_by_words_ && std::isnan(color_value))
    omit(line, "atom is gray: its colour's number is missing",
         "atoms are gray: their colour's numbers are missing");
  return index;
}

Particles AtomCollector::take(int line) {
  if (particles_.places.empty()) particles_ = std::exchange(water_, {});
  if (particles_.places.empty()) throw LineError{line, "the file has no atoms"};
  particles_.group_names = groups_.names();
  residue_.clear();
  return std::exchange(particles_, {});
}

}  // namespace raytracer::client
