#include "tests/measure/peers/embree_world.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "engine/sample/pattern.h"
#include "tests/measure/peers/expanded_square.h"
#include "tests/measure/peers/eye_view.h"

namespace raytracer::peers {
namespace {

void set(float (&to)[3], const Vec3& from) {
  to[0] = static_cast<float>(from.x);
  to[1] = static_cast<float>(from.y);
  to[2] = static_cast<float>(from.z);
}

EmbreeMaterial embree_material(const Material& material) {
  EmbreeMaterial result{};
  set(result.color, material.color);
  result.ka = static_cast<float>(material.ka);
  result.kd = static_cast<float>(material.kd);
  result.ks = static_cast<float>(material.ks);
  result.shininess = static_cast<float>(material.shininess);
  result.reflectivity = static_cast<float>(material.reflectivity);
  return result;
}

/// Collects a world's geometries, in coordinates relative to the eye.
class GeometryCollector {
 public:
  GeometryCollector(RTCDevice device, const Scene& scene, EmbreeWorld& world)
      : device_(device), scene_(scene), world_(world) {}

  void collect() {
    for (const Object& object : scene_.objects) {
      material_ = object.material;
      std::visit([this](const auto& shape) { add(shape); }, object.shape);
    }
    for (const auto& [material, spheres] : spheres_of_material_) attach_spheres(material, spheres);
    for (const auto& [material, ends] : tubes_of_material_) attach_tubes(material, ends);
    world_.frame.geometry_count = static_cast<int>(world_.materials.size());
    for (const MaterialIndex material : material_of_plane_)
      world_.materials.push_back(embree_material(scene_.materials[material]));
  }

 private:
  void add(const Sphere& sphere) { add_sphere(sphere.center, sphere.radius); }
  void add(const Spheres& spheres) {
    for (std::size_t i = 0; i < spheres.centers.size(); ++i)
      add_sphere(spheres.centers[i], spheres.radius(i));
  }
  void add(const SphereSquare& square) { add(expanded(square)); }
  void add(const Cylinder& c) { add_tube(c.from, c.radius, c.to, c.radius); }
  void add(const Cylinders& c) {
    for (std::size_t i = 0; i < c.from.size(); ++i)
      add_tube(c.from[i], c.radius(i), c.to[i], c.radius(i));
  }
  void add(const Cone& c) { add_tube(c.from, c.radius_from, c.to, c.radius_to); }
  void add(const Cones& c) {
    for (std::size_t i = 0; i < c.from.size(); ++i)
      add_tube(c.from[i], c.radius_from(i), c.to[i], c.radius_to(i));
  }
  void add(const auto&) { throw std::logic_error("not a shape that the Embree peer draws"); }

  void add(const Plane& plane) {
    const Vec3 normal = unit(plane.normal);
    EmbreePlane result{};
    set(result.normal, normal);
    result.offset = static_cast<float>(dot(normal, plane.point - scene_.camera.origin));
    world_.planes.push_back(result);
    material_of_plane_.push_back(material_);
  }

  void add(const Mesh& mesh) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), mesh.vertices.size()));
    for (const Vec3& vertex : mesh.vertices) {
      const Vec3 point = vertex - scene_.camera.origin;
      *vertices++ = static_cast<float>(point.x);
      *vertices++ = static_cast<float>(point.y);
      *vertices++ = static_cast<float>(point.z);
    }
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t index : triangle) *indices++ = index;
    attach(geometry, material_);
  }

  void add_sphere(const Vec3& center, double radius) {
    append(spheres_of_material_[material_], center, radius);
  }
  void add_tube(const Vec3& from, double radius_from, const Vec3& to, double radius_to) {
    append(tubes_of_material_[material_], from, radius_from);
    append(tubes_of_material_[material_], to, radius_to);
  }

  void append(std::vector<float>& values, const Vec3& center, double radius) const {
    const Vec3 point = center - scene_.camera.origin;
    for (const double value : {point.x, point.y, point.z, radius})
      values.push_back(static_cast<float>(value));
  }

  void attach_spheres(MaterialIndex material, const std::vector<float>& spheres) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    set_points(geometry, spheres);
    attach(geometry, material);
  }

  /// Two points each, open at both ends.
  void attach_tubes(MaterialIndex material, const std::vector<float>& ends) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_CONE_LINEAR_CURVE);
    set_points(geometry, ends);
    const std::size_t count = ends.size() / 8;
    auto* indices = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, sizeof(unsigned), count));
    for (std::size_t i = 0; i < count; ++i) indices[i] = static_cast<unsigned>(2 * i);
    attach(geometry, material);
  }

  static void set_points(RTCGeometry geometry, const std::vector<float>& points) {
    auto* buffer = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT4, 4 * sizeof(float),
                                                               points.size() / 4));
    std::copy(points.begin(), points.end(), buffer);
  }

  void attach(RTCGeometry geometry, MaterialIndex material) {
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(world_.scene.get(), geometry,
                          static_cast<unsigned>(world_.materials.size()));
    rtcReleaseGeometry(geometry);
    world_.materials.push_back(embree_material(scene_.materials[material]));
  }

  RTCDevice device_;
  const Scene& scene_;
  EmbreeWorld& world_;
  MaterialIndex material_ = 0;
  std::map<MaterialIndex, std::vector<float>> spheres_of_material_;
  std::map<MaterialIndex, std::vector<float>> tubes_of_material_;
  std::vector<MaterialIndex> material_of_plane_;
};

std::vector<EmbreeLight> embree_lights(const Scene& scene) {
  std::vector<EmbreeLight> lights;
  for (const Light& light : scene.lights) {
    EmbreeLight result{};
    double emission = light.intensity;
    if (const auto* point = std::get_if<PointLight>(&light.source)) {
      result.kind = EmbreeLightKind::point;
      result.fades = point->falloff == Falloff::inverse_square;
      result.size = static_cast<float>(point->radius);
      set(result.place, point->position - scene.camera.origin);
      if (result.fades) emission /= 4 * std::numbers::pi;
    } else if (const auto* distant = std::get_if<DistantLight>(&light.source)) {
      result.size = static_cast<float>(std::tan(distant->angle / 2));
      set(result.place, -unit(distant->direction));
    } else {
      result.kind = EmbreeLightKind::sky;
    }
    set(result.intensity, light.color * emission);
    lights.push_back(result);
  }
  return lights;
}

void set_samples(EmbreeWorld& world, std::vector<float> x, std::vector<float> y) {
  world.sample_x = std::move(x);
  world.sample_y = std::move(y);
  world.frame.sample_x = world.sample_x.data();
  world.frame.sample_y = world.sample_y.data();
  world.frame.sample_count = static_cast<int>(world.sample_x.size());
}

/// Evenly, `count` on the disc and twice as many on the sphere, of which half are above a surface.
void set_shared_places(EmbreeWorld& world, int count) {
  const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double radius = std::sqrt((i + 0.5) / count);
    world.disc_x.push_back(static_cast<float>(radius * std::cos(i * turn)));
    world.disc_y.push_back(static_cast<float>(radius * std::sin(i * turn)));
  }
  for (int i = 0; i < 2 * count; ++i) {
    const double height = 1 - (i + 0.5) / count;
    const double radius = std::sqrt(1 - height * height);
    world.sphere_x.push_back(static_cast<float>(radius * std::cos(i * turn)));
    world.sphere_y.push_back(static_cast<float>(height));
    world.sphere_z.push_back(static_cast<float>(radius * std::sin(i * turn)));
  }
  world.frame.places = {
      world.disc_x.data(),   world.disc_y.data(),   count,     world.sphere_x.data(),
      world.sphere_y.data(), world.sphere_z.data(), 2 * count, 0};
}

}  // namespace

std::unique_ptr<EmbreeWorld> make_embree_world(RTCDevice device, const Scene& scene) {
  auto world = std::make_unique<EmbreeWorld>();
  world->scene.reset(rtcNewScene(device));
  rtcSetSceneBuildQuality(world->scene.get(), RTC_BUILD_QUALITY_MEDIUM);
  rtcSetSceneFlags(world->scene.get(), RTC_SCENE_FLAG_NONE);
  GeometryCollector(device, scene, *world).collect();
  world->lights = embree_lights(scene);
  std::vector<float> sample_x;
  std::vector<float> sample_y;
  for (const SamplePoint& sample : sample_pattern(scene.render.samples.value_or(1)).points) {
    sample_x.push_back(static_cast<float>(sample.x));
    sample_y.push_back(static_cast<float>(sample.y));
  }
  set_samples(*world, std::move(sample_x), std::move(sample_y));
  constexpr int least_places = 64;  // for a pixel, as documents are promised
  const int samples = world->frame.sample_count;
  set_shared_places(*world, (least_places + samples - 1) / samples);

  EmbreeFrame& frame = world->frame;
  const EyeView view = make_eye_view(scene.camera);
  frame.scene = world->scene.get();
  set(frame.forward, view.forward);
  set(frame.right, view.right);
  set(frame.up, view.up);
  frame.width = scene.camera.width;
  frame.height = scene.camera.height;
  set(frame.background, scene.background.value_or(Rgb{}));
  frame.ambient = static_cast<float>(scene.ambient);
  frame.is_ambient_everywhere = scene.shadows != Shadows::black;
  frame.has_shadows = scene.shadows != Shadows::off;
  frame.max_depth = scene.render.max_depth;
  frame.lights = world->lights.data();
  frame.light_count = static_cast<int>(world->lights.size());
  frame.materials = world->materials.data();
  frame.planes = world->planes.data();
  frame.plane_count = static_cast<int>(world->planes.size());
  return world;
}

void set_random_places(EmbreeWorld& world, int side) { world.frame.places.random_side = side; }

void set_sample_grid(EmbreeWorld& world, int side) {
  std::vector<float> x;
  std::vector<float> y;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      x.push_back((static_cast<float>(column) + 0.5F) / static_cast<float>(side));
      y.push_back((static_cast<float>(row) + 0.5F) / static_cast<float>(side));
    }
  }
  set_samples(world, std::move(x), std::move(y));
}

}  // namespace raytracer::peers
