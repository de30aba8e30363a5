#include "client/formats/particles/cif_contents.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <gemmi/cif.hpp>
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

std::vector<CifSite> sites_of_cell(cif::Block& block) {
  std::vector<CifSite> sites;
  try {
    gemmi::SmallStructure structure = gemmi::make_small_structure_from_block(block);
    use_operators(block, structure.cell);
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
