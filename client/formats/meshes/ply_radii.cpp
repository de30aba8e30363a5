#include "client/formats/meshes/ply_radii.h"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <limits>

#include "client/formats/meshes/line_errors.h"
#include "client/formats/meshes/line_words.h"
#include "client/formats/meshes/ply_bodies.h"
#include "client/formats/meshes/ply_header.h"
#include "client/formats/numbers.h"

namespace raytracer::client {
namespace {

double value_of(std::string_view bytes, const PlyType& type, PlyBody body) {
  const std::uint64_t bits = ply_integer(bytes, body);
  if (!type.is_integer)
    return type.bytes == sizeof(float)
               ? static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)))
               : std::bit_cast<double>(bits);
  if (!type.is_signed) return static_cast<double>(bits);
  const std::size_t unused = 8 * (sizeof bits - type.bytes);
  return static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused);
}

/// The vertices stand first, and none of their properties is a list.
class PlyRadii {
 public:
  PlyRadii(const PlyElement& vertex, const PlyProperty& radius, Reading& reading)
      : vertex_(vertex), radius_(radius), errors_(reading) {}

  std::vector<double> from_text(LineWords& words) {
    while (needs_more()) {
      while (words.has_no_more() && !words.at_end()) words.next_line();
      if (words.at_end()) return {};
      const int line = words.line();
      for (const PlyProperty& property : vertex_.properties) {
        const std::string_view word = words.next();
        if (&property == &radius_)
          add(number_of(word).value_or(std::numeric_limits<double>::quiet_NaN()), line);
      }
      words.next_line();
    }
    return std::move(radii_);
  }

  std::vector<double> from_bytes(std::string_view bytes, PlyBody body) {
    while (needs_more())
      for (const PlyProperty& property : vertex_.properties) {
        if (bytes.size() < property.type.bytes) return {};  // check_ply() may not have looked
        if (&property == &radius_)
          add(value_of(bytes.substr(0, property.type.bytes), property.type, body), 0);
        bytes.remove_prefix(property.type.bytes);
      }
    return std::move(radii_);
  }

 private:
  bool needs_more() const { return radii_.size() < vertex_.count && !errors_.are_enough(); }

  void add(double radius, int line) {
    radii_.push_back(radius);
    if (!(radius > 0 && is_moderate(radius)))
      errors_.add(line, fmt::format("the radius of vertex {} is {}; write one of more than 0",
                                    radii_.size() - 1, radius));
  }

  const PlyElement& vertex_;
  const PlyProperty& radius_;
  LineErrors errors_;
  std::vector<double> radii_{};
};

}  // namespace

std::vector<double> read_ply_radii(std::string_view ply, Reading& reading) {
  LineWords words(ply);
  if (words.next() != "ply") return {};
  const PlyHeader header = read_ply_header(words);
  const PlyElement* const vertex = header.vertex();
  const PlyProperty* const radius = vertex ? vertex->radius() : nullptr;
  if (!header.body || !radius) return {};
  PlyRadii radii(*vertex, *radius, reading);
  return header.body == PlyBody::text ? radii.from_text(words)
                                      : radii.from_bytes(words.rest_of_text(), *header.body);
}

}  // namespace raytracer::client
