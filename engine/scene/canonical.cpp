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
  Bytes() {
    constexpr std::size_t few_objects = 1024;
    bytes_.reserve(few_objects);
  }

  template <std::integral T>
  void add(T value) {
    std::array<char, 8> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i)
      bytes[i] = static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xff);
    bytes_.append(bytes.data(), bytes.size());
  }
  template <typename T>
  requires std::is_enum_v<T>
  void add(T value) { add(static_cast<std::int64_t>(value)); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value)); }
  void add(const Vec3& v) { add_all(v.x, v.y, v.z); }
  void add(const std::array<std::uint32_t, 3>& indices) {
    add_all(indices[0], indices[1], indices[2]);
  }
  template <typename T>
  void add(const std::optional<T>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  template <typename T>
  void add(const std::vector<T>& values) {
    add_array(values);
  }
  template <typename T>
  void add(const SharedArray<T>& values) {
    add_array(values);
  }
  template <typename... T>
  void add(const std::variant<T...>& value) {
    add(value.index());
    std::visit([this](const auto& alternative) { this->add(alternative); }, value);
  }

  void add(const Material& m) {
    const auto add_effects = [&]<class... Effect>(Types<Effect...>) {
      (add_fields(static_cast<const Effect&>(m)), ...);
    };
    add_effects(MaterialEffects{});
  }
  void add(const Object& o) { add_all(o.shape, o.material); }
  void add(const Light& l) {
    add(l.source);
    add_fields(l);
  }
  template <typename Structure>
  requires requires { Structure::fields; }
  void add(const Structure& structure) { add_fields(structure); }

  template <typename... T>
  void add_all(const T&... values) {
    (add(values), ...);
  }

  template <typename Structure>
  void add_fields(const Structure& structure) {
    for_each_field(Structure::fields, [&](const auto& row) { add(structure.*row.member); });
  }

  std::string take() && { return std::move(bytes_); }

 private:
  template <typename Array>
  void add_array(const Array& values) {
    add(values.size());
    // Growing, it would be held twice.
    bytes_.reserve(bytes_.size() + values.size() * sizeof(typename Array::value_type));
    for (const auto& value : values) add(value);
  }

  std::string bytes_;
};

}  // namespace

std::string canonical_content(const Scene& s) {
  Bytes bytes;
  bytes.add_fields(s);
  bytes.add_all(s.lights, s.materials, s.objects);
  return std::move(bytes).take();
}

std::string canonical_view(const Scene& s) {
  Bytes bytes;
  RenderSettings render = s.render;
  render.samples = render.samples.value_or(1);
  bytes.add_all(s.camera, render);
  return std::move(bytes).take();
}

}  // namespace raytracer
