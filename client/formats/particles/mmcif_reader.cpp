#include "client/formats/particles/mmcif_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "client/formats/numbers.h"
#include "client/formats/particles/cif_lines.h"
#include "client/formats/particles/elements.h"
#include "client/formats/printable.h"
#include "client/formats/words.h"

namespace raytracer::client {
namespace {

const std::string site_prefix = "_atom_site.";

/// "1.234(5)" is 1.234, of which the last digit is uncertain by 5.
std::string_view without_uncertainty(std::string_view number) {
  const std::size_t begin = number.find('(');
  return number.ends_with(')') && begin != number.npos && begin > 0 ? number.substr(0, begin)
                                                                    : number;
}

CifContents read_contents(const std::string& text) {
  try {
    return read_cif(text);
  } catch (const CifError& error) {
    throw LineError{error.line, printable(error.what)};
  }
}

}  // namespace

MmcifReader::MmcifReader(std::unique_ptr<TextSource> source, const ImportOptions& options)
    : atoms_(options),
      text_(without_byte_order_mark(read_all(*source))),
      contents_(read_contents(text_)) {
  row_count_ = 1;  // one frame
  if (!contents_.sites) return;
  row_count_ = contents_.sites->row_count();
  if (row_count_ == 0) throw LineError{contents_.sites->line, "the table of atoms has no rows"};
  find_columns();
  if (options.style != AtomStyle::spacefill)
    bonds_.emplace(*contents_.sites, contents_.connections);
}

void MmcifReader::find_columns() {
  const CifTable& sites = *contents_.sites;
  const auto find = [&](const std::string& name) { return sites.column(site_prefix + name); };
  const auto find_either = [&](const char* best, const char* other) {
    const int column = find(best);
    return column >= 0 ? column : find(other);
  };
  place_ = {find("Cartn_x"), find("Cartn_y"), find("Cartn_z")};
  if (place_[1] < 0 || place_[2] < 0)
    throw LineError{sites.line, "_atom_site has no Cartn_y or no Cartn_z"};
  element_ = find("type_symbol");
  chain_ = find_either("auth_asym_id", "label_asym_id");
  residue_ = find_either("auth_comp_id", "label_comp_id");
  residue_number_ = find_either("auth_seq_id", "label_seq_id");
  insertion_ = find("pdbx_PDB_ins_code");
  atom_ = find_either("auth_atom_id", "label_atom_id");
  alternate_ = find("label_alt_id");
  model_ = find("pdbx_PDB_model_num");
  const auto& wanted = atoms_.color_column();
  if (!wanted) return;
  color_ = find(*wanted == "bfactor" ? "B_iso_or_equiv" : *wanted);
  if (color_ >= 0) return find_color_words();
  std::vector<std::string> names{"element", "chain", "residue"};
  for (const std::string& tag : sites.tags)
    names.push_back(tag.starts_with(site_prefix) ? tag.substr(site_prefix.size()) : tag);
  throw LineError{sites.line, no_such_column(*wanted, names)};
}

/// Words are groups, numbers have an order: by the first that there is.
void MmcifReader::find_color_words() {
  for (std::size_t row = 0; row < row_count_; ++row) {
    const std::string text = value(row, color_);
    if (text.empty()) continue;
    if (!number_of(without_uncertainty(text))) atoms_.color_by_words();
    return;
  }
}

std::string MmcifReader::value(std::size_t row, int column) const {
  return contents_.sites->value(row, column);
}

double MmcifReader::number(std::size_t row, int column) const {
  const CifTable& sites = *contents_.sites;
  const std::string text = value(row, column);
  const auto number = number_of(without_uncertainty(text));
  const auto place = static_cast<std::size_t>(column);
  if (!number || !is_moderate(*number))
    throw LineError{line_of_value(text_, sites, row * sites.tags.size() + place),
                    fmt::format("{} stands where {} is to be a number", client::quoted(text),
                                sites.tags[place])};
  return *number;
}

void MmcifReader::read_row(std::size_t row) {
  const model::Triple place{number(row, place_[0]), number(row, place_[1]), number(row, place_[2])};
  const std::string chain = value(row, chain_);
  const std::string residue = value(row, residue_);
  const std::string number_in_chain = value(row, residue_number_) + value(row, insertion_);
  const std::string atom = value(row, atom_);
  const std::string alternate = value(row, alternate_);
  std::uint8_t element = element_of(value(row, element_));
  if (element_ < 0) element = element_of(atom.substr(0, 1));
  const std::string color_word = value(row, color_);
  float color_value = std::numeric_limits<float>::quiet_NaN();
  if (color_ >= 0 && !color_word.empty() && !atoms_.is_colored_by_words())
    color_value = as_float(number(row, color_));
  const auto index = atoms_.add(
      contents_.sites->line,
      {place, element, chain, residue, number_in_chain, atom, alternate, color_word}, color_value);
  if (bonds_) bonds_->add_site(row, index);
}

Particles MmcifReader::read_cell() {
  row_ = row_count_;
  if (atoms_.color_column())
    throw LineError{1, no_such_column(*atoms_.color_column(), {"element"})};
  for (const CifSite& site : contents_.cell_sites) {
    const model::Triple place{site.x, site.y, site.z};
    if (!std::all_of(place.begin(), place.end(), is_moderate))
      throw LineError{1, fmt::format("the site {} has no place", client::quoted(site.label))};
    atoms_.add(1, {place, element_of(site.element), "", "", "", "", ""}, 0);
  }
  return atoms_.take(1);
}

std::optional<Particles> MmcifReader::next_frame() {
  if (!contents_.sites) return read_cell();
  const std::string model = value(row_, model_);
  for (; row_ < row_count_ && value(row_, model_) == model; ++row_) read_row(row_);
  Particles particles = atoms_.take(contents_.sites->line);
  if (bonds_) bonds_->take(particles);
  return particles;
}

}  // namespace raytracer::client
