#include "engine/scene/canonical.h"

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>

namespace raytracer {
namespace {

/// Appends values as bytes, least significant first, so that all machines agree.
class Bytes {
 public:
  template <typename... T>
  void add(const T&... values) {
    (append(values), ...);
  }

  template <typename Structure>
  void add_fields(const Structure& structure) {
    for_each_field(Structure::fields, [&](const auto& row) { append(structure.*row.member); });
  }

  std::string take() && { return std::move(bytes_); }

 private:
  template <std::integral T>
  void append(T value) {
    std::array<char, 8> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xff);
    bytes_.append(bytes.data(), bytes.size());
  }
  template <typename T>
  requires std::is_enum_v<T>
  void append(T value) { append(static_cast<std::int64_t>(value)); }
  void append(double value) { append(std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value)); }
  void append(const Vec3& v) { add(v.x, v.y, v.z); }
  void append(const std::array<std::uint32_t, 3>& indices) {
    add(indices[0], indices[1], indices[2]);
  }
  void append(const Object& o) { add(o.shape, o.material); }
  void append(const Light& l) {
    append(l.source);
    add_fields(l);
  }
  template <typename T>
  void append(const std::optional<T>& value) {
    append(value.has_value());
    if (value) append(*value);
  }
  template <typename... T>
  void append(const std::variant<T...>& value) {
    append(value.index());
    std::visit([this](const auto& alternative) { this->append(alternative); }, value);
  }
  template <typename Structure>
  requires requires { Structure::fields; }
  void append(const Structure& structure) { add_fields(structure); }
  template <typename Array>
  requires requires(Array array) { array.begin(); }
  void append(const Array& values) {
    append(values.size());
    // Growing, it would be held twice.
    bytes_.reserve(bytes_.size() + values.size() * sizeof(typename Array::value_type));
    for (const auto& value : values) append(value);
  }

  std::string bytes_;
};

}  // namespace

std::string canonical_content(const Scene& s) {
  Bytes bytes;
  bytes.add_fields(s);
  bytes.add(s.lights, s.materials, s.objects);
  return std::move(bytes).take();
}

std::string canonical_view(const Scene& s) {
  Bytes bytes;
  RenderSettings render = s.render;
  render.samples = render.samples.value_or(1);
  bytes.add(s.camera, render);
  return std::move(bytes).take();
}

}  // namespace raytracer
