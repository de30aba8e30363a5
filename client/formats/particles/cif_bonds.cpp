#include "client/formats/particles/cif_bonds.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <gemmi/util.hpp>
#include <utility>

namespace raytracer::client {
namespace {

/// Hydrogen bonds, salt bridges and mismatched base pairs hold molecules together without one.
bool is_bond(const std::string& type) {
  static constexpr std::array<const char*, 3> others{"hydrog", "saltbr", "mismat"};
  return std::none_of(others.begin(), others.end(),
                      [&](const char* other) { return gemmi::iequal(type, other); });
}

}  // namespace

CifBonds::CifBonds(const CifTable& sites, const CifTable& connections)
    : sites_(sites),
      connections_(connections),
      type_(connections.column("_struct_conn.conn_type_id")),
      symmetries_{connections.column("_struct_conn.ptnr1_symmetry"),
                  connections.column("_struct_conn.ptnr2_symmetry")},
      location_(sites.column("_atom_site.label_alt_id")),
      locations_{connections.column("_struct_conn.pdbx_ptnr1_label_alt_id"),
                 connections.column("_struct_conn.pdbx_ptnr2_label_alt_id")} {
  const Part number = common_part("seq_id", {"auth", "label"});
  Part insertion{sites.column("_atom_site.pdbx_PDB_ins_code"),
                 {connections.column("_struct_conn.pdbx_ptnr1_PDB_ins_code"),
                  connections.column("_struct_conn.pdbx_ptnr2_PDB_ins_code")}};
  // A part of the author's numbers alone.
  const bool is_known = insertion.of_site >= 0 && insertion.of_partner[0] >= 0 &&
                        insertion.of_partner[1] >= 0 &&
                        number.of_site == sites.column("_atom_site.auth_seq_id");
  parts_ = {common_part("asym_id", {"auth", "label"}), common_part("comp_id", {"auth", "label"}),
            number, is_known ? insertion : Part{}, common_part("atom_id", {"label", "auth"})};
}

/// Of the kinds the first that both tables have; else one of each, which may well be the same.
CifBonds::Part CifBonds::common_part(const std::string& name,
                                     const std::array<std::string, 2>& kinds) const {
  const std::array<std::array<std::size_t, 2>, 4> pairs{{{0, 0}, {1, 1}, {0, 1}, {1, 0}}};
  for (const auto& [site, partner] : pairs) {
    const auto of_partner = [&, kind = kinds[partner]](int number) {
      return connections_.column(fmt::format("_struct_conn.ptnr{}_{}_{}", number, kind, name));
    };
    const Part part{sites_.column(fmt::format("_atom_site.{}_{}", kinds[site], name)),
                    {of_partner(1), of_partner(2)}};
    if (part.of_site >= 0 && part.of_partner[0] >= 0 && part.of_partner[1] >= 0) return part;
  }
  return {};
}

void CifBonds::add_site(std::size_t row, std::optional<std::uint32_t> index) {
  if (connections_.values.empty()) return;
  AtomName name;
  std::transform(parts_.begin(), parts_.end(), name.begin(),
                 [&](const Part& part) { return sites_.value(row, part.of_site); });
  const auto [known, is_new] = by_name_.try_emplace(std::move(name), Site{});
  if (!index) return;
  Site& site = known->second;
  site.shares_name = site.index.has_value();
  site.index = index;
  site.location = sites_.value(row, location_);
}

/// Null if the model has no such atom.
const CifBonds::Site* CifBonds::find_partner(std::size_t row, std::size_t partner) const {
  AtomName name;
  std::transform(parts_.begin(), parts_.end(), name.begin(), [&](const Part& part) {
    return connections_.value(row, part.of_partner[partner]);
  });
  const auto known = by_name_.find(name);
  return known == by_name_.end() ? nullptr : &known->second;
}

/// Which copy of the molecule a partner is in.
std::string CifBonds::copy_of(std::size_t row, std::size_t partner) const {
  const std::string symmetry = connections_.value(row, symmetries_[partner]);
  return symmetry.empty() ? "1_555" : symmetry;  // the copy that the file has
}

/// Whether the connection is one of that location of the site which is shown.
bool CifBonds::is_shown(std::size_t row, std::size_t partner, const Site& site) const {
  const std::string location = connections_.value(row, locations_[partner]);
  return location.empty() || site.location.empty() || location == site.location;
}

void CifBonds::add_connection(std::size_t row, Particles& particles) const {
  const auto omit = [&](std::string_view one, std::string_view many) {
    add_omission(particles.omissions, connections_.line, one, many);
  };
  if (!is_bond(connections_.value(row, type_))) return;
  if (copy_of(row, 0) != copy_of(row, 1))
    return omit("bond to another copy of the molecule left out",
                "bonds to other copies of the molecule left out");
  const Site* const a = find_partner(row, 0);
  const Site* const b = find_partner(row, 1);
  if (!a || !b)
    return omit("bond of an atom that is not in the model left out",
                "bonds of atoms that are not in the model left out");
  if (!a->index || !b->index || *a->index == *b->index) return;
  if (!is_shown(row, 0, *a) || !is_shown(row, 1, *b)) return;  // told with the alternate locations
  if (a->shares_name || b->shares_name)  // as waters do where they are not numbered
    return omit("bond of an atom that shares its name with others left out",
                "bonds of atoms that share their names with others left out");
  particles.bonds.push_back({*a->index, *b->index});
}

void CifBonds::take(Particles& particles) {
  for (std::size_t row = 0; row < connections_.row_count(); ++row) add_connection(row, particles);
  by_name_.clear();
}

}  // namespace raytracer::client
