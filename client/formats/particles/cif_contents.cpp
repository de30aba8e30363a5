#include "client/formats/particles/cif_contents.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <gemmi/cif.hpp>
#include <gemmi/smcif.hpp>
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

CifTable table_of(cif::Item& item) {
  CifTable table;
  table.line = std::max(item.line_number, 1);
  table.tags = item.loop.tags;
  table.values = std::move(item.loop.values);
  for (std::string& value : table.values) value = cif::as_string(value);
  return table;
}

std::vector<CifSite> sites_of_cell(const cif::Block& block) {
  std::vector<CifSite> sites;
  try {
    const gemmi::SmallStructure structure = gemmi::make_small_structure_from_block(block);
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
  const auto found = std::find(tags.begin(), tags.end(), tag);
  return found == tags.end() ? -1 : static_cast<int>(found - tags.begin());
}

CifContents read_cif(const std::string& text) {
  cif::Document document = read_document(text);
  if (document.blocks.empty()) throw CifError{1, "the file has no data_ block"};
  cif::Block& block = document.blocks.front();
  CifContents contents;
  for (cif::Item& item : block.items) {
    if (item.type != cif::ItemType::Loop) continue;
    if (item.loop.find_tag("_atom_site.Cartn_x") >= 0) contents.sites = table_of(item);
    if (item.loop.find_tag("_struct_conn.conn_type_id") >= 0) contents.connections = table_of(item);
  }
  if (!contents.sites) contents.cell_sites = sites_of_cell(block);
  return contents;
}

}  // namespace raytracer::client
