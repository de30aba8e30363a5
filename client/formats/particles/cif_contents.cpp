#include "client/formats/particles/cif_contents.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <gemmi/cif.hpp>
#include <gemmi/numb.hpp>
#include <gemmi/smcif.hpp>
#include <gemmi/util.hpp>
#include <optional>
#include <utility>

namespace raytracer::client {
namespace {

namespace cif = gemmi::cif;

cif::Document read_document(const std::string& text) {
  try {
    return cif::read_memory(text.data(), text.size(), "");
  } catch (const tao::pegtl::parse_error& error) {
    throw CifError{static_cast<int>(error.positions().front().line), std::string(error.message())};
  } catch (const std::exception& error) {
    // ":LINE in data_BLOCK: MESSAGE", where that is known.
    const std::string message = error.what();
    const int line = message[0] == ':' ? std::atoi(message.c_str() + 1) : 1;
    throw CifError{std::max(line, 1), message};
  }
}

/// The category whose tags begin so: a loop or, where it has a single row, pairs.
std::optional<CifTable> table_of(cif::Block& block, const std::string& category) {
  std::optional<CifTable> table;
  const auto begin = [&](const cif::Item& item) {
    if (!table) table.emplace().line = std::max(item.line_number, 1);
  };
  for (cif::Item& item : block.items) {
    if (item.type == cif::ItemType::Loop && gemmi::istarts_with(item.loop.tags[0], category)) {
      begin(item);
      table->tags = item.loop.tags;
      table->values = std::move(item.loop.values);
      break;
    }
    if (item.type == cif::ItemType::Pair && gemmi::istarts_with(item.pair[0], category)) {
      begin(item);
      table->tags.push_back(item.pair[0]);
      table->values.push_back(item.pair[1]);
    }
  }
  if (table)
    for (std::string& value : table->values) value = cif::as_string(value);
  return table;
}

/// Those of the operators that the file lists, in place of those of the group that it names: one
/// name stands for several choices of the origin, and not every file has one.
void use_operators(cif::Block& block, gemmi::UnitCell& cell) {
  for (const char* const tag : {"_space_group_symop_operation_xyz", "_symmetry_equiv_pos_as_xyz"}) {
    const cif::Column operators = block.find_values(tag);
    if (operators.length() == 0) continue;
    cell.images.clear();
    for (const std::string& text : operators) {
      const gemmi::Op op = gemmi::parse_triplet(cif::as_string(text));
      if (op != gemmi::Op::identity())
        cell.images.push_back(gemmi::Transform{gemmi::rot_as_mat33(op), gemmi::tran_as_vec3(op)});
    }
    return;
  }
}

/// Moves every copy of the sites as a whole so that its middle is in the cell.
void bring_into_cell(gemmi::SmallStructure& structure) {
  gemmi::Vec3 sum(0, 0, 0);
  double count = 0;
  for (const gemmi::SmallStructure::Site& site : structure.sites) {
    const gemmi::Fractional& place = site.fract;
    if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.z)) continue;
    sum += place;
    ++count;
  }
  const auto cell_of = [](const gemmi::Vec3& place) {
    constexpr double rounding = 1e-3;  // thirds are written with few digits
    return gemmi::Vec3(std::floor(place.x + rounding), std::floor(place.y + rounding),
                       std::floor(place.z + rounding));
  };
  gemmi::Vec3 middle = sum / std::max(count, 1.0);
  const gemmi::Vec3 first = cell_of(middle);
  middle -= first;
  for (gemmi::SmallStructure::Site& site : structure.sites)
    site.fract = site.fract - gemmi::Fractional(first);
  for (gemmi::FTransform& image : structure.cell.images)
    image.vec -= cell_of(image.apply(gemmi::Fractional(middle)));
}

std::vector<CifSite> sites_of_cell(cif::Block& block) {
  for (const char* const tag : {"_cell_length_a", "_cell_length_b", "_cell_length_c"}) {
    const std::string* const length = block.find_value(tag);
    if (!length || !(cif::as_number(*length) > 0))
      throw CifError{1, std::string("the places are in a cell, of which there is no ") + tag};
  }
  std::vector<CifSite> sites;
  try {
    gemmi::SmallStructure structure = gemmi::make_small_structure_from_block(block);
    use_operators(block, structure.cell);
    bring_into_cell(structure);
    for (const gemmi::SmallStructure::Site& site : structure.get_all_unit_cell_sites()) {
      const gemmi::Position place = structure.cell.orthogonalize(site.fract);
      sites.push_back({place.x, place.y, place.z, site.element.name(), site.label});
    }
  } catch (const std::exception& error) {
    throw CifError{1, error.what()};
  }
  return sites;
}

}  // namespace

int CifTable::column(const std::string& tag) const {
  const std::string in_small_letters = gemmi::to_lower(tag);
  const auto found = std::find_if(tags.begin(), tags.end(), [&](const std::string& each) {
    return gemmi::iequal(each, in_small_letters);
  });
  return found == tags.end() ? -1 : static_cast<int>(found - tags.begin());
}

std::string CifTable::value(std::size_t row, int column) const {
  return column < 0 ? "" : values[row * tags.size() + static_cast<std::size_t>(column)];
}

CifContents read_cif(const std::string& text) {
  cif::Document document = read_document(text);
  if (document.blocks.empty()) throw CifError{1, "the file has no data_ block"};
  CifContents contents;
  for (cif::Block& block : document.blocks) {
    contents.sites = table_of(block, "_atom_site.");
    if (contents.sites && contents.sites->column("_atom_site.Cartn_x") >= 0) {
      contents.connections = table_of(block, "_struct_conn.").value_or(CifTable{});
      return contents;
    }
    contents.sites.reset();
    if (block.find_values("_atom_site_fract_x").length() == 0) continue;
    contents.cell_sites = sites_of_cell(block);
    break;
  }
  return contents;
}

}  // namespace raytracer::client
