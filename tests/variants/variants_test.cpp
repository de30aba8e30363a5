// Every kernel on every instruction set of this machine draws what the reference draws.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "engine/image/encode.h"
#include "engine/kernel/this_machine.h"
#include "engine/plan/plan.h"
#include "engine/reference/radiance.h"
#include "engine/reference/single_ray_finder.h"
#include "engine/render/tracer.h"
#include "engine/scene/read_scene.h"
#include "tests/support/reference_plan.h"
#include "tests/support/scene_plan.h"
#include "tests/variants/image_by.h"
#include "tests/variants/random_documents.h"

namespace raytracer::test {
namespace {

constexpr int width_px = 160;

struct NamedScene {
  std::string name;
  Scene scene;
};

Scene prepared(const std::string& text) {
  Overrides overrides;
  overrides.samples = 1;
  overrides.transfer = Transfer::linear;
  Scene scene = read_scene(text, Limits{}, overrides).value();
  scene.camera.height = std::max(1, scene.camera.height * width_px / scene.camera.width);
  scene.camera.width = width_px;
  return scene;
}

/// A scene of its own, so that what a test changes of it stays there.
Scene with_objects(const std::string& objects, const std::string& lights) {
  return prepared(fmt::format(
      R"({{"camera": {{"origin": [0, 3, -12], "look_at": [0, 0, 0], "fov": 0.9, "width": 160,
          "height": 120}}, "background": [0.2, 0.3, 0.4], "lights": [{}], "objects": [{}]}})",
      lights, objects));
}

constexpr const char* distant_lights =
    R"({"type": "distant", "direction": [-0.6, -1, 0.7]},
       {"type": "distant", "direction": [0.6, -0.4, 0.5], "intensity": 0.5})";
constexpr const char* point_light =
    R"({"type": "point", "position": [4, 6, -5], "intensity": 900})";

/// A flat sheet before a plane, wider than the view, whose sides and corners the rays and the
/// shadows pass through: wherever one slips between triangles it shows.
Scene straight_sheet() {
  std::string vertices;
  std::string triangles;
  constexpr int side = 96;
  constexpr double middle = side / 16.0;
  for (int i = 0; i <= side; ++i)
    for (int k = 0; k <= side; ++k)
      vertices += fmt::format("{}[{}, {}, 0]", vertices.empty() ? "" : ",", i / 8.0 - middle,
                              k / 8.0 - middle);
  for (int i = 0; i < side; ++i) {
    for (int k = 0; k < side; ++k) {
      const int a = i * (side + 1) + k;
      const int b = a + side + 1;
      triangles += fmt::format("{}[{},{},{}],[{},{},{}]", triangles.empty() ? "" : ",", a, b, b + 1,
                               b + 1, a + 1, a);
    }
  }
  const std::string mesh = fmt::format(
      R"({{"type": "mesh", "vertices": [{}], "triangles": [{}], "material": {{"color": [1, 0, 0]}}}})",
      vertices, triangles);
  const std::string wall = R"({"type": "plane", "point": [0, 0, 1], "normal": [0, 0, 1]})";
  Scene scene = with_objects(mesh + "," + wall, R"({"type": "distant", "direction": [0, 0, 1]})");
  scene.camera.origin = {0, 0, -8};
  scene.camera.look_at = {0, 0, 0};
  scene.camera.fov = 2 * std::atan(0.625);  // pixels are 1/16 wide on the sheet
  scene.camera.height = scene.camera.width;
  scene.camera.origin.x += 1.0 / 32;  // and their centres on corners of the triangles
  scene.camera.origin.y += 1.0 / 32;
  scene.camera.look_at = {1.0 / 32, 1.0 / 32, 0};
  return scene;
}

std::vector<NamedScene> scenes() {
  std::vector<NamedScene> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(SCENES_DIRECTORY)) {
    std::ifstream file(entry.path(), std::ios::binary);
    const Scene scene = prepared({std::istreambuf_iterator<char>(file), {}});
    scenes.push_back({entry.path().stem().string(), scene});
  }
  const std::string matt = R"({"shininess": 20})";
  const std::string mirror = R"({"reflectivity": 0.6})";
  const std::string floor = R"({"type": "plane", "point": [0, -4, 0], "normal": [0, 1, 0]})";
  const std::string square =
      R"({"type": "sphere_square", "center": [0, -2, 0], "radius": 0.3, "n": 9, "axes": ")";
  scenes.push_back({"few spheres, point light",
                    with_objects(random_spheres(9, 0.8, matt) + "," + floor, point_light)});
  scenes.push_back({"many spheres, distant lights",
                    with_objects(random_spheres(900, 0.3, matt) + "," + floor, distant_lights)});
  scenes.push_back(
      {"many spheres, point light", with_objects(random_spheres(900, 0.3, matt), point_light)});
  scenes.push_back({"many mirrors",
                    with_objects(random_spheres(400, 0.4, mirror) + "," + floor, distant_lights)});
  for (const std::string& lights : {std::string(distant_lights), std::string(point_light),
                                    std::string(distant_lights) + "," + point_light}) {
    const std::string under =
        " under " + std::to_string(std::count(lights.begin(), lights.end(), '{')) + " lights";
    scenes.push_back({"sheet" + under, with_objects(rough_sheet(70, matt) + "," + floor, lights)});
    for (const int side : {12, 41})
      scenes.push_back(
          {"smooth sheet" + under, with_objects(smooth_sheet(side, matt) + "," + floor + "," +
                                                    random_spheres(20, 0.3, mirror),
                                                lights)});
    scenes.push_back(
        {"smooth mirror" + under,
         with_objects(smooth_sheet(8, mirror) + "," + random_spheres(20, 0.3, matt), lights)});
    scenes.push_back(
        {"mirroring sheet" + under,
         with_objects(rough_sheet(9, mirror) + "," + random_spheres(200, 0.3, mirror), lights)});
    scenes.push_back(
        {"large triangles" + under,
         with_objects(random_triangles(90, matt) + "," + random_spheres(40, 0.3, matt), lights)});
  }
  for (const std::string& lights : {std::string(distant_lights), std::string(point_light),
                                    std::string(distant_lights) + "," + point_light}) {
    const std::string under =
        " under " + std::to_string(std::count(lights.begin(), lights.end(), '{')) + " lights";
    for (const int count : {6, 90, 1500})
      for (const std::string& material : {matt, mirror}) {
        const std::string others = "," + floor + "," + random_spheres(20, 0.3, mirror);
        const auto add = [&](const char* kind, const std::string& objects) {
          scenes.push_back({std::to_string(count) + kind + under + " of " + material,
                            with_objects(objects + others, lights)});
        };
        add(" cylinders", random_cylinders(count, material));
        add(" cones", random_cones(count, material));
      }
  }
  scenes.push_back({"sheet seen along its corners", straight_sheet()});
  for (const std::string axes : {"xz", "xy", "yz"})
    scenes.push_back(
        {"square " + axes,
         with_objects(square + axes + "\"}," + random_spheres(2, 0.7, mirror), distant_lights)});
  scenes.push_back({"square, point light",
                    with_objects(square + "xz\"}," + random_spheres(2, 0.7, matt), point_light)});
  scenes.push_back(
      {"square, low light",
       with_objects(square + "xz\"}", R"({"type": "distant", "direction": [-1, -0.04, 0.7]})")});
  return scenes;
}

/// The reference: one ray at a time, in double.
Image reference_image(const Scene& scene) {
  WorkerPool pool(1);
  const PackedScene packed = pack_scene(scene, &pool);
  const SingleRayFinder finder(packed, all_by(Finder::tree), pool);
  Image image(scene.camera.width, scene.camera.height);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Rgb seen =
          see(packed, finder, packed.view.direction(x + 0.5, image.height - y - 0.5)).radiance;
      image.pixel(x, y)[0] = static_cast<float>(std::clamp(seen.x, 0.0, 1.0));
      image.pixel(x, y)[1] = static_cast<float>(std::clamp(seen.y, 0.0, 1.0));
      image.pixel(x, y)[2] = static_cast<float>(std::clamp(seen.z, 0.0, 1.0));
    }
  }
  return image;
}

Image image_on(const InstructionSet& set, Precision precision, Scene scene) {
  scene.render.precision = precision;
  const Plan plan = make_plan(scene, {set});
  EXPECT_EQ(plan.kernel.value, Kernel::packets) << plan.kernel.reason();
  EXPECT_EQ(plan.precision.value, precision);
  return image_by(plan, scene);
}

/// Pixels with a channel that is off by more than a level, or is no number.
int count_wrong(const Image& image, const Image& expected) {
  int wrong = 0;
  for (std::size_t i = 0; i < image.values.size(); i += 3) {
    bool is_wrong = false;
    for (std::size_t c = i; c < i + 3; ++c)
      is_wrong = is_wrong || !(std::abs(image.values[c] - expected.values[c]) <= 1.0F / 255);
    wrong += is_wrong ? 1 : 0;
  }
  return wrong;
}

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

/// Between mirrors nothing is left after some reflections of what single carries.
TEST(Variants, mixed_traces_again_what_mirrors_magnify) {
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

/// In the midst of them, beside them, along an axis, and so far away that all are in one direction.
TEST(Variants, finds_shadows_of_spheres_wherever_the_lamp_is) {
  const std::string matt = R"({"shininess": 20})";
  for (const char* const place : {"[0, 0, 0]", "[0.5, 3, -6]", "[9, 0, 0]", "[0, -40, 0]",
                                  "[300, 500, -400]", "[-2e5, 1e5, -3e5]"}) {
    const Scene scene = with_objects(
        random_spheres(900, 0.3, matt) +
            R"(, {"type": "plane", "point": [0, -5, 0], "normal": [0, 1, 0]})",
        fmt::format(R"({{"type": "point", "position": {}, "intensity": 0.8, "falloff": "none"}})",
                    place));
    const Image expected = reference_image(scene);
    for (const InstructionSet& set : supported_instruction_sets()) {
      EXPECT_EQ(count_wrong(image_on(set, Precision::double_precision, scene), expected), 0)
          << place << " on " << set.name;
      EXPECT_LE(count_wrong(image_on(set, Precision::single_precision, scene), expected), 10)
          << place << " on " << set.name;
    }
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

/// Also by those that the plan would not choose.
template <class Kind>
void expect_alike_by_every_finder() {
  for (const NamedScene& named : scenes()) {
    Scene scene = named.scene;
    scene.render.precision = Precision::double_precision;
    Plan plan = make_plan(scene, this_machine());
    const std::size_t count = plan.features.primitives[kind_index<Kind>];
    if (count == 0) continue;
    const Image expected = reference_image(scene);
    for (const Finder otherwise : {Finder::tree, Finder::one_by_one}) {
      if (otherwise == Finder::one_by_one && count > 10 * Kind::few.followed) continue;
      for (const bool by_bins : {false, true}) {
        for (const bool by_grids : {false, true}) {
          FinderRow& row = plan.finders[kind_index<Kind>];
          row.fill(otherwise);
          set(row, RayKind::from_eye, by_bins ? Finder::screen_bins : Finder::tree);
          if (by_grids) set(row, RayKind::to_distant_light, Finder::light_grid);
          EXPECT_EQ(count_wrong(image_by(plan, scene), expected), 0)
              << named.name << (by_bins ? ", bins" : "") << (by_grids ? ", grids" : "");
        }
      }
    }
  }
}

TEST(Variants, finds_triangles_alike_by_every_finder) {
  expect_alike_by_every_finder<TriangleKind>();
}

TEST(Variants, finds_cylinders_alike_by_every_finder) {
  expect_alike_by_every_finder<CylinderKind>();
}

TEST(Variants, finds_cones_alike_by_every_finder) { expect_alike_by_every_finder<ConeKind>(); }

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
    EXPECT_EQ(render_tile(single, pattern, Transfer::linear, tile, set.target, &image).target,
              set.target)
        << set.name;
    EXPECT_EQ(render_tile(twice, pattern, Transfer::linear, tile, set.target, &image).target,
              set.target)
        << set.name;
  }
}

TEST(Variants, finds_spheres_in_an_image_wider_than_sixteen_bits_count) {
  Scene scene =
      with_objects(R"({"type": "sphere", "center": [5.6, 0, 0], "radius": 0.2})", distant_lights);
  scene.camera.width = 400'000;
  scene.camera.height = 1;
  const Image expected = reference_image(scene);
  const InstructionSet set = supported_instruction_sets().front();
  EXPECT_EQ(count_wrong(image_on(set, Precision::double_precision, scene), expected), 0);
  const float* const background = expected.pixel(0, 0);
  EXPECT_NE(*expected.pixel(387'600, 0), *background) << "no sphere where the test looks";
}

TEST(Variants, finds_spheres_that_fill_the_image_by_a_tree) {
  Scene scene = with_objects(random_spheres(4000, 5, "{}"), distant_lights);
  scene.render.precision = Precision::double_precision;
  scene.camera.width = 700;
  scene.camera.height = 500;
  const Plan plan = make_plan(scene, this_machine());
  ASSERT_EQ(plan.kernel.value, Kernel::packets) << plan.kernel.reason();
  EXPECT_EQ(finder_of(plan.finders[kind_index<SphereKind>], RayKind::from_eye), Finder::tree);
  scene.camera.width = 70;
  scene.camera.height = 50;
  Plan with_tree = make_plan(scene, this_machine());
  set(with_tree.finders[kind_index<SphereKind>], RayKind::from_eye, Finder::tree);
  EXPECT_EQ(count_wrong(image_by(with_tree, scene), reference_image(scene)), 0);
}

TEST(Variants, leaves_the_eye_inside_a_sphere_to_the_reference) {
  const Scene scene =
      with_objects(R"({"type": "sphere", "center": [0, 3, -12], "radius": 1})", point_light);
  EXPECT_NE(make_plan(scene, this_machine()).kernel.value, Kernel::packets);
}

}  // namespace
}  // namespace raytracer::test
