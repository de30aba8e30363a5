// The numbers of a PLY as bytes.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "client/failure.h"
#include "client/formats/meshes/line_errors.h"
#include "client/formats/meshes/ply_bodies.h"

namespace raytracer::client {
namespace {

class PlyBytesCheck {
 public:
  PlyBytesCheck(PlyBody body, std::string_view bytes, Reading& reading)
      : body_(body), bytes_(bytes), reading_(reading) {}

  void check(const PlyElement& element) {
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties)
        if (!take(element, property))
          throw InputError(
              fmt::format("the file ends after {} of {} {}", i, element.count, plural_of(element)));
      if (element.properties.empty()) return;
    }
  }

 private:
  bool take(std::size_t count, std::size_t bytes) {
    if (count > bytes_.size() / bytes) return false;
    bytes_.remove_prefix(count * bytes);
    return true;
  }

  bool take(const PlyElement& element, const PlyProperty& property) {
    if (!property.count) return take(1, property.type.bytes);
    const std::string_view before = bytes_;
    if (!take(1, property.count->bytes)) return false;
    const std::size_t count = ply_integer(before.substr(0, property.count->bytes), body_);
    if (names_vertices(element, property)) {
      if (count == 0) throw InputError("a face without corners cannot be read: leave it out");
      if (count < 3) omit_face_of_few_corners(reading_, 0);
    }
    return take(count, property.type.bytes);
  }

  PlyBody body_;
  std::string_view bytes_;
  Reading& reading_;
};

}  // namespace

std::uint64_t ply_integer(std::string_view bytes, PlyBody body) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::size_t place = body == PlyBody::little_endian ? i : bytes.size() - 1 - i;
    value |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * place);
  }
  return value;
}

void check_ply_bytes(const PlyHeader& header, std::string_view bytes, Reading& reading) {
  for (const PlyElement& element : header.elements)
    for (const PlyProperty& property : element.properties)
      if (property.count && !property.count->is_integer) return;  // nothing counts like that
  PlyBytesCheck check(*header.body, bytes, reading);
  for (const PlyElement& element : header.elements) check.check(element);
}

}  // namespace raytracer::client
