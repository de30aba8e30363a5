#include "client/formats/scene_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <string_view>

namespace raytracer::client::model {
namespace {

/// Appends JSON to a text; places turn from the file's coordinates into the scene's.
class DocumentWriter {
 public:
  std::string text() const { return fmt::to_string(text_); }

  void scene(const Scene& scene) {
    print("{{\n  \"camera\": ");
    view(scene.view);
    print(",\n  \"background\": ");
    numbers(scene.background);
    print(",\n  \"ambient\": {},\n  \"lights\": [", scene.ambient);
    lines(scene.lights, [this](const Lamp& one) { light(one); });
    print("],\n  \"materials\": {{");
    std::size_t index = 0;
    lines(scene.materials, [&](const Material& one) {
      print("\"fill{}\": ", ++index);
      material(one);
    });
    print("}},\n  \"objects\": [");
    lines(scene.objects, [this](const Objects& all) { objects(all); });
    print("]\n}}\n");
  }

 private:
  template <typename... Values>
  void print(fmt::format_string<const Values&...> format, const Values&... values) {
    fmt::format_to(std::back_inserter(text_), format, values...);
  }

  void numbers(const Triple& all) { print("[{}, {}, {}]", all[0], all[1], all[2]); }

  /// A point or a direction. Not -x: that makes -0 of 0.
  void place(const Triple& all) { print("[{}, {}, {}]", 0 - all[0], all[1], all[2]); }

  template <typename Items, typename Write>
  void lines(const Items& items, Write write) {
    std::string_view separator = "\n    ";
    for (const auto& item : items) {
      print("{}", separator);
      write(item);
      separator = ",\n    ";
    }
  }

  template <typename Items, typename Write>
  void list(std::string_view name, const Items& items, Write write) {
    print(", \"{}\": [", name);
    lines(items, write);
    print("]");
  }

  /// Of a single item, which has a name of its own, no list.
  void places(std::string_view name, std::string_view name_of_one, const std::vector<Triple>& all) {
    if (all.size() > 1) return list(name, all, [this](const Triple& one) { place(one); });
    print(", \"{}\": ", name_of_one);
    place(all.front());
  }

  /// Of equal ones no list.
  void radii(std::string_view name, const std::vector<double>& all) {
    if (std::adjacent_find(all.begin(), all.end(), std::not_equal_to<>()) == all.end())
      return print(", \"{}\": {}", name, all.front());
    list(name, all, [this](double one) { print("{}", one); });
  }

  void view(const View& view) {
    print("{{\"origin\": ");
    place(view.from);
    print(", \"look_at\": ");
    place(view.at);
    print(", \"up\": ");
    place(view.up);
    print(", \"fov\": {}, \"width\": {}, \"height\": {}}}", view.fov, view.width_px,
          view.height_px);
  }

  void light(const Lamp& lamp) {
    print("{{\"type\": \"point\", \"position\": ");
    place(lamp.position);
    print(", \"color\": ");
    numbers(lamp.color);
    print(", \"intensity\": {}, \"falloff\": \"none\"}}", lamp.intensity);
  }

  void material(const Material& material) {
    print("{{\"color\": ");
    numbers(material.color);
    print(", \"kd\": {}, \"ks\": {}, \"shininess\": {}, \"reflectivity\": {}", material.kd,
          material.ks, material.shininess, material.reflectivity);
    if (material.transparency > 0)
      print(", \"transparency\": {}, \"ior\": {}", material.transparency, material.ior);
    print("}}");
  }

  void objects(const Objects& objects) {
    std::visit([this](const auto& all) { shape(all); }, objects.shape);
    if (objects.material) print(", \"material\": \"fill{}\"", *objects.material + 1);
    print("}}");
  }

  void type(std::string_view name, std::size_t count) {
    print("{{\"type\": \"{}{}\"", name, count == 1 ? "" : "s");
  }

  void shape(const Spheres& spheres) {
    type("sphere", spheres.centers.size());
    places("centers", "center", spheres.centers);
    radii("radius", spheres.radii);
  }

  void shape(const Cylinders& cylinders) {
    type("cylinder", cylinders.from.size());
    places("from", "from", cylinders.from);
    places("to", "to", cylinders.to);
    radii("radius", cylinders.radii);
    print(", \"caps\": false");
  }

  void shape(const Cones& cones) {
    type("cone", cones.from.size());
    places("from", "from", cones.from);
    places("to", "to", cones.to);
    radii("radius_from", cones.radii_from);
    radii("radius_to", cones.radii_to);
    print(", \"caps\": false");
  }

  void shape(const Mesh& mesh) {
    const auto write_place = [this](const Triple& one) { place(one); };
    print("{{\"type\": \"mesh\"");
    list("vertices", mesh.vertices, write_place);
    if (!mesh.normals.empty()) list("normals", mesh.normals, write_place);
    list("triangles", mesh.triangles, [this](const std::array<std::uint32_t, 3>& corners) {
      print("[{}, {}, {}]", corners[0], corners[2], corners[1]);
    });
  }

  fmt::memory_buffer text_;
};

}  // namespace

std::string to_document(const Scene& scene) {
  DocumentWriter writer;
  writer.scene(scene);
  return writer.text();
}

}  // namespace raytracer::client::model
