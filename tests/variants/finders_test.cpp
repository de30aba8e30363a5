// Every finder finds what the reference finds, also where the plan would choose another.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/reference_plan.h"
#include "tests/support/scene_plan.h"
#include "tests/support/scenes.h"
#include "tests/variants/compare.h"
#include "tests/variants/image_by.h"
#include "tests/variants/random_documents.h"
#include "tests/variants/scenes.h"

namespace raytracer::test {
namespace {

void expect_shadows(const std::string& objects, const std::string& light) {
  const Scene scene = with_objects(
      objects + R"(, {"type": "plane", "point": [0, -5, 0], "normal": [0, 1, 0]})", light);
  const Image expected = reference_image(scene);
  for (const InstructionSet& set : supported_instruction_sets()) {
    EXPECT_EQ(count_wrong(image_on(set, Precision::double_precision, scene), expected), 0)
        << light << " on " << set.name;
    EXPECT_LE(count_wrong(image_on(set, Precision::single_precision, scene), expected), 10)
        << light << " on " << set.name;
  }
}

std::string lamp_at(const char* place) {
  return fmt::format(R"({{"type": "point", "position": {}, "intensity": 0.8, "falloff": "none"}})",
                     place);
}

/// In the midst of them, beside them, along an axis, and so far away that all are in one direction.
void expect_shadows_wherever_the_lamp_is(const std::string& objects) {
  for (const char* const place : {"[0, 0, 0]", "[0.5, 3, -6]", "[9, 0, 0]", "[0, -40, 0]",
                                  "[300, 500, -400]", "[-2e5, 1e5, -3e5]", "[2e8, 2e8, -2e8]"})
    expect_shadows(objects, lamp_at(place));
}

constexpr const char* matt = R"({"shininess": 20})";

TEST(Finders, find_shadows_of_spheres_wherever_the_lamp_is) {
  expect_shadows_wherever_the_lamp_is(random_spheres(900, 0.3, matt));
}

TEST(Finders, find_shadows_of_cylinders_wherever_the_lamp_is) {
  expect_shadows_wherever_the_lamp_is(random_cylinders(300, matt));
}

TEST(Finders, find_shadows_of_cones_wherever_the_lamp_is) {
  expect_shadows_wherever_the_lamp_is(random_cones(300, matt));
}

TEST(Finders, find_shadows_of_triangles_wherever_the_lamp_is) {
  expect_shadows_wherever_the_lamp_is(rough_sheet(24, matt));
  expect_shadows_wherever_the_lamp_is(random_triangles(60, matt));
}

/// Under a thousand small ones a large one, on which their shadows fall, and above all another,
/// whose own falls on half of the picture.
TEST(Finders, find_shadows_of_the_few_that_are_far_wider) {
  const std::string sun = R"({"type": "distant", "direction": [-1, -2, 1.5]})";
  const std::string sheet = R"(, {"type": "mesh", "material": {}, "vertices": [[-900, -4, -900],
      [900, -4, -900], [0, -4, 900], [0, 40, -60], [0, 40, 0], [60, 40, 0]],
      "triangles": [[0, 1, 2], [3, 4, 5]]})";
  const auto axial = [](const char* kind, const char* radii) {
    return fmt::format(R"(, {{"type": "{0}", "from": [-400, -24, 0], "to": [400, -24, 0], {1},
        "material": {{}}}}, {{"type": "{0}", "from": [0, 60, 0], "to": [60, 60, 0], {1},
        "material": {{}}}})",
                       kind, radii);
  };
  for (const std::string& objects :
       {random_spheres(900, 0.3, matt) +
            R"(, {"type": "sphere", "center": [0, -1004, 0], "radius": 1000, "material": {}},
               {"type": "sphere", "center": [30, 40, 0], "radius": 30, "material": {}})",
        random_triangles(300, matt) + sheet,
        random_cylinders(300, matt) + axial("cylinder", R"("radius": 20)"),
        random_cones(300, matt) + axial("cone", R"("radius_from": 20, "radius_to": 18)")})
    for (const std::string& light :
         {sun, lamp_at("[0.5, 9, -6]"), lamp_at("[20, 300, -40]"), lamp_at("[0, -2, 0]")})
      expect_shadows(objects, light);
}

template <class Kind>
void expect_alike_by_every_finder() {
  for (const NamedScene& named : scenes()) {
    Scene scene = named.scene;
    scene.render.precision = Precision::double_precision;
    Plan plan = make_plan(scene, this_machine());
    const std::size_t count = plan.features.primitives[kind_index<Kind>];
    if (count == 0) continue;
    const bool has_hard_lights =
        plan.features.light_count(LightRays::parallel) > plan.features.shared_lights ||
        plan.features.light_count(LightRays::converging) > 0;
    const Image expected = reference_image(scene);
    for (const Finder otherwise : {Finder::tree, Finder::one_by_one}) {
      if (otherwise == Finder::one_by_one && count > 10 * Kind::few.followed) continue;
      for (const bool by_bins : {false, true}) {
        for (const bool by_grids : {false, true}) {
          if (by_grids && !has_hard_lights) continue;
          FinderRow& row = plan.finders[kind_index<Kind>];
          row.fill(otherwise);
          set(row, RayKind::from_eye, by_bins ? Finder::screen_bins : Finder::tree);
          if (by_grids) {
            set(row, RayKind::to_distant_light, Finder::light_grid);
            set(row, RayKind::to_point_light, Finder::point_grid);
          }
          EXPECT_EQ(count_wrong(image_by(plan, scene), expected), 0)
              << named.name << (by_bins ? ", bins" : "") << (by_grids ? ", grids" : "");
        }
      }
    }
  }
}

TEST(Finders, find_triangles_alike_by_every_finder) {
  expect_alike_by_every_finder<TriangleKind>();
}

TEST(Finders, find_cylinders_alike_by_every_finder) {
  expect_alike_by_every_finder<CylinderKind>();
}

TEST(Finders, find_cones_alike_by_every_finder) { expect_alike_by_every_finder<ConeKind>(); }

/// Among crowded points and far ones, on large spheres and small ones, from mirrors, and where
/// other kinds of objects hide the light as well.
TEST(Finders, find_what_hides_soft_lights_alike_by_every_finder) {
  const std::string sky = R"({"type": "sky", "intensity": 0.6})";
  const std::string sun = R"({"type": "distant", "direction": [-1, -2, 1.5], "angle": 0.3})";
  const std::string matt = R"({"shininess": 20})";
  const std::string mirror = R"({"reflectivity": 0.6})";
  const std::string ground =
      R"(, {"type": "sphere", "center": [0, -2003, 0], "radius": 2000, "material": {}})";
  for (const auto& [objects, lights] :
       {std::pair(fmt::format("{},{}", random_spheres(60, 0.6, mirror), random_cylinders(4, matt)),
                  sky),
        std::pair(random_spheres(900, 0.1, matt) + ground, fmt::format("{},{}", sky, sun)),
        std::pair(fmt::format("{},{}", random_spheres(60, 0.6, matt), random_cones(4, matt)),
                  sun)}) {
    Scene scene = with_objects(objects, lights);
    scene.camera.width = 90;
    scene.camera.height = 60;
    scene.render.precision = Precision::double_precision;
    const Image expected = reference_image(scene);
    for (const InstructionSet& set_of : supported_instruction_sets()) {
      Plan plan = make_plan(scene, this_machine());
      plan.instruction_set = set_of;
      for (const Finder finder :
           {Finder::one_by_one, Finder::light_grid, Finder::light_sweep, Finder::tree}) {
        FinderRow& row = plan.finders[kind_index<SphereKind>];
        set(row, RayKind::to_soft_light, finder);
        EXPECT_EQ(count_wrong(image_by(plan, scene), expected), 0)
            << lights << " on " << set_of.name << ", finder " << static_cast<int>(finder);
      }
    }
  }
}

/// Each kind of glass among what lets nothing through, before and behind it, and some of both in
/// one kind.
TEST(Finders, find_light_through_glass_among_what_hides_it) {
  const std::string matt = R"({"shininess": 20})";
  const std::string glass = R"({"transparency": 0.8, "ior": 1.4})";
  const std::string sun = R"({"type": "distant", "direction": [-1, -2, 1.5]})";
  const std::string lamp = R"({"type": "point", "position": [4, 6, -5], "intensity": 900})";
  const std::string wide_sun = R"({"type": "distant", "direction": [-1, -2, 1.5], "angle": 0.3})";
  const std::string wide_lamp =
      R"({"type": "point", "position": [4, 6, -5], "intensity": 900, "radius": 1})";
  const std::string sky = R"({"type": "sky", "intensity": 0.6})";
  const std::string floor = R"({"type": "plane", "point": [0, -5, 0], "normal": [0, 1, 0]})";
  const auto square = [](const char* places, const std::string& material) {
    return fmt::format(R"({{"type": "sphere_square", {}, "material": {}}})", places, material);
  };
  for (const auto& [opaque, clear] :
       {std::pair(random_spheres(150, 0.6, matt), random_spheres(40, 0.8, glass)),
        std::pair(square(R"("center": [0, -2, 0], "radius": 0.4, "n": 5)", matt),
                  square(R"("center": [0, 1, 0], "radius": 0.7, "n": 3, "axes": "xy")", glass)),
        std::pair(random_triangles(60, matt), random_triangles(20, glass)),
        std::pair(random_cylinders(40, matt) + "," + random_cones(12, glass),
                  random_cylinders(10, glass) + "," + random_cones(30, matt))})
    for (const std::string& light : {sun, lamp, wide_sun, wide_lamp, sky}) {
      Scene scene = with_objects(fmt::format("{},{},{}", opaque, floor, clear), light);
      scene.camera.width = 90;
      scene.camera.height = 60;
      scene.render.max_depth = 3;
      const Image expected = reference_image(scene);
      for (const InstructionSet& set : supported_instruction_sets())
        EXPECT_EQ(count_wrong(image_on(set, Precision::double_precision, scene), expected), 0)
            << clear.substr(0, 40) << " under " << light << " on " << set.name;
    }
}

/// From so far away that a single holds places to a fiftieth of a radius.
TEST(Finders, find_mirrored_spheres_that_boxes_hardly_hold_apart) {
  const std::string mirror = R"({"reflectivity": 0.6})";
  for (const char* const lights : {distant_lights, point_light}) {
    Scene scene = with_objects(random_spheres(400, 0.4, mirror) + "," + random_cones(90, mirror) +
                                   "," + random_cylinders(90, mirror),
                               lights);
    scene.camera.origin = 1e4 * scene.camera.origin;
    scene.camera.fov /= 1e4;
    const Image expected = reference_image(scene);
    for (const InstructionSet& set : supported_instruction_sets())
      EXPECT_EQ(count_wrong(image_on(set, Precision::double_precision, scene), expected), 0)
          << lights << " on " << set.name;
  }
}

/// Rays that follow others are taken through trees together: those of a block, of eight, and of
/// what is left of a tile.
TEST(Finders, find_the_same_for_the_rays_of_one_block_and_of_many) {
  const std::string mirror = R"({"reflectivity": 0.6})";
  const std::string floor = R"({"type": "plane", "point": [0, -5, 0], "normal": [0, 1, 0],
      "material": {"reflectivity": 0.4}})";
  const std::string lattice = R"({"type": "sphere_square", "center": [0, -4, 0], "n": 9,
      "radius": 0.3, "axes": "xz", "material": {"reflectivity": 0.5}})";
  for (const std::string& objects :
       {random_spheres(300, 0.5, mirror) + "," + random_cylinders(60, mirror) + "," + floor,
        random_triangles(200, mirror) + "," + lattice}) {
    Scene scene = with_objects(objects, distant_lights);
    scene.camera.width = 210;
    scene.camera.height = 90;
    const Image expected = reference_image(scene);
    for (const Precision precision : {Precision::single_precision, Precision::double_precision})
      for (const InstructionSet& set : supported_instruction_sets()) {
        scene.render.precision = precision;
        Plan plan = make_plan(scene, this_machine());
        plan.instruction_set = set;
        const Image of_blocks = image_by(plan, scene, 2, 16);
        const Image of_one_tile = image_by(plan, scene, 2, 256);
        EXPECT_EQ(count_different(of_blocks, of_one_tile), 0) << set.name;
        if (precision == Precision::double_precision) {
          EXPECT_EQ(count_wrong(image_by(plan, scene, 1, 256), expected), 0) << set.name;
        }
      }
  }
}

/// Spheres so large that single rounds middle and radius to much of what stands on them, in single
/// and in double; the latter is to be right to the pixel.
void expect_no_digits_lost(Scene scene, int in_single) {
  scene.render.max_depth = 2;  // more mirrors would magnify what single rounds off
  const Image expected = reference_image(scene);
  for (const InstructionSet& set : supported_instruction_sets()) {
    EXPECT_LE(count_wrong(image_on(set, Precision::single_precision, scene), expected), in_single)
        << set.name;
    EXPECT_EQ(count_wrong(image_on(set, Precision::double_precision, scene), expected), 0)
        << set.name;
  }
}

/// By spheres tried one by one and in a tree, from outside and from within glass.
TEST(Finders, meet_a_ground_as_large_as_a_planet) {
  const std::string glass = R"({"transparency": 0.9, "ior": 1.5})";
  const std::string mirror = R"({"reflectivity": 0.6})";
  for (const char* const center : {"[0, -1000003, 0]", "[300000.9, -900002.7, -316228.71493]"})
    for (const int count : {20, 200})
      for (const std::string& material : {mirror, glass})
        expect_no_digits_lost(
            with_objects(fmt::format(R"({}, {{"type": "sphere", "center": {}, "radius": 1000000,
                                             "material": {{"reflectivity": 0.3}}}})",
                                     random_spheres(count, 0.6, material), center),
                         R"({"type": "distant", "direction": [-0.6, -1, 0.7]})"),
            20);
}

/// Light comes to what is under the surface, and rays under it are mirrored by it.
TEST(Finders, find_the_way_out_of_water_as_wide_as_a_planet) {
  for (const char* const balls : {R"({"kd": 0.9})", R"({"reflectivity": 0.8})"})
    expect_no_digits_lost(with_objects(fmt::format(R"({{"type": "sphere", "center": [0, -999999, 0],
                                     "radius": 1000000, "material": {{"kd": 0.02,
                                     "transparency": 0.5, "ior": 1.33}}}},
                                    {{"type": "spheres", "centers": [[-3, 0.3, 0], [-1, 0.3, 0],
                                      [1, 0.3, -3], [3, 0.3, 1]], "radius": 0.5, "material": {}}})",
                                                   balls),
                                       R"({"type": "distant", "direction": [-0.3, -1, 0.3]})"),
                          20);
}

/// The horizon of a ground without anything on it, seen through a narrow view.
TEST(Finders, see_the_horizon_of_a_planet_where_it_is) {
  for (const double radius : {1e6, 1e7}) {
    Scene scene = with_objects(fmt::format(R"({{"type": "sphere", "center": [0, {}, 0],
                                               "radius": {}, "material": {{}}}})",
                                           -radius, radius),
                               R"({"type": "distant", "direction": [-0.3, -1, -0.2]})");
    scene.camera.origin = {0, 0.1, 0};
    scene.camera.look_at = {0.31, 0.1, -1};
    scene.camera.up = {0.03, 1, 0.02};
    scene.camera.fov = 0.1;
    expect_no_digits_lost(scene, 2);
  }
}

TEST(Finders, find_spheres_in_an_image_wider_than_sixteen_bits_count) {
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

TEST(Finders, find_spheres_that_fill_the_image_by_a_tree) {
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

}  // namespace
}  // namespace raytracer::test
