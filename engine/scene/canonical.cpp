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

  void add(const Camera& c) { add_all(c.origin, c.look_at, c.up, c.fov, c.width, c.height); }
  void add(const Material& m) { add_all(m.color, m.ka, m.kd, m.ks, m.shininess, m.reflectivity); }
  void add(const Sphere& s) { add_all(s.center, s.radius); }
  void add(const Spheres& s) { add_all(s.centers, s.radii); }
  void add(const SphereSquare& s) { add_all(s.center, s.radius, s.n, s.axes); }
  void add(const Plane& p) { add_all(p.point, p.normal); }
  void add(const Mesh& m) { add_all(m.vertices, m.triangles); }
  void add(const Object& o) { add_all(o.shape, o.material); }
  void add(const DistantLight& l) { add(l.direction); }
  void add(const PointLight& l) { add(l.position); }
  void add(const Light& l) { add_all(l.source, l.color, l.intensity); }
  void add(const RenderSettings& r) {
    add_all(r.samples.value_or(1), r.target_rmse, r.budget_ms, r.precision, r.max_depth,
            r.transfer);
  }

  template <typename... T>
  void add_all(const T&... values) {
    (add(values), ...);
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
  bytes.add_all(s.background, s.ambient, s.shadows, s.lights, s.materials, s.objects);
  return std::move(bytes).take();
}

std::string canonical_view(const Scene& s) {
  Bytes bytes;
  bytes.add_all(s.camera, s.render);
  return std::move(bytes).take();
}

}  // namespace raytracer
