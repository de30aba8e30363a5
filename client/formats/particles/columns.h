// A line's fields as a particle, by the names of the columns: x, y and z; element; radius or
// diameter; r, g and b (red, green and blue; from 0 to 1, or to 255); and the one that is to give
// the colours, or several, "vel_1" to "vel_3", of which "vel" is the length.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/formats/import_options.h"
#include "client/formats/particles/particles.h"

namespace raytracer::client {

class Columns {
 public:
  /// Of the options the colours count. Throws LineError of that line if places are missing or there
  /// is no column that is asked for.
  Columns(std::vector<std::string> names, const ImportOptions& options, int line);

  const std::vector<std::string>& names() const { return names_; }

  /// Adds a particle. Throws LineError of that line.
  void add(const std::vector<std::string_view>& fields, int line, Particles& particles);
  /// To be called behind a frame's last particle.
  void finish(Particles& particles) const;

 private:
  std::optional<std::size_t> find(std::initializer_list<std::string_view> names) const;
  void choose_colors(const ImportOptions& options, int line);
  std::optional<std::size_t> find_in_any_case(const std::string& name) const;
  double number(std::size_t column, std::string_view field, int line) const;
  void add_group_or_value(std::string_view field, int line, Particles& particles);
  void add_length(const std::vector<std::string_view>& fields, int line, Particles& particles);

  std::vector<std::string> names_;
  std::array<std::size_t, 3> place_{};
  std::optional<std::size_t> element_;
  std::optional<std::size_t> radius_;
  bool is_diameter_ = false;
  std::optional<std::array<std::size_t, 3>> rgb_;
  std::optional<int> incomplete_color_line_;  ///< of the names, if some of a colour's are missing
  std::vector<std::size_t> colors_;  ///< the one that gives them, or the components of a vector
  std::optional<bool> is_group_;     ///< the colours are by names; known from the first particle on
  GroupNames groups_;
};

}  // namespace raytracer::client
