// Every kernel on every instruction set of this machine draws what the reference draws.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "engine/image/encode.h"
#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "engine/render/tracer.h"
#include "tests/support/reference_plan.h"
#include "tests/support/scene_plan.h"
#include "tests/variants/compare.h"
#include "tests/variants/image_by.h"
#include "tests/variants/random_documents.h"
#include "tests/variants/scenes.h"

namespace raytracer::test {
namespace {

TEST(Variants, double_is_the_reference_on_every_instruction_set) {
  for (const NamedScene& named : scenes()) {
    const Image expected = reference_image(named.scene);
    for (const InstructionSet& set : supported_instruction_sets())
      EXPECT_EQ(count_wrong(image_on(set, Precision::double_precision, named.scene), expected), 0)
          << named.name << " on " << set.name;
  }
}

/// In how many scenes the plan chooses it.
int expect_near_the_reference_where_chosen(Precision precision) {
  int chosen = 0;
  for (const NamedScene& named : scenes()) {
    const Plan plan = make_plan(named.scene, this_machine());
    if (plan.precision.value != precision) continue;
    ++chosen;
    const Image expected = reference_image(named.scene);
    const int most = std::max(2, static_cast<int>(expected.values.size() / 3 / 2000));
    for (const InstructionSet& set : supported_instruction_sets()) {
      Plan on_set = plan;
      on_set.instruction_set = set;
      EXPECT_LE(count_wrong(image_by(on_set, named.scene), expected), most)
          << named.name << " on " << set.name << ": " << plan.precision.reason();
    }
  }
  return chosen;
}

TEST(Variants, single_is_near_the_reference_where_the_plan_chooses_it) {
  EXPECT_GE(expect_near_the_reference_where_chosen(Precision::single_precision), 8)
      << "single precision is hardly ever chosen";
}

TEST(Variants, mixed_is_near_the_reference_where_the_plan_chooses_it) {
  EXPECT_GE(expect_near_the_reference_where_chosen(Precision::mixed), 4);
}

/// Which packets multiply by their bits, each lane by its own.
TEST(Variants, integer_exponents_of_every_bit_are_the_references) {
  std::string materials;
  std::string objects;
  const std::vector<int> exponents{0, 1, 2, 3, 5, 8, 16, 96, 384, 1023, 4095, 4096};
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    const std::string comma = i == 0 ? "" : ", ";
    materials += fmt::format(R"({}"{}": {{"ks": 1, "shininess": {}}})", comma, i, exponents[i]);
    objects += fmt::format(
        R"({}{{"type": "sphere", "center": [{}, {}, 0], "radius": 0.4, "material": "{}"}})", comma,
        0.5 * static_cast<double>(i % 4) - 0.75, 0.5 * static_cast<double>(i / 4) - 0.5, i);
  }
  const Scene scene = prepared(fmt::format(
      R"({{"camera": {{"origin": [0.2, 0.3, -5], "look_at": [0, 0, 0], "fov": 0.4, "width": 160,
                      "height": 120}},
          "lights": [{{"type": "distant", "direction": [0.1, -0.2, 1]}}],
          "materials": {{{}}}, "objects": [{}]}})",
      materials, objects));
  EXPECT_EQ(find_features(scene).integer_shininess, (IntegerExponents{true, 8191, 0}));
  const Image expected = reference_image(scene);
  for (const InstructionSet& set : supported_instruction_sets())
    for (const auto& [precision, most] :
         {std::pair{Precision::double_precision, 0}, {Precision::single_precision, 2}})
      EXPECT_LE(count_wrong(image_on(set, precision, scene), expected), most) << set.name;
}

/// Many of a kind, close to each other, after some reflections or refractions of which nothing is
/// left of what single carries. object(place) is the JSON of the one that is there.
template <class Object>
Scene close_together(const std::string& material, const Object& object) {
  std::string objects;
  for (int i = 0; i < 48; ++i) {
    const int x = i % 4;
    const int y = i / 4 % 3;
    const int z = i / 12;
    // Turned a little: straight rows would send rays back the way they came.
    const Vec3 place{1.1 * x - 1.7 + 0.1 * z, 1.1 * y - 1.1 + 0.1 * x, 1.1 * z - 1.4 + 0.1 * y};
    objects += (i == 0 ? "" : ", ") + object(place);
  }
  return prepared(fmt::format(
      R"({{"camera": {{"origin": [3, 3.5, -7], "look_at": [0, 0, 0], "fov": 0.6, "width": 160,
                      "height": 120}},
          "lights": [{{"type": "distant", "direction": [-1, -2, 1.5]}}],
          "background": [0.2, 0.4, 0.9], "render": {{"max_depth": 24}},
          "materials": {{"m": {{"color": [0.7, 0.5, 0.3], {}}}}}, "objects": [{}]}})",
      material, objects));
}

/// Of things close together, each of which magnifies what is seen in it or through it.
struct MagnifyingScene {
  std::string name;
  bool is_mirroring;
  Scene scene;
};

std::vector<MagnifyingScene> magnifying_scenes() {
  const std::string mirror = R"("kd": 0.5, "reflectivity": 0.95)";
  const std::string glass = R"("kd": 0.5, "transparency": 0.98, "ior": 1.52)";
  const std::string dense = R"("kd": 0.5, "transparency": 0.98, "ior": 2)";
  const auto solid = [](const char* type, const char* sizes) {
    return [=](const Vec3& at) {
      return fmt::format(
          R"({{"type": "{}", "from": [{}, -0.6, {}], "to": [{}, {}, {}], {}, "material": "m"}})",
          type, at.x, at.z, at.x + 0.1, at.y + 0.7, at.z - 0.05, sizes);
    };
  };
  const auto ball = [](const Vec3& at) {
    return fmt::format(
        R"({{"type": "sphere", "center": [{}, {}, {}], "radius": 0.5, "material": "m"}})", at.x,
        at.y, at.z);
  };
  const auto square = [](const Vec3& at) {
    return fmt::format(
        R"({{"type": "sphere_square", "center": [{}, {}, {}], "radius": 0.25, "n": 1,
             "material": "m"}})",
        at.x, at.y, at.z);
  };
  const auto smooth = [](const Vec3& at) {  // an octahedron, as round as normals make it
    return fmt::format(
        R"({{"type": "mesh", "material": "m",
             "vertices": [[{0}, {3}, {2}], [{0}, {4}, {2}], [{5}, {1}, {2}], [{6}, {1}, {2}],
                          [{0}, {1}, {7}], [{0}, {1}, {8}]],
             "normals": [[0, 1, 0], [0, -1, 0], [1, 0, 0], [-1, 0, 0], [0, 0, 1], [0, 0, -1]],
             "triangles": [[0, 4, 2], [0, 2, 5], [0, 5, 3], [0, 3, 4],
                           [1, 2, 4], [1, 5, 2], [1, 3, 5], [1, 4, 3]]}})",
        at.x, at.y, at.z, at.y + 0.5, at.y - 0.5, at.x + 0.5, at.x - 0.5, at.z + 0.5, at.z - 0.5);
  };
  // Squares of glass, mirrors and neither in a ball of glass.
  const auto squares_in_a_ball = [&] {
    std::string objects =
        R"({"type": "sphere", "center": [0, 0, 0], "radius": 2.4, "material": {)" + glass + "}}";
    for (const auto& [height, material] :
         {std::pair("0.3", glass), {"-0.5", mirror}, {"0.9", R"("kd": 0.7)"}})
      objects += fmt::format(
          R"(, {{"type": "sphere_square", "center": [0, {}, 0], "radius": 0.25, "n": 2, "axes": "xz",
               "material": {{{}}}}})",
          height, material);
    return prepared(fmt::format(
        R"({{"camera": {{"origin": [3, 3.5, -7], "look_at": [0, 0, 0], "fov": 0.6, "width": 160,
                        "height": 120}},
            "lights": [{{"type": "distant", "direction": [-1, -2, 1.5]}}],
            "background": [0.2, 0.4, 0.9], "render": {{"max_depth": 12}}, "objects": [{}]}})",
        objects));
  };
  const char* const closed = R"("radius": 0.5)";
  const char* const open = R"("radius": 0.5, "caps": false)";
  const char* const narrowing = R"("radius_from": 0.6, "radius_to": 0.2)";
  const char* const wide_open = R"("radius_from": 0.2, "radius_to": 0.6, "caps": false)";
  return {{"mirroring spheres", true, close_together(mirror, ball)},
          {"glass spheres", false, close_together(glass, ball)},
          {"dense spheres", false, close_together(dense, ball)},
          {"dense cylinders", false, close_together(dense, solid("cylinder", closed))},
          {"dense cones", false, close_together(dense, solid("cone", narrowing))},
          {"dense smooth triangles", false, close_together(dense, smooth)},
          {"mirroring squares of spheres", true, close_together(mirror, square)},
          {"glass squares of spheres", false, close_together(glass, square)},
          {"dense squares of spheres", false, close_together(dense, square)},
          {"squares in a ball", false, squares_in_a_ball()},
          {"mirroring cylinders", true, close_together(mirror, solid("cylinder", closed))},
          {"mirroring pipes", true, close_together(mirror, solid("cylinder", open))},
          {"glass cylinders", false, close_together(glass, solid("cylinder", closed))},
          {"mirroring cones", true, close_together(mirror, solid("cone", narrowing))},
          {"mirroring open cones", true, close_together(mirror, solid("cone", wide_open))},
          {"glass cones", false, close_together(glass, solid("cone", narrowing))},
          {"mirroring smooth triangles", true, close_together(mirror, smooth)},
          {"glass smooth triangles", false, close_together(glass, smooth)}};
}

/// What single rounds off is magnified from one to the next.
TEST(Variants, mixed_carries_what_mirrors_and_lenses_magnify) {
  for (const MagnifyingScene& named : magnifying_scenes()) {
    const Image expected = reference_image(named.scene);
    for (const InstructionSet& set : supported_instruction_sets()) {
      const Plan plan = make_plan(named.scene, {set});
      EXPECT_EQ(plan.precision.value, Precision::mixed)
          << named.name << ": " << plan.precision.reason();
      const int in_single =
          count_wrong(image_on(set, Precision::single_precision, named.scene), expected);
      if (named.is_mirroring) {
        EXPECT_GE(in_single, 20) << named.name << " on " << set.name;
      }
      EXPECT_LE(count_wrong(image_by(plan, named.scene), expected), std::max(2, in_single / 20))
          << named.name << " on " << set.name;
    }
  }
}

/// Between mirrors nothing is left after some reflections of what single carries.
TEST(Variants, mixed_carries_what_four_mirrors_magnify) {
  std::ifstream file(std::filesystem::path(SCENES_DIRECTORY) / "four-mirrors.json",
                     std::ios::binary);
  Scene scene = prepared({std::istreambuf_iterator<char>(file), {}});
  scene.camera.width = 350;
  scene.camera.height = 250;
  scene.render.transfer = Transfer::linear;
  const Image expected = reference_image(scene);
  for (const InstructionSet& set : supported_instruction_sets()) {
    const Plan plan = make_plan(scene, {set});
    ASSERT_EQ(plan.precision.value, Precision::mixed) << plan.precision.reason();
    const int in_single = count_wrong(image_on(set, Precision::single_precision, scene), expected);
    const int in_mixed = count_wrong(image_by(plan, scene), expected);
    EXPECT_GE(in_single, 100) << set.name;
    EXPECT_LE(20 * in_mixed, in_single) << set.name;
  }
}

/// Light goes through surfaces that single cannot tell apart, and must not go to and fro for ever.
TEST(Variants, glass_in_single_comes_to_an_end) {
  const std::string glass = R"({"ka": 0, "kd": 0.1, "transparency": 0.9, "ior": 1.5})";
  Scene scene = with_objects(
      R"({"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": )" + glass +
          R"(}, {"type": "sphere", "center": [0, 1e-7, 0], "radius": 1, "material": )" + glass +
          R"(}, {"type": "sphere", "center": [1e-7, 0, 0], "radius": 1, "material": )" + glass +
          "}",
      point_light);
  for (const InstructionSet& set : supported_instruction_sets())
    EXPECT_EQ(image_on(set, Precision::single_precision, scene).width, scene.camera.width);
}

/// Of a width and a height that no packet divides, in either transfer.
TEST(Variants, bytes_are_the_rounded_floats_on_every_instruction_set) {
  Scene scene = scenes().front().scene;
  scene.camera.width = 61;
  scene.camera.height = 43;
  WorkerPool pool(1);
  for (const Transfer transfer : {Transfer::linear, Transfer::srgb}) {
    scene.render.transfer = transfer;
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
      scene.render.precision = precision;
      for (const InstructionSet& set : supported_instruction_sets()) {
        const Plan plan = make_plan(scene, {set});
        const ByteImage rounded = to_bytes(image_by(plan, scene), pool);
        EXPECT_TRUE(image_by<unsigned char>(plan, scene).values == rounded.values) << set.name;
      }
    }
    const Plan plan = reference_plan(make_plan(scene, this_machine()), Finder::tree);
    EXPECT_TRUE(image_by<unsigned char>(plan, scene).values ==
                to_bytes(image_by(plan, scene), pool).values);
  }
}

TEST(Variants, runs_on_the_instruction_set_that_is_asked_for) {
  const Scene scene = with_objects(random_spheres(3, 1, "{}"), distant_lights);
  const Plan plan = make_plan(scene, this_machine());
  WorkerPool pool(1);
  const PackedScene packed = pack_scene(scene, &pool);
  const auto single = make_packet_scene<float>(packed, plan.features, plan.finders, pool);
  const auto twice = make_packet_scene<double>(packed, plan.features, plan.finders, pool);
  const auto sets = supported_instruction_sets();
  ASSERT_FALSE(sets.empty());
  for (const InstructionSet& set : sets) {
    Image image(16, 16);
    const SamplePattern pattern = sample_pattern(1);
    const Tile tile{0, 0, image.width, image.height};
    EXPECT_EQ(render_tile(single, pattern, tile, set.target, {Transfer::linear, &image}).target,
              set.target)
        << set.name;
    EXPECT_EQ(render_tile(twice, pattern, tile, set.target, {Transfer::linear, &image}).target,
              set.target)
        << set.name;
  }
}

TEST(Variants, leaves_the_eye_inside_a_sphere_to_the_reference) {
  const Scene scene =
      with_objects(R"({"type": "sphere", "center": [0, 3, -12], "radius": 1})", point_light);
  EXPECT_NE(make_plan(scene, this_machine()).kernel.value, Kernel::packets);
}

}  // namespace
}  // namespace raytracer::test
