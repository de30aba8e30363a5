#include "client/formats/particles/mmcif_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <gemmi/cif.hpp>
#include <gemmi/smcif.hpp>
#include <limits>

#include "client/formats/particles/columns.h"
#include "client/formats/particles/elements.h"
#include "client/formats/printable.h"
#include "client/formats/words.h"

namespace raytracer::client {
namespace {

namespace cif = gemmi::cif;

constexpr std::string_view site_prefix = "_atom_site.";

cif::Document read_document(const std::string& text) {
  try {
    return cif::read_memory(text.data(), text.size(), "");
  } catch (const tao::pegtl::parse_error& error) {
    const auto& place = error.positions().front();
    throw LineError{static_cast<int>(place.line), printable(error.message())};
  } catch (const std::exception& error) {
    // ":LINE in data_BLOCK: MESSAGE", where that is known.
    const std::string_view message = error.what();
    int line = 1;
    if (message.starts_with(':'))
      std::from_chars(message.data() + 1, message.data() + message.size(), line);
    throw LineError{std::max(line, 1), printable(message)};
  }
}

}  // namespace

MmcifReader::MmcifReader(std::unique_ptr<TextSource> source, const Wishes& wishes)
    : atoms_(wishes), has_bonds_(wishes.style != AtomStyle::spacefill) {
  const std::string text = read_all(*source);
  document_ = read_document(text);
  if (document_.blocks.empty()) throw LineError{1, "the file has no data_ block"};
  block_ = &document_.blocks.front();
  for (cif::Item& item : block_->items)
    if (item.type == cif::ItemType::Loop && item.loop.find_tag("_atom_site.Cartn_x") >= 0) {
      sites_ = &item.loop;
      sites_line_ = item.line_number;
    }
  if (sites_) {
    row_count_ = sites_->length();
    find_columns();
  } else {
    row_count_ = 1;  // one frame
  }
}

void MmcifReader::find_columns() {
  const auto find = [this](std::string_view name) {
    return sites_->find_tag(std::string(site_prefix) + std::string(name));
  };
  const auto find_either = [&](std::string_view best, std::string_view other) {
    const int column = find(best);
    return column >= 0 ? column : find(other);
  };
  place_ = {find("Cartn_x"), find("Cartn_y"), find("Cartn_z")};
  if (place_[1] < 0 || place_[2] < 0)
    throw LineError{sites_line_, "_atom_site has no Cartn_y or no Cartn_z"};
  element_ = find("type_symbol");
  chain_ = find_either("auth_asym_id", "label_asym_id");
  residue_ = find_either("auth_comp_id", "label_comp_id");
  residue_number_ = find_either("auth_seq_id", "label_seq_id");
  insertion_ = find("pdbx_PDB_ins_code");
  atom_ = find_either("auth_atom_id", "label_atom_id");
  alternate_ = find("label_alt_id");
  model_ = find("pdbx_PDB_model_num");
  const auto& wished = atoms_.color_column();
  if (!wished) return;
  color_ = find(*wished == "bfactor" ? "B_iso_or_equiv" : *wished);
  if (color_ >= 0) return;
  std::vector<std::string> names{"element", "chain", "residue"};
  for (const std::string& tag : sites_->tags)
    names.push_back(tag.starts_with(site_prefix) ? tag.substr(site_prefix.size()) : tag);
  throw LineError{sites_line_, no_such_column(*wished, names)};
}

/// Empty where it is not known or there is no such column.
std::string MmcifReader::value(std::size_t row, int column) const {
  if (column < 0) return {};
  return cif::as_string(sites_->values[row * sites_->width() + static_cast<std::size_t>(column)]);
}

LineError MmcifReader::wrong(std::size_t row, const std::string& what) const {
  return {sites_line_, fmt::format("row {} of the table that begins here: {}", row + 1, what)};
}

double MmcifReader::number(std::size_t row, int column) const {
  const std::string text = value(row, column);
  const auto number = number_of(text);
  if (!number || !is_moderate(*number))
    throw wrong(row, fmt::format("{} stands where {} is to be a number", client::quoted(text),
                                 sites_->tags[static_cast<std::size_t>(column)]));
  return *number;
}

void MmcifReader::read_row(std::size_t row) {
  const model::Triple place{number(row, place_[0]), number(row, place_[1]), number(row, place_[2])};
  const std::string chain = value(row, chain_);
  const std::string residue = value(row, residue_);
  const std::string residue_number = value(row, residue_number_);
  const std::string insertion = value(row, insertion_);
  const std::string alternate = value(row, alternate_);
  const std::string whole_number = residue_number + insertion;
  std::uint8_t element = element_of(value(row, element_));
  if (element_ < 0) element = element_of(value(row, atom_).substr(0, 1));
  float color_value = 0;
  if (color_ >= 0)
    color_value = static_cast<float>(
        std::clamp(number(row, color_), -static_cast<double>(std::numeric_limits<float>::max()),
                   static_cast<double>(std::numeric_limits<float>::max())));
  const auto index = atoms_.add(
      sites_line_, {place, element, chain, residue, whole_number, alternate}, color_value);
  if (index && has_bonds_)
    by_name_.try_emplace({chain, residue, residue_number, insertion, value(row, atom_)}, *index);
}

void MmcifReader::add_bonds(Particles& particles) {
  if (!has_bonds_) return;
  const std::string category = "_struct_conn.";
  std::vector<std::string> tags{"conn_type_id"};
  for (const char* const partner : {"ptnr1_", "ptnr2_"})
    for (const char* const name :
         {"auth_asym_id", "auth_comp_id", "auth_seq_id", "?PDB_ins_code", "label_atom_id"})
      tags.push_back(name[0] == '?' ? fmt::format("?pdbx_{}{}", partner, name + 1)
                                    : fmt::format("{}{}", partner, name));
  for (const auto row : block_->find(category, tags)) {
    if (row.str(0) == "hydrog") continue;
    std::array<const std::uint32_t*, 2> atoms{};
    for (std::size_t partner = 0; partner < 2; ++partner) {
      AtomName name;
      for (std::size_t i = 0; i < name.size(); ++i) {
        const int column = static_cast<int>(1 + partner * name.size() + i);
        if (row.has2(static_cast<std::size_t>(column))) name[i] = row.str(column);
      }
      const auto known = by_name_.find(name);
      if (known != by_name_.end()) atoms[partner] = &known->second;
    }
    if (atoms[0] && atoms[1] && *atoms[0] != *atoms[1])
      particles.bonds.push_back({*atoms[0], *atoms[1]});
  }
}

Particles MmcifReader::read_small_structure() {
  row_ = row_count_;
  if (atoms_.color_column())
    throw LineError{1, no_such_column(*atoms_.color_column(), {"element"})};
  gemmi::SmallStructure structure;
  try {
    structure = gemmi::make_small_structure_from_block(*block_);
    for (const gemmi::SmallStructure::Site& site : structure.get_all_unit_cell_sites()) {
      const gemmi::Position place = structure.cell.orthogonalize(site.fract);
      const model::Triple triple{place.x, place.y, place.z};
      if (!std::all_of(triple.begin(), triple.end(), is_moderate))
        throw LineError{1, fmt::format("the site {} has no place", client::quoted(site.label))};
      const std::uint8_t element = element_of(site.element.name());
      atoms_.add(1, {triple, element, "", "", "", ""}, 0);
    }
  } catch (const std::runtime_error& error) {
    throw LineError{1, printable(error.what())};
  }
  return atoms_.take(1);
}

Particles MmcifReader::next_frame() {
  if (!sites_) return read_small_structure();
  by_name_.clear();
  const std::string model = value(row_, model_);
  for (; row_ < row_count_ && value(row_, model_) == model; ++row_) read_row(row_);
  Particles particles = atoms_.take(sites_line_);
  add_bonds(particles);
  return particles;
}

}  // namespace raytracer::client
