#include "client/formats/particles/cif_bonds.h"

#include <fmt/format.h>

#include <algorithm>

namespace raytracer::client {

CifBonds::CifBonds(const CifTable& sites, const CifTable& connections)
    : sites_(sites),
      connections_(connections),
      type_(connections.column("_struct_conn.conn_type_id")),
      symmetries_{connections.column("_struct_conn.ptnr1_symmetry"),
                  connections.column("_struct_conn.ptnr2_symmetry")} {
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
  const auto [known, is_new] = by_name_.try_emplace(std::move(name), Site{index});
  if (is_new || !index) return;
  known->second.shares_name = known->second.index.has_value();
  known->second.index = index;
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

void CifBonds::add_connection(std::size_t row, Particles& particles) const {
  const auto omit = [&](std::string_view one, std::string_view many) {
    add_omission(particles.omissions, connections_.line, one, many);
  };
  if (connections_.value(row, type_) == "hydrog") return;
  if (connections_.value(row, symmetries_[0]) != connections_.value(row, symmetries_[1]))
    return omit("bond to another copy of the molecule left out",
                "bonds to other copies of the molecule left out");
  const Site* const a = find_partner(row, 0);
  const Site* const b = find_partner(row, 1);
  if (!a || !b)
    return omit("bond of an atom that is not in the model left out",
                "bonds of atoms that are not in the model left out");
  if (!a->index || !b->index || *a->index == *b->index) return;
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
