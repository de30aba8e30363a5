// Atoms or other particles as a file has them, before anything is drawn: places, and of their other
// columns those that the picture needs.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "client/formats/reading.h"

namespace raytracer::client {

struct Particles {
  std::vector<model::Triple> places;
  /// Each of these has nothing, or one for each place.
  std::vector<std::uint8_t> elements;  ///< atomic numbers; 0: unknown
  std::vector<double> radii;
  std::vector<model::Rgb> colors;     ///< as screens show them (sRGB)
  std::vector<float> values;          ///< for a colour map; NaN: unknown
  std::vector<std::uint32_t> groups;  ///< for a colour each: indices into group_names
  std::vector<std::string> group_names;

  /// Pairs of places that the file names as bonded.
  std::vector<std::array<std::uint32_t, 2>> bonds;
  /// Of these places that `bonds` has, the file names all bonds to other such; nothing, or one for
  /// each place.
  std::vector<bool> has_all_bonds;

  std::vector<Omission> omissions;
};

/// What is wrong with a file that names columns or groups that are asked for in vain: "no column
/// is called 'mass'; there are x, y, z".
std::string no_such_column(const std::string& wanted, const std::vector<std::string>& known);

/// The number of a name among those of groups; new names are added.
class GroupNames {
 public:
  std::uint32_t number_of(std::string_view name);
  const std::vector<std::string>& names() const { return names_; }

 private:
  std::vector<std::string> names_;
  std::vector<std::uint32_t> by_name_;  ///< numbers in the order of their names
  std::uint32_t last_ = 0;
};

}  // namespace raytracer::client
