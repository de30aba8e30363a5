#include "tests/measure/peers/embree_world.h"

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
    const Vec3 point = center - scene_.camera.origin;
    std::vector<float>& spheres = spheres_of_material_[material_];
    for (const double value : {point.x, point.y, point.z, radius})
      spheres.push_back(static_cast<float>(value));
  }

  void attach_spheres(MaterialIndex material, const std::vector<float>& spheres) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* buffer = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT4, 4 * sizeof(float),
                                                               spheres.size() / 4));
    std::copy(spheres.begin(), spheres.end(), buffer);
    attach(geometry, material);
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
  std::vector<MaterialIndex> material_of_plane_;
};

std::vector<EmbreeLight> embree_lights(const Scene& scene) {
  std::vector<EmbreeLight> lights;
  for (const Light& light : scene.lights) {
    EmbreeLight result{};
    if (const auto* point = std::get_if<PointLight>(&light.source)) {
      result.is_point = true;
      set(result.place, point->position - scene.camera.origin);
      set(result.intensity, light.color * (light.intensity / (4 * std::numbers::pi)));
    } else {
      set(result.place, -unit(std::get<DistantLight>(light.source).direction));
      set(result.intensity, light.color * light.intensity);
    }
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
