#include "client/formats/particles/pdb_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <gemmi/resinfo.hpp>
#include <set>
#include <utility>

#include "client/formats/numbers.h"
#include "client/formats/particles/columns.h"
#include "client/formats/particles/elements.h"
#include "client/formats/printable.h"

namespace raytracer::client {
namespace {

/// Columns from 1, as the format counts them, without white space around.
std::string_view field(std::string_view line, std::size_t first, std::size_t last) {
  if (line.size() < first) return {};
  std::string_view text = line.substr(first - 1, last - first + 1);
  while (text.starts_with(' ')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

bool is_record(std::string_view line, std::string_view name) {
  return line.starts_with(name) && (line.size() == name.size() || line[name.size()] == ' ');
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Some programs write serials from 100,000 on into the sixth column, too.
bool is_atom(std::string_view line) {
  return line.starts_with("HETATM") ||
         (line.starts_with("ATOM ") && line.size() > 5 && (line[5] == ' ' || is_digit(line[5])));
}

/// Decimal, or in hybrid-36 from 100,000 on; nothing if it is neither.
std::optional<int> serial_of(std::string_view text) {
  if (text.empty()) return std::nullopt;
  int serial = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, serial);
  if (error == std::errc() && stop == end) return serial;
  constexpr std::size_t width = 5;
  if (text.size() != width || text[0] < 'A') return std::nullopt;
  // cci.lbl.gov/hybrid_36: A0000 is the first.
  constexpr int base = 36;
  constexpr int first = 10 * base * base * base * base;
  const auto [last, wrong] = std::from_chars(text.data(), end, serial, base);
  if (wrong != std::errc() || last != end) return std::nullopt;
  return serial - first + 100'000;
}

std::optional<int> serial_of_atom(std::string_view line) {
  return serial_of(field(line, line.starts_with("ATOM ") ? 6 : 7, 11));
}

bool is_latin(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

bool is_polymer(std::string_view residue) {
  // Amber's and CHARMM's names of histidine and cystine, which say their hydrogens.
  for (const char* const known : {"HIE", "HID", "HIP", "HSD", "HSE", "HSP", "CYX"})
    if (residue == known) return true;
  const auto& info = gemmi::find_tabulated_residue(std::string(residue));
  return info.is_amino_acid() || info.is_nucleic_acid();
}

/// CHARMM's names of ions, which are their residues' too; 0 of others.
std::uint8_t element_of_ion(std::string_view residue, std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 7> ions{
      {{"SOD", "NA"},
       {"POT", "K"},
       {"CLA", "CL"},
       {"CAL", "CA"},
       {"CES", "CS"},
       {"LIT", "LI"},
       {"RUB", "RB"}}};
  for (const auto& [known, symbol] : ions)
    if (residue == known && name == known) return element_of(symbol);
  return 0;
}

/// From columns 77 and 78, which old files use otherwise, else from the atom's name, where elements
/// of one letter stand in its second column. Not all files hold to that: CA in a protein is carbon.
std::uint8_t element_of_atom(std::string_view line) {
  const std::string_view symbol = field(line, 77, 78);
  if (!symbol.empty() && is_latin(symbol[0]))
    if (const std::uint8_t element = element_of(symbol)) return element;
  const std::string_view name = line.substr(12, 4);
  if (const std::uint8_t ion = element_of_ion(field(line, 18, 20), field(line, 13, 16))) return ion;
  constexpr std::uint8_t hydrogen = 1;
  // Names of four letters that begin with H are hydrogens': mercury's and helium's are shorter.
  if (name[0] == 'H' && name[3] != ' ') return hydrogen;
  if (!is_latin(name[0])) return element_of(name.substr(1, 1));
  const std::uint8_t of_first = element_of(name.substr(0, 1));
  const bool is_selenium = name.starts_with("SE");  // of selenomethionine
  if (of_first != 0 && !is_selenium && is_polymer(field(line, 18, 20))) return of_first;
  const std::uint8_t of_both = is_latin(name[1]) ? element_of(name.substr(0, 2)) : 0;
  return of_both != 0 ? of_both : of_first;
}

}  // namespace

PdbReader::PdbReader(std::unique_ptr<TextSource> source, const ImportOptions& options)
    : source_(std::move(source)), atoms_(options) {
  const auto& column = atoms_.color_column();
  if (column && *column != "bfactor" && *column != "occupancy")
    throw LineError{
        1, no_such_column(*column, {"element", "chain", "residue", "bfactor", "occupancy"})};
  if (options.style != AtomStyle::spacefill) {
    text_ = read_all(*source_);
    source_ = source_of_text(text_);
    read_bonds();
    source_ = source_of_text(text_);
  }
  lines_.emplace(*source_);
  find_next_model();
  if (lines_->at_end())
    throw lines_->wrong("the file has no atoms: no line begins with ATOM or HETATM");
}

/// The atoms' serials are read, too: a bond of an atom that no model has is told. Those that a
/// model lacks are not: some programs number the atoms of all models through.
void PdbReader::read_bonds() {
  struct Connection {
    Bond bond;
    int line;
  };
  std::vector<Connection> connections;
  std::vector<int> serials;
  for (Lines lines(*source_); !lines.at_end(); lines.advance()) {
    const std::string_view line = lines.line();
    if (is_atom(line))
      if (const auto serial = serial_of_atom(line)) serials.push_back(*serial);
    if (!line.starts_with("CONECT")) continue;
    const auto from = serial_of(field(line, 7, 11));
    for (std::size_t column = 12; from && column <= 27; column += 5)
      if (const auto to = serial_of(field(line, column, column + 4)))
        connections.push_back({{*from, *to}, lines.number()});
  }
  std::sort(serials.begin(), serials.end());
  const auto is_there = [&](int serial) {
    return std::binary_search(serials.begin(), serials.end(), serial);
  };
  std::set<Bond> told;  // each stands with both of its atoms
  for (const auto& [bond, line] : connections) {
    bonds_.push_back(bond);
    if (std::all_of(bond.begin(), bond.end(), is_there)) continue;
    if (!told.insert({std::min(bond[0], bond[1]), std::max(bond[0], bond[1])}).second) continue;
    add_omission(omissions_, line, "bond of an atom that is not in the file left out",
                 "bonds of atoms that are not in the file left out");
  }
}

void PdbReader::read_atom() {
  const std::string_view line = lines_->line();
  constexpr std::size_t end_of_places = 54;
  if (line.size() < end_of_places)
    throw lines_->wrong(fmt::format(
        "the atom's line ends before column {}, with which its places end", end_of_places));
  Atom atom{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t first = 31 + 8 * i;
    const std::string_view text = field(line, first, first + 7);
    const auto value = number_of(text);
    if (!value || !is_moderate(*value))
      throw lines_->wrong(fmt::format("{} stands in columns {} to {}, where {} is to be a number",
                                      quoted(text), first, first + 7, "xyz"[i]));
    atom.place[i] = *value;
  }
  atom.element = element_of_atom(line);
  atom.chain = field(line, 22, 22);
  atom.residue = field(line, 18, 20);
  atom.number = field(line, 23, 27);
  atom.name = field(line, 13, 16);
  atom.alternate = field(line, 17, 17);
  float color_value = 0;
  if (const auto& column = atoms_.color_column()) {
    const std::string_view text = *column == "bfactor" ? field(line, 61, 66) : field(line, 55, 60);
    const auto value = number_of(text);
    if (!value)
      throw lines_->wrong(
          fmt::format("{} stands where {} is to be a number", quoted(text), *column));
    color_value = as_float(*value);
  }
  const auto index = atoms_.add(lines_->number(), atom, color_value);
  if (!index || bonds_.empty()) return;
  if (const auto serial = serial_of_atom(line)) by_serial_[*serial] = *index;
  if (line.starts_with("HETATM")) hetero_.push_back(*index);
}

void PdbReader::add_bonds(Particles& particles) const {
  for (const auto& [from, to] : bonds_) {
    const auto a = by_serial_.find(from);
    const auto b = by_serial_.find(to);
    if (a != by_serial_.end() && b != by_serial_.end() && a->second != b->second)
      particles.bonds.push_back({a->second, b->second});
  }
  // CONECT has all bonds of a hetero atom or none, but of a standard residue only those to others.
  particles.has_all_bonds.resize(particles.places.size());
  for (const std::uint32_t atom : hetero_) particles.has_all_bonds[atom] = true;
}

void PdbReader::find_next_model() {
  while (!lines_->at_end() && !is_atom(lines_->line())) lines_->advance();
}

std::optional<Particles> PdbReader::next_frame() {
  by_serial_.clear();
  hetero_.clear();
  for (; !lines_->at_end(); lines_->advance()) {
    const std::string_view line = lines_->line();
    if (is_atom(line)) read_atom();
    // Not every program ends a model before it begins the next.
    if (is_record(line, "ENDMDL") || is_record(line, "END") || is_record(line, "MODEL")) break;
  }
  Particles particles = atoms_.take(lines_->number());
  add_bonds(particles);
  for (Omission& kind : omissions_) particles.omissions.push_back(std::move(kind));
  omissions_.clear();
  find_next_model();
  return particles;
}

}  // namespace raytracer::client
