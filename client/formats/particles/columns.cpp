#include "client/formats/particles/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "client/formats/ascii.h"
#include "client/formats/numbers.h"
#include "client/formats/particles/elements.h"
#include "client/formats/printable.h"

namespace raytracer::client {
namespace {

/// As spreadsheets, R, Python and simulations leave a number out, and what is no finite one. Na is
/// sodium.
bool is_missing(std::string_view field) {
  if (!field.empty() && field.front() >= '0' && field.front() <= '9') return false;  // as most are
  static constexpr std::array<std::string_view, 18> known{
      "",     "nan",  "-nan", "NaN",  "NAN", "NA",   "N/A", "n/a",  "#N/A",
      "<NA>", "null", "NULL", "None", "inf", "-inf", "Inf", "-Inf", "+inf"};
  return std::find(known.begin(), known.end(), field) != known.end();
}

constexpr std::string_view one_is_gray = "particle is gray: its colour's number is missing";

void add_unknown(int line, Particles& particles) {
  particles.values.push_back(std::numeric_limits<float>::quiet_NaN());
  add_omission(particles.omissions, line, one_is_gray,
               "particles are gray: their colour's numbers are missing");
}

}  // namespace

Columns::Columns(std::vector<std::string> names, const ImportOptions& options, int line)
    : names_(std::move(names)) {
  const std::array<std::string_view, 3> axes{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto column = find({axes[i]});
    if (!column)
      throw LineError{line, fmt::format("no column is called {}; the places are to be in columns "
                                        "that are called x, y and z{}",
                                        axes[i],
                                        names_.size() > 1 ? ""
                                                          : "; and there is only one: commas are "
                                                            "between them in a .csv, tabs in a "
                                                            ".tsv")};
    place_[i] = *column;
  }
  element_ = find({"element", "species", "symbol"});
  radius_ = find({"radius"});
  if (!radius_) {
    radius_ = find({"diameter"});
    is_diameter_ = radius_.has_value();
  }
  const auto red = find({"r", "red"});
  const auto green = find({"g", "green"});
  const auto blue = find({"b", "blue"});
  if (red && green && blue) rgb_ = {*red, *green, *blue};
  choose_colors(options, line);
  if (colors_.empty() && !rgb_ && (red || green || blue)) incomplete_color_line_ = line;
}

void Columns::choose_colors(const ImportOptions& options, int line) {
  const std::string& color = options.color;
  if (color.empty()) {
    const auto type = element_ || rgb_ ? std::nullopt : find({"type"});
    if (type) colors_ = {*type};
  } else if (color == "element" && element_) {
    rgb_.reset();
  } else if (const auto column = find_in_any_case(color)) {
    colors_ = {*column};
  } else {
    while (const auto component = find_in_any_case(fmt::format("{}_{}", color, colors_.size() + 1)))
      colors_.push_back(*component);
    if (colors_.empty()) throw LineError{line, no_such_column(color, names_)};
  }
  // Types are numbers without an order, unless a map is asked for.
  if (colors_.size() == 1 && !options.color_map && lower_case(names_[colors_[0]]) == "type")
    is_group_ = true;
}

/// The column of exactly that name, or else regardless of capitals.
std::optional<std::size_t> Columns::find_in_any_case(const std::string& name) const {
  const auto exact = std::find(names_.begin(), names_.end(), name);
  if (exact != names_.end()) return static_cast<std::size_t>(exact - names_.begin());
  return find({lower_case(name)});
}

std::optional<std::size_t> Columns::find(std::initializer_list<std::string_view> sought) const {
  for (const std::string_view name : sought)
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (lower_case(names_[i]) == name) return i;
  return std::nullopt;
}

double Columns::number(std::size_t column, std::string_view field, int line) const {
  const auto value = number_of(field);
  if (!value)
    throw LineError{line, fmt::format("{} stands where a number is to be, in column {}",
                                      field.empty() ? "nothing" : quoted(field),
                                      client::quoted(names_[column]))};
  return *value;
}

void Columns::add(const std::vector<std::string_view>& fields, int line, Particles& particles) {
  if (fields.size() < names_.size())
    throw LineError{
        line, fmt::format("the line has {} fields, and is to have {}: {}", fields.size(),
                          names_.size(), printable(fmt::format("{}", fmt::join(names_, " "))))};
  model::Triple place{};
  for (std::size_t i = 0; i < 3; ++i) {
    place[i] = number(place_[i], fields[place_[i]], line);
    if (!is_moderate(place[i]))
      throw LineError{line,
                      fmt::format("{} is too far away: at most 1e100", quoted(fields[place_[i]]))};
  }
  particles.places.push_back(place);
  if (element_) particles.elements.push_back(element_of_label(fields[*element_]));
  if (radius_) {
    const double radius = number(*radius_, fields[*radius_], line) / (is_diameter_ ? 2 : 1);
    if (!(radius > 0 && is_moderate(radius)))
      throw LineError{line,
                      fmt::format("the {} is {}, and must be greater than 0",
                                  is_diameter_ ? "diameter" : "radius", quoted(fields[*radius_]))};
    particles.radii.push_back(radius);
  }
  if (colors_.size() == 1) return add_group_or_value(fields[colors_[0]], line, particles);
  if (!colors_.empty()) return add_length(fields, line, particles);
  if (!rgb_) return;
  model::Rgb color{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double share = number((*rgb_)[i], fields[(*rgb_)[i]], line);
    if (!(share >= 0 && share <= 255))
      throw LineError{line,
                      fmt::format("the colour has {}, and takes numbers from 0 to 1, or to 255",
                                  quoted(fields[(*rgb_)[i]]))};
    color[i] = static_cast<float>(share);
  }
  particles.colors.push_back(color);
}

void Columns::add_group_or_value(std::string_view field, int line, Particles& particles) {
  const bool is_unknown = is_missing(field);
  if (!is_group_ && !is_unknown) {
    is_group_ = !number_of(field).has_value();
    if (*is_group_ && !particles.values.empty()) {  // all was missing, and taken for numbers
      particles.groups.assign(particles.values.size(), groups_.number_of(""));
      particles.values.clear();
      std::erase_if(particles.omissions,
                    [](const Omission& kind) { return kind.one == one_is_gray; });
    }
  }
  if (is_group_ == true)
    particles.groups.push_back(groups_.number_of(field));
  else if (is_unknown)
    add_unknown(line, particles);
  else
    particles.values.push_back(as_float(number(colors_[0], field, line)));
}

void Columns::add_length(const std::vector<std::string_view>& fields, int line,
                         Particles& particles) {
  double length = 0;
  for (const std::size_t component : colors_) {
    if (is_missing(fields[component])) return add_unknown(line, particles);
    length = std::hypot(length, number(component, fields[component], line));
  }
  particles.values.push_back(as_float(length));
}

void Columns::finish(Particles& particles) const {
  particles.group_names = groups_.names();
  if (incomplete_color_line_)
    add_omission(particles.omissions, *incomplete_color_line_,
                 "colour left out that lacks some of the columns r, g and b; a radius is called "
                 "radius",
                 "");
  // Bytes, if one of them is more than the whole share, and not by rounding.
  constexpr float more_than_rounded = 1.5F;
  const bool are_bytes =
      std::any_of(particles.colors.begin(), particles.colors.end(), [](const model::Rgb& color) {
        return std::any_of(color.begin(), color.end(),
                           [](float share) { return share > more_than_rounded; });
      });
  for (model::Rgb& color : particles.colors)
    for (float& share : color) share = std::min(are_bytes ? share / 255 : share, 1.0F);
}

}  // namespace raytracer::client
