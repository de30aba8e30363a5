// What a CIF has that a picture needs, read by gemmi. In C++17: gemmi 0.5 has lists of types that
// are not complete yet, which clang refuses in C++20.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace raytracer::client {

/// Of a category, row for row; what is unknown or left open is empty.
struct CifTable {
  int line = 1;  ///< where it begins
  std::vector<std::string> tags;
  std::vector<std::string> values;

  /// Which column it is, small letters or capitals; -1: none.
  int column(const std::string& tag) const;
  std::size_t row_count() const { return tags.empty() ? 0 : values.size() / tags.size(); }
  /// Empty where it is not known or there is no such column.
  std::string value(std::size_t row, int column) const;
};

/// Of a small structure, in ångström.
struct CifSite {
  double x;
  double y;
  double z;
  std::string element;
  std::string label;
};

struct CifContents {
  std::optional<CifTable> sites;    ///< _atom_site with Cartn_x
  CifTable connections;             ///< _struct_conn
  std::vector<CifSite> cell_sites;  ///< without `sites`: those of one cell
};

struct CifError {
  int line;
  std::string what;
};

/// Of the first block that has atoms. Throws CifError.
CifContents read_cif(const std::string& text);

}  // namespace raytracer::client
