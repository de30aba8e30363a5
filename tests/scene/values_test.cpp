// What read_scene makes of a valid document: defaults, notations, and every value in its place.

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

constexpr const char* minimal = R"({"camera": {"origin": [0, 0, 0], "look_at": [0, 0, 5],
                                               "fov": 1, "width": 7, "height": 5}})";

TEST(Defaults, of_a_minimal_document_are_the_documented_ones) {
  const Scene scene = scene_of_text(minimal);
  EXPECT_EQ(scene.camera.up, (Vec3{0, 1, 0}));
  EXPECT_EQ(scene.background, (Rgb{0, 0, 0}));
  EXPECT_EQ(scene.ambient, 0.2);
  EXPECT_EQ(scene.shadows, Shadows::black);
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_TRUE(scene.objects.empty());
  EXPECT_TRUE(scene.materials.empty());
  EXPECT_EQ(scene.render.samples.value_or(1), 1);
  EXPECT_FALSE(scene.render.target_rmse);
  EXPECT_FALSE(scene.render.budget_ms);
  EXPECT_EQ(scene.render.precision, Precision::automatic);
  EXPECT_EQ(scene.render.max_depth, 5);
  EXPECT_EQ(scene.render.transfer, Transfer::linear);
}

TEST(Defaults, of_a_material_are_the_documented_ones) {
  for (const json& object : {json{{"type", "sphere"}, {"center", {0, 0, 5}}, {"radius", 1}},
                             sphere_json({0, 0, 5}, 1, json::object())}) {
    const Scene scene = scene_of(document(camera_json(), {object}));
    ASSERT_EQ(scene.materials.size(), 1U);
    const Material& material = scene.materials[scene.objects[0].material];
    EXPECT_EQ(material.color, (Rgb{1, 1, 1}));
    EXPECT_EQ(material.ka, 1);
    EXPECT_EQ(material.kd, 0.7);
    EXPECT_EQ(material.ks, 0.3);
    EXPECT_EQ(material.shininess, 50);
    EXPECT_EQ(material.reflectivity, 0);
    EXPECT_EQ(material.transparency, 0);
    EXPECT_EQ(material.ior, 1.5);
    EXPECT_FALSE(material.fresnel);
  }
}

TEST(Defaults, of_a_light_are_white_and_one) {
  const Scene scene = scene_of(document(camera_json(), {},
                                        {{{"type", "distant"}, {"direction", {0, -1, 0}}},
                                         {{"type", "point"}, {"position", {0, 1, 0}}}}));
  for (const Light& light : scene.lights) {
    EXPECT_EQ(light.color, (Rgb{1, 1, 1}));
    EXPECT_EQ(light.intensity, 1);
  }
}

TEST(Defaults, of_a_square_is_the_axes_xz) {
  json square = square_json({1, 2, 3}, 0.5, 7);
  square.erase("axes");
  const Scene scene = scene_of(document(camera_json(), {square}));
  const auto& shape = std::get<SphereSquare>(scene.objects[0].shape);
  EXPECT_EQ(shape.axes, Axes::xz);
  EXPECT_EQ(shape.n, 7);
  EXPECT_EQ(shape.radius, 0.5);
  EXPECT_EQ(shape.center, (Vec3{1, 2, 3}));
}

TEST(Values, of_the_camera_and_surroundings_are_taken_over) {
  const Scene scene = scene_of_text(R"({
    "camera": {"origin": [1, 2, 3], "look_at": [4, 5, 6], "up": [0, 0, 2], "fov": 1.25,
               "width": 70, "height": 50},
    "background": [0.25, 0.5, 0.75], "ambient": 3.5, "shadows": "off",
    "render": {"samples": 9, "max_depth": 2, "precision": "single", "transfer": "srgb"}})");
  EXPECT_EQ(scene.camera.origin, (Vec3{1, 2, 3}));
  EXPECT_EQ(scene.camera.look_at, (Vec3{4, 5, 6}));
  EXPECT_EQ(scene.camera.up, (Vec3{0, 0, 2}));
  EXPECT_EQ(scene.camera.fov, 1.25);
  EXPECT_EQ(scene.camera.width, 70);
  EXPECT_EQ(scene.camera.height, 50);
  EXPECT_EQ(scene.background, (Rgb{0.25, 0.5, 0.75}));
  EXPECT_EQ(scene.ambient, 3.5);
  EXPECT_EQ(scene.shadows, Shadows::off);
  EXPECT_EQ(scene.render.samples, 9);
  EXPECT_EQ(scene.render.max_depth, 2);
  EXPECT_EQ(scene.render.precision, Precision::single_precision);
  EXPECT_EQ(scene.render.transfer, Transfer::srgb);
}

TEST(Values, of_lights_are_taken_over) {
  const Scene scene = scene_of(document(camera_json(), {},
                                        {distant_json({1, -2, 3}, 0.9, {0.5, 0.25, 1}),
                                         point_json({7, 8, 9}, 1500, {0.1, 0.2, 0.3})}));
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(std::get<DistantLight>(scene.lights[0].source).direction, (Vec3{1, -2, 3}));
  EXPECT_EQ(scene.lights[0].intensity, 0.9);
  EXPECT_EQ(scene.lights[0].color, (Rgb{0.5, 0.25, 1}));
  EXPECT_EQ(std::get<PointLight>(scene.lights[1].source).position, (Vec3{7, 8, 9}));
  EXPECT_EQ(scene.lights[1].intensity, 1500);
  EXPECT_EQ(std::get<DistantLight>(scene.lights[0].source).angle, 0);
  EXPECT_EQ(std::get<PointLight>(scene.lights[1].source).falloff, Falloff::inverse_square);
  EXPECT_EQ(std::get<PointLight>(scene.lights[1].source).radius, 0);
  EXPECT_EQ(scene.lights[1].color, (Rgb{0.1, 0.2, 0.3}));
}

TEST(Values, of_objects_are_taken_over_in_the_documents_order) {
  const Scene scene = scene_of(document(
      camera_json(),
      {mesh_json({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {3, 2, 1}}),
       plane_json({1, 2, 3}, {0, -2, 0}), square_json({1, 1, 1}, 0.25, 3, "yz"),
       json{{"type", "spheres"}, {"centers", {{1, 0, 0}, {2, 0, 0}}}, {"radius", {0.5, 0.75}}},
       sphere_json({4, 5, 6}, 7)}));
  ASSERT_EQ(scene.objects.size(), 5U);
  const auto& mesh = std::get<Mesh>(scene.objects[0].shape);
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.vertices[3], (Vec3{0, 0, 1}));
  ASSERT_EQ(mesh.triangles.size(), 2U);
  EXPECT_EQ(mesh.triangles[1], (std::array<std::uint32_t, 3>{3, 2, 1}));
  EXPECT_EQ(std::get<Plane>(scene.objects[1].shape).normal, (Vec3{0, -2, 0}));
  EXPECT_EQ(std::get<Plane>(scene.objects[1].shape).point, (Vec3{1, 2, 3}));
  EXPECT_EQ(std::get<SphereSquare>(scene.objects[2].shape).axes, Axes::yz);
  const auto& spheres = std::get<Spheres>(scene.objects[3].shape);
  EXPECT_EQ(spheres.centers[1], (Vec3{2, 0, 0}));
  EXPECT_EQ(spheres.radius(0), 0.5);
  EXPECT_EQ(spheres.radius(1), 0.75);
  EXPECT_EQ(std::get<Sphere>(scene.objects[4].shape).center, (Vec3{4, 5, 6}));
  EXPECT_EQ(std::get<Sphere>(scene.objects[4].shape).radius, 7);
}

TEST(Values, one_radius_serves_all_spheres) {
  const Scene scene = scene_of(
      document(camera_json(),
               {json{{"type", "spheres"}, {"centers", {{1, 0, 0}, {2, 0, 0}}}, {"radius", 0.5}}}));
  const auto& spheres = std::get<Spheres>(scene.objects[0].shape);
  EXPECT_EQ(spheres.radius(0), 0.5);
  EXPECT_EQ(spheres.radius(1), 0.5);
}

TEST(Values, of_colors_are_those_of_the_spheres_in_order) {
  json spheres{{"type", "spheres"}, {"centers", {{1, 0, 0}, {2, 0, 0}}}, {"radius", 0.5}};
  EXPECT_TRUE(std::get<Spheres>(scene_of(document(camera_json(), {spheres})).objects[0].shape)
                  .colors.empty());
  spheres["colors"] = {{0.25, 0.5, 1}, "#00ff00"};
  const Scene scene = scene_of(document(camera_json(), {spheres}));
  EXPECT_EQ(std::get<Spheres>(scene.objects[0].shape).colors,
            (std::vector<Rgb>{{0.25, 0.5, 1}, {0, 1, 0}}));
}

TEST(Values, of_cylinders_are_taken_over) {
  const json one{{"type", "cylinder"}, {"from", {1, 2, 3}}, {"to", {4, 5, 6}}, {"radius", 0.25}};
  json open = one;
  open["caps"] = false;
  const json many{{"type", "cylinders"},
                  {"from", {{1, 0, 0}, {2, 0, 0}}},
                  {"to", {{1, 1, 0}, {2, 2, 0}}},
                  {"radius", {0.5, 0.75}},
                  {"caps", false},
                  {"colors", {{0.25, 0.5, 1}, "#00ff00"}}};
  json plain = many;
  plain["radius"] = 0.5;
  plain.erase("caps");
  plain.erase("colors");
  const Scene scene = scene_of(document(camera_json(), {one, open, many, plain}));
  const auto& closed = std::get<Cylinder>(scene.objects[0].shape);
  EXPECT_EQ(closed.from, (Vec3{1, 2, 3}));
  EXPECT_EQ(closed.to, (Vec3{4, 5, 6}));
  EXPECT_EQ(closed.radius, 0.25);
  EXPECT_TRUE(closed.caps);
  EXPECT_FALSE(std::get<Cylinder>(scene.objects[1].shape).caps);
  const auto& cylinders = std::get<Cylinders>(scene.objects[2].shape);
  EXPECT_EQ(cylinders.from, (std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}}));
  EXPECT_EQ(cylinders.to, (std::vector<Vec3>{{1, 1, 0}, {2, 2, 0}}));
  EXPECT_EQ(cylinders.radius(0), 0.5);
  EXPECT_EQ(cylinders.radius(1), 0.75);
  EXPECT_FALSE(cylinders.caps);
  EXPECT_EQ(cylinders.colors, (std::vector<Rgb>{{0.25, 0.5, 1}, {0, 1, 0}}));
  const auto& alike = std::get<Cylinders>(scene.objects[3].shape);
  EXPECT_EQ(alike.radius(1), 0.5);
  EXPECT_TRUE(alike.caps);
  EXPECT_TRUE(alike.colors.empty());
}

TEST(Values, a_material_is_found_by_name_wherever_it_stands_in_the_document) {
  const Scene scene = scene_of_text(R"({
    "objects": [{"type": "sphere", "center": [0, 0, 5], "radius": 1, "material": "a"},
                {"type": "sphere", "center": [0, 0, 9], "radius": 1, "material": {"kd": 0.5}},
                {"type": "sphere", "center": [0, 0, 9], "radius": 1, "material": "a/~ b"}],
    "camera": {"origin": [0, 0, 0], "look_at": [0, 0, 5], "fov": 1, "width": 7, "height": 5},
    "materials": {"a": {"kd": 0.25, "reflectivity": 0.75}, "a/~ b": {"ks": 0.125}}})");
  const auto material = [&](std::size_t object) {
    return scene.materials[scene.objects[object].material];
  };
  EXPECT_EQ(material(0).kd, 0.25);
  EXPECT_EQ(material(0).reflectivity, 0.75);
  EXPECT_EQ(material(1).kd, 0.5);
  EXPECT_EQ(material(2).ks, 0.125);
}

TEST(Values, of_colours_in_hex_are_bytes_over255) {
  json text = json::parse(minimal);
  text["background"] = "#1080Ff";
  EXPECT_EQ(scene_of(text).background, (Rgb{16 / 255.0, 128 / 255.0, 1}));
}

TEST(Values, a_transparent_background_is_no_colour_and_a_fourth_channel) {
  json text = json::parse(minimal);
  EXPECT_EQ(channel_count(scene_of(text)), 3);
  text["background"] = "transparent";
  const Scene scene = scene_of(text);
  EXPECT_EQ(scene.background, std::nullopt);
  EXPECT_EQ(channel_count(scene), 4);
}

TEST(Values, integers_may_be_written_as_floats) {
  for (const char* width : {"700", "700.0", "7e2", "70.0e1", "7000e-1"}) {
    const std::string text = std::string(R"({"camera": {"origin": [0, 0, 0], "look_at": [0, 0, 5],
        "fov": 1, "height": 5, "width": )") +
                             width + "}}";
    EXPECT_EQ(scene_of_text(text).camera.width, 700) << width;
  }
}

TEST(Values, numbers_are_read_to_the_last_bit) {
  json text = json::parse(minimal);
  text["ambient"] = 0.1 + 0.2;
  text["camera"]["origin"] = {5e-324, 1.7976931348623157e308, -0.30000000000000004};
  const Scene scene = scene_of(text);
  EXPECT_EQ(scene.ambient, 0.1 + 0.2);
  EXPECT_EQ(scene.camera.origin, (Vec3{5e-324, 1.7976931348623157e308, -0.30000000000000004}));
}

TEST(Values, a_max_depth_beyond_an_int_is_valid) {
  json text = json::parse(minimal);
  text["render"]["max_depth"] = 1e15;
  EXPECT_EQ(scene_of(text).render.max_depth, std::numeric_limits<int>::max());
}

}  // namespace
}  // namespace raytracer::test
