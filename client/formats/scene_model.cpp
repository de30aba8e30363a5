#include "client/formats/scene_model.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include "client/formats/threads.h"

namespace raytracer::client::model {
namespace {

/// Appends JSON to a text; places turn from the file's coordinates into the scene's.
class DocumentWriter {
 public:
  std::string take() && { return std::move(text_); }

  void scene(const Scene& scene) {
    print("{{\n  \"camera\": ");
    view(scene.view);
    print(",\n  \"background\": ");
    if (scene.background)
      numbers(*scene.background);
    else
      print("\"transparent\"");
    print(",\n  \"ambient\": {},", scene.ambient);
    if (!scene.is_shadow_black) print("\n  \"shadows\": \"ambient\",");
    print("\n  \"lights\": [");
    lines(scene.lights, [this](const Light& one) {
      std::visit([this](const auto& known) { light(known); }, one);
    });
    print("],\n  \"materials\": {{");
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
      const std::string& name = scene.materials[i].name;
      names_.push_back(name.empty() ? fmt::format("fill{}", i + 1) : name);
    }
    auto name = names_.begin();
    lines(scene.materials, [&](const Material& one) {
      print("\"{}\": ", *name++);
      material(one);
    });
    print("}},\n  \"objects\": [");
    lines(scene.objects, [this](const Objects& all) { objects(all); });
    print("]");
    if (scene.samples > 0)
      print(",\n  \"render\": {{\"samples\": {}, \"transfer\": \"{}\"}}", scene.samples,
            scene.is_srgb ? "srgb" : "linear");
    print("\n}}\n");
  }

 private:
  template <typename... Values>
  void print(fmt::format_string<const Values&...> format, const Values&... values) {
    fmt::format_to(std::back_inserter(text_), format, values...);
  }

  /// Large scenes are made of these, so that no format is read for each.
  void number(double value) {
    std::array<char, 32> room{};
    text_.append(room.data(), fmt::format_to(room.data(), FMT_COMPILE("{}"), value));
  }

  void numbers(const Triple& all) {
    text_ += '[';
    number(all[0]);
    text_ += ", ";
    number(all[1]);
    text_ += ", ";
    number(all[2]);
    text_ += ']';
  }

  /// A point or a direction. Not -x: that makes -0 of 0.
  void place(const Triple& all) { numbers({0 - all[0], all[1], all[2]}); }
  static void write_place(DocumentWriter& to, const Triple& all) { to.place(all); }

  template <typename Items, typename Write>
  void lines(const Items& items, Write write) {
    list_piece(
        std::span(items), [&](DocumentWriter&, const auto& one) { write(one); }, true);
  }

  /// Of numbers, for which there is a write(writer, item): long ones by several threads.
  template <typename Item, typename Write>
  void list(std::string_view name, const std::vector<Item>& items, Write write) {
    constexpr std::size_t in_piece = 1 << 15;
    print(", \"{}\": [", name);
    const std::span<const Item> all = items;
    if (all.size() <= in_piece) {
      list_piece(all, write, true);
      return print("]");
    }
    std::vector<DocumentWriter> pieces(
        std::min(useful_threads(), (items.size() + in_piece - 1) / in_piece));
    for (std::size_t begin = 0; begin < items.size(); begin += pieces.size() * in_piece) {
      in_threads(pieces.size(), [&](std::size_t i) {
        const std::size_t first = std::min(begin + i * in_piece, items.size());
        pieces[i].text_.clear();
        pieces[i].list_piece(all.subspan(first, std::min(in_piece, items.size() - first)), write,
                             first == 0);
      });
      if (begin == 0 && items.size() > pieces.size() * in_piece)  // about as long as the others
        text_.reserve(text_.size() + (items.size() / in_piece + 2) * pieces.front().text_.size());
      for (const DocumentWriter& piece : pieces) text_ += piece.text_;
    }
    print("]");
  }

  template <typename Item, typename Write>
  void list_piece(std::span<const Item> items, Write write, bool is_first) {
    for (const Item& item : items) {
      text_ += is_first ? "\n    " : ",\n    ";
      write(*this, item);
      is_first = false;
    }
  }

  /// Of one item, which has a name of its own, no list.
  void places(std::string_view name, std::string_view name_of_one, const std::vector<Triple>& all,
              bool is_one) {
    if (!is_one) return list(name, all, write_place);
    print(", \"{}\": ", name_of_one);
    place(all.front());
  }

  void colors(const std::vector<Rgb>& all) {
    if (all.empty()) return;
    list("colors", all, [](DocumentWriter& to, const Rgb& one) {
      to.text_ += '[';
      to.share(one[0]);
      to.text_ += ", ";
      to.share(one[1]);
      to.text_ += ", ";
      to.share(one[2]);
      to.text_ += ']';
    });
  }

  /// A number in [0, 1] in thousandths, of which an eye sees none.
  void share(float value) {
    const int thousandths = static_cast<int>(std::lround(std::clamp(value, 0.0F, 1.0F) * 1000));
    if (thousandths % 1000 == 0)
      print("{}", thousandths / 1000);
    else
      print("0.{:03d}", thousandths);
  }

  /// Of equal ones no list.
  void radii(std::string_view name, const std::vector<double>& all) {
    if (std::adjacent_find(all.begin(), all.end(), std::not_equal_to<>()) == all.end())
      return print(", \"{}\": {}", name, all.front());
    list(name, all, [](DocumentWriter& to, double one) { to.number(one); });
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
    print(", \"intensity\": {}, \"falloff\": \"{}\"}}", lamp.intensity,
          lamp.falls_off ? "inverse_square" : "none");
  }

  void light(const Sun& sun) {
    print("{{\"type\": \"distant\", \"direction\": ");
    place(sun.direction);
    print(", \"color\": ");
    numbers(sun.color);
    print(", \"intensity\": {}}}", sun.intensity);
  }

  void light(const Sky& sky) {
    print("{{\"type\": \"sky\", \"color\": ");
    numbers(sky.color);
    print(", \"intensity\": {}}}", sky.intensity);
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
    if (objects.material) print(", \"material\": \"{}\"", names_[*objects.material]);
    print("}}");
  }

  void type(std::string_view name, bool is_one) {
    print("{{\"type\": \"{}{}\"", name, is_one ? "" : "s");
  }

  void shape(const Spheres& spheres) {
    const bool is_one = spheres.centers.size() == 1 && spheres.colors.empty();
    type("sphere", is_one);
    places("centers", "center", spheres.centers, is_one);
    radii("radius", spheres.radii);
    colors(spheres.colors);
  }

  void shape(const Cylinders& cylinders) {
    const bool is_one = cylinders.from.size() == 1 && cylinders.colors.empty();
    type("cylinder", is_one);
    places("from", "from", cylinders.from, is_one);
    places("to", "to", cylinders.to, is_one);
    radii("radius", cylinders.radii);
    colors(cylinders.colors);
    print(", \"caps\": false");
  }

  void shape(const Cones& cones) {
    const bool is_one = cones.from.size() == 1;
    type("cone", is_one);
    places("from", "from", cones.from, is_one);
    places("to", "to", cones.to, is_one);
    radii("radius_from", cones.radii_from);
    radii("radius_to", cones.radii_to);
    print(", \"caps\": false");
  }

  void shape(const Mesh& mesh) {
    print("{{\"type\": \"mesh\"");
    list("vertices", mesh.vertices, write_place);
    if (!mesh.normals.empty()) list("normals", mesh.normals, write_place);
    colors(mesh.colors);
    list("triangles", mesh.triangles,
         [](DocumentWriter& to, const std::array<std::uint32_t, 3>& corners) {
           to.print("[{}, {}, {}]", corners[0], corners[2], corners[1]);
         });
  }

  std::string text_;
  std::vector<std::string> names_;  ///< of the materials
};

}  // namespace

std::string to_document(const Scene& scene) {
  DocumentWriter writer;
  writer.scene(scene);
  return std::move(writer).take();
}

}  // namespace raytracer::client::model
