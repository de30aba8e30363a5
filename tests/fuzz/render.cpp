// Any bytes as the numbers of a valid scene: its tiny picture has values from 0 to 1, none of
// them clamped from what is no number, in single and in double.
//
// Limits: squares of at most 200 x 200 spheres, so that a ray along them ends in time.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "engine/engine.h"
#include "tests/support/edit.h"

namespace raytracer {
namespace {

/// Takes the scene's numbers from the bytes; zeros after their end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool is_empty() const { return left_ == 0; }

  std::uint8_t byte() {
    if (left_ == 0) return 0;
    --left_;
    return *data_++;
  }

  int below(int count) { return byte() % count; }

  /// One of few round numbers, a power of ten, or any finite double.
  double number() {
    const int kind = below(4);
    const auto small = static_cast<std::int8_t>(byte());
    if (kind < 2) return small / 8.0;
    if (kind == 2) return (byte() % 2 == 0 ? 1 : -1) * std::pow(10, 2.4 * small);
    std::uint64_t bits = 0;
    for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
    double value = 0;
    std::memcpy(&value, &bits, sizeof(value));
    return std::isfinite(value) ? value : 1;
  }

  double positive() {
    const double value = std::abs(number());
    return value > 0 ? value : 1;
  }
  /// 0 to 1.
  double share() { return byte() / 255.0; }

  Vec3 point() {
    const double x = number();
    const double y = number();
    return {x, y, number()};
  }
  Vec3 direction() {
    const Vec3 value = point();
    return value == Vec3{} ? Vec3{0, -1, 0} : value;
  }

 private:
  const std::uint8_t* data_;
  std::size_t left_;
};

/// That differ.
std::pair<Vec3, Vec3> two_points(Bytes& bytes) {
  const Vec3 from = bytes.point();
  const Vec3 to = bytes.point();
  if (to == from) return {Vec3{}, {0, 1, 0}};
  return {from, to};
}

void add_object(Bytes& bytes, Scene& scene) {
  Object object;
  switch (bytes.below(8)) {
    case 0:
      object.shape = Sphere{bytes.point(), bytes.positive()};
      break;
    case 1: {
      Spheres set{{}, {bytes.positive()}, {}};
      for (int i = bytes.below(40); i >= 0; --i) set.centers.push_back(bytes.point());
      object.shape = std::move(set);
      break;
    }
    case 2:
      object.shape = SphereSquare{bytes.point(), bytes.positive(), 1 + bytes.below(100),
                                  static_cast<Axes>(bytes.below(3))};
      break;
    case 3:
      object.shape = Plane{bytes.point(), bytes.direction()};
      break;
    case 4: {
      const auto [from, to] = two_points(bytes);
      object.shape = Cylinder{from, to, bytes.positive(), bytes.below(2) == 0};
      break;
    }
    case 5: {
      const auto [from, to] = two_points(bytes);
      const double radius = bytes.positive();
      const bool is_pointed = bytes.below(2) == 0;
      object.shape = Cone{from, to, radius, is_pointed ? 0 : bytes.positive(), bytes.below(2) == 0};
      break;
    }
    case 6: {
      Cylinders set{{}, {}, {bytes.positive()}, bytes.below(2) == 0, {}};
      for (int i = bytes.below(40); i >= 0; --i) {
        const auto [from, to] = two_points(bytes);
        set.from.push_back(from);
        set.to.push_back(to);
      }
      object.shape = std::move(set);
      break;
    }
    default: {
      Mesh mesh;
      for (int i = 0; i < 5; ++i) mesh.vertices.push_back(bytes.point());
      mesh.triangles = {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}};
      object.shape = std::move(mesh);
    }
  }
  object.material = static_cast<MaterialIndex>(bytes.below(2));
  test::append(scene.objects, std::move(object));
}

Scene make_scene(Bytes& bytes) {
  Scene scene;
  scene.camera.origin = bytes.point();
  scene.camera.look_at = bytes.point();
  if (scene.camera.look_at == scene.camera.origin)
    scene.camera.look_at.z = scene.camera.origin.z + 1;
  if (scene.camera.look_at == scene.camera.origin) scene.camera = {.look_at = {0, 0, 1}};
  scene.camera.up = bytes.direction();
  scene.camera.fov = 1e-3 + 3.14 * bytes.share();
  scene.camera.width = 9;
  scene.camera.height = 7;
  scene.ambient = bytes.share();
  scene.shadows = static_cast<Shadows>(bytes.below(3));
  for (int i = 0; i < 2; ++i) {
    Material material;
    material.color = {bytes.share(), 1, 0.5};
    material.ks = bytes.share();
    material.shininess = std::abs(bytes.number());
    material.reflectivity = i * bytes.share();
    test::append(scene.materials, material);
  }
  scene.render.max_depth = bytes.below(6);
  for (int i = bytes.below(3); i >= 0; --i) {
    const double intensity = std::abs(bytes.number());
    if (bytes.below(2) == 0)
      test::append(scene.lights, {DistantLight{bytes.direction()}, {1, 1, 1}, intensity});
    else
      test::append(scene.lights, {PointLight{bytes.point()}, {1, 0, 1}, intensity});
  }
  while (!bytes.is_empty() && scene.objects.size() < 12) add_object(bytes, scene);
  return scene;
}

void expect_picture(Scene scene, Precision precision) {
  static WorkerPool pool(1);  // for all pictures: threads are slow to start
  scene.render.precision = precision;
  RenderProgress progress;
  const Rendering rendering = render(scene, {}, pool, progress);
  if (rendering.beyond.not_numbers > 0) std::abort();
  for (const float value : rendering.image.values)
    if (!(value >= 0 && value <= 1)) std::abort();
}

}  // namespace
}  // namespace raytracer

// The name is libFuzzer's.
// NOLINTNEXTLINE(readability-identifier-naming)
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace raytracer;
  Bytes bytes(data, size);
  const Scene scene = make_scene(bytes);
  expect_picture(scene, Precision::single_precision);
  expect_picture(scene, Precision::double_precision);
  return 0;
}
