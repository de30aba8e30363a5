// The connections of an mmCIF (_struct_conn), which name atoms by chain, residue, number, insertion
// code and atom. Of most there are two names, the author's (auth_) and the archive's own (label_):
// compared are those that both tables have.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "client/formats/particles/cif_contents.h"
#include "client/formats/particles/particles.h"

namespace raytracer::client {

class CifBonds {
 public:
  /// The tables outlive it.
  CifBonds(const CifTable& sites, const CifTable& connections);

  /// The site of that row is shown as the particle of that index; nothing: it is left out on
  /// purpose.
  void add_site(std::size_t row, std::optional<std::uint32_t> index);

  /// Ends the model: adds its bonds, and counts what cannot be one.
  void take(Particles& particles);

 private:
  static constexpr std::size_t part_count = 5;
  using AtomName = std::array<std::string, part_count>;

  /// Where a part of a name stands; -1: it is not compared.
  struct Part {
    int of_site = -1;
    std::array<int, 2> of_partner{-1, -1};
  };

  /// A site of the model.
  struct Site {
    std::optional<std::uint32_t> index;
    bool shares_name = false;
    std::string location{};  ///< which of its alternate ones is shown; empty: it has but one
  };

  Part common_part(const std::string& name, const std::array<std::string, 2>& kinds) const;
  const Site* find_partner(std::size_t row, std::size_t partner) const;
  std::string copy_of(std::size_t row, std::size_t partner) const;
  bool is_shown(std::size_t row, std::size_t partner, const Site& site) const;
  void add_connection(std::size_t row, Particles& particles) const;

  const CifTable& sites_;
  const CifTable& connections_;
  std::array<Part, part_count> parts_;
  int type_;
  std::array<int, 2> symmetries_;
  int location_;
  std::array<int, 2> locations_;
  std::map<AtomName, Site> by_name_;  ///< of this model
};

}  // namespace raytracer::client
