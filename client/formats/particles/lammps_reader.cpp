#include "client/formats/particles/lammps_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "client/formats/numbers.h"
#include "client/formats/printable.h"

namespace raytracer::client {
namespace {

constexpr std::string_view item = "ITEM: ";

/// How places may be called, the best first.
struct PlaceNames {
  std::array<std::string_view, 3> names;
  bool is_scaled;
};

constexpr std::array<PlaceNames, 4> place_names{{{{"x", "y", "z"}, false},
                                                 {{"xu", "yu", "zu"}, false},
                                                 {{"xs", "ys", "zs"}, true},
                                                 {{"xsu", "ysu", "zsu"}, true}}};

}  // namespace

LammpsReader::LammpsReader(std::unique_ptr<TextSource> source, const ImportOptions& options)
    : source_(std::move(source)), lines_(*source_), options_(options) {
  lines_.skip_blank();
}

/// The line below a section's title, which it steps over.
std::string_view LammpsReader::value_line() {
  lines_.advance();
  if (lines_.at_end()) throw lines_.wrong("the file ends in the middle of a frame");
  return lines_.line();
}

std::size_t LammpsReader::read_count() {
  split_fields(value_line(), fields_);
  const auto count = fields_.size() == 1 ? count_of(fields_[0]) : std::nullopt;
  if (!count) throw lines_.wrong(fmt::format("{} is no number of atoms", quoted(lines_.line())));
  lines_.advance();
  return *count;
}

LammpsReader::Cell LammpsReader::read_cell() {
  const bool is_general = lines_.line().find("abc origin") != std::string_view::npos;
  const bool is_tilted = lines_.line().find("xy xz yz") != std::string_view::npos;
  const std::size_t width = is_general ? 4 : is_tilted ? 3 : 2;
  std::array<std::array<double, 4>, 3> rows{};
  for (auto& row : rows) {
    split_fields(value_line(), fields_);
    for (std::size_t i = 0; i < width; ++i) {
      const auto value = i < fields_.size() ? number_of(fields_[i]) : std::nullopt;
      if (!value || !is_moderate(*value))
        throw lines_.wrong(fmt::format("{} is no edge of the box, which has {} numbers",
                                       quoted(lines_.line()), width));
      row[i] = *value;
    }
  }
  lines_.advance();
  Cell cell;
  if (is_general) {
    for (std::size_t i = 0; i < 3; ++i) {
      cell.edges[i] = {rows[i][0], rows[i][1], rows[i][2]};
      cell.corner[i] = rows[i][3];
    }
    return cell;
  }
  // Of a tilted box the file has the bounds: docs.lammps.org/Howto_triclinic.html.
  const double xy = rows[0][2];
  const double xz = rows[1][2];
  const double yz = rows[2][2];
  cell.corner = {rows[0][0] - std::min({0.0, xy, xz, xy + xz}), rows[1][0] - std::min(0.0, yz),
                 rows[2][0]};
  const double x_high = rows[0][1] - std::max({0.0, xy, xz, xy + xz});
  const double y_high = rows[1][1] - std::max(0.0, yz);
  cell.edges = {{{x_high - cell.corner[0], 0, 0},
                 {xy, y_high - cell.corner[1], 0},
                 {xz, yz, rows[2][1] - cell.corner[2]}}};
  return cell;
}

void LammpsReader::read_columns() {
  split_fields(lines_.line(), fields_);
  std::vector<std::string> names(fields_.begin() + 2, fields_.end());
  if (columns_ && names == header_) return lines_.advance();
  header_ = names;
  const auto has = [&](std::string_view name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const auto* const places =
      std::find_if(place_names.begin(), place_names.end(), [&](const PlaceNames& known) {
        return std::all_of(known.names.begin(), known.names.end(), has);
      });
  if (places == place_names.end())
    throw lines_.wrong("the atoms have no places; dump x y z, xu yu zu or xs ys zs");
  is_scaled_ = places->is_scaled;
  const std::array<std::string_view, 3> axes{"x", "y", "z"};
  ImportOptions options = options_;
  for (std::size_t i = 0; i < 3; ++i) {
    *std::find(names.begin(), names.end(), places->names[i]) = axes[i];
    if (options.color == places->names[i]) options.color = axes[i];
  }
  columns_.emplace(std::move(names), options, lines_.number());
  lines_.advance();
}

/// Down to its first atom.
LammpsReader::Head LammpsReader::read_head() {
  Head head;
  std::optional<std::size_t> count;
  for (bool are_atoms_next = false; !are_atoms_next;) {
    const std::string_view line = lines_.line();
    if (lines_.at_end()) throw lines_.wrong("the file ends in the middle of a frame");
    if (!line.starts_with(item))
      throw lines_.wrong(
          fmt::format("{} stands where a line is to begin with ITEM:", quoted(line)));
    const std::string_view title = line.substr(item.size());
    if (title.starts_with("NUMBER OF ATOMS")) {
      count = read_count();
    } else if (title.starts_with("BOX BOUNDS")) {
      head.cell = read_cell();
    } else if (title.starts_with("ATOMS")) {
      are_atoms_next = true;
    } else if (title.starts_with("TIMESTEP") || title.starts_with("TIME") ||
               title.starts_with("UNITS")) {
      value_line();
      lines_.advance();
    } else {
      throw lines_.wrong(fmt::format("{} is no section of a dump of atoms", quoted(title)));
    }
  }
  if (!count) throw lines_.wrong("ITEM: NUMBER OF ATOMS is to stand before ITEM: ATOMS");
  head.count = *count;
  read_columns();
  if (is_scaled_ && !head.cell)
    throw lines_.wrong("places in box lengths need ITEM: BOX BOUNDS before ITEM: ATOMS");
  return head;
}

std::optional<Particles> LammpsReader::next_frame() {
  Particles particles;
  Head head = read_head();
  for (; head.count == 0; head = read_head()) {  // what is poured in is not there at the beginning
    add_omission(particles.omissions, lines_.number(), "frame without atoms left out",
                 "frames without atoms left out");
    lines_.skip_blank();
    if (lines_.at_end()) return std::nullopt;
  }
  for (std::size_t i = 0; i < head.count; ++i) {
    if (lines_.at_end() || lines_.line().starts_with(item))
      throw lines_.wrong(fmt::format("the frame ends after {} of {} atoms", i, head.count));
    split_fields(lines_.line(), fields_);
    columns_->add(fields_, lines_.number(), particles);
    lines_.advance();
  }
  columns_->finish(particles);
  lines_.skip_blank();
  if (is_scaled_)
    for (model::Triple& place : particles.places) {
      model::Triple sum = head.cell->corner;
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k) sum[k] += place[i] * head.cell->edges[i][k];
      place = sum;
    }
  return particles;
}

}  // namespace raytracer::client
