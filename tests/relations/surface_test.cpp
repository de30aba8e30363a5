// Surfaces that coincide, touch or enclose each other, and cameras in, on and just above them.

#include <gtest/gtest.h>

#include <numbers>

#include "tests/relations/varied_scene.h"

namespace raytracer::test {
namespace {

const Vec3 red{1, 0, 0};
const Vec3 green{0, 1, 0};
const Vec3 magenta{1, 0, 1};  // of the background: no surface has it

/// Lit objects of constant colours, on magenta, so that black is a shadow or a hole.
json on_magenta(const json& camera, const std::vector<json>& objects, const json& light) {
  json text = document(camera, objects, {light});
  text["background"] = vector_json(magenta);
  text["ambient"] = 1;
  return text;
}

int count_color(const Image& image, const Vec3& color) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (color_at(image, x, y) == color) ++count;
  return count;
}

json in_color(json object, const Vec3& color) {
  object["material"] = constant_material(color);
  return object;
}

/// Two surfaces in the same place: the first one is seen, wherever the image shows one at all.
void expect_first_wins(const json& one, const json& other, const json& light) {
  for (const bool with_tree : {false, true}) {
    for (const bool swapped : {false, true}) {
      std::vector<json> objects{in_color(one, swapped ? green : red),
                                in_color(other, swapped ? red : green)};
      if (swapped) std::swap(objects[0], objects[1]);
      if (with_tree) objects.push_back(filler());
      const Image image =
          image_of(on_magenta(camera_json(64, 48, 1, {0.25, 1, -5}, {0, 0, 0}), objects, light));
      EXPECT_GT(count_color(image, red), 300) << "tree " << with_tree << ", swapped " << swapped;
      EXPECT_EQ(count_color(image, green), 0) << "tree " << with_tree << ", swapped " << swapped;
      EXPECT_EQ(count_color(image, {0, 0, 0}), 0)
          << "tree " << with_tree << ", swapped " << swapped;
    }
  }
}

const json from_the_camera = point_json({0.25, 1, -5}, 1);

json single(const json& sphere) {
  return {{"type", "spheres"}, {"centers", {sphere["center"]}}, {"radius", sphere["radius"]}};
}

TEST(Tie, of_two_spheres_goes_to_the_first_in_the_document) {
  const json sphere = sphere_json({0.3, 0.1, 0.7}, 1.7);
  expect_first_wins(sphere, sphere, from_the_camera);
  expect_first_wins(sphere, single(sphere), from_the_camera);
}

TEST(Tie, of_two_squares_goes_to_the_first_in_the_document) {
  const json square = square_json({0.3, 0.1, 0.7}, 0.7, 2);
  expect_first_wins(square, square, from_the_camera);
}

TEST(Tie, of_a_square_and_its_spheres_goes_to_the_first_in_the_document) {
  json centers = json::array();
  for (const double x : {-1.5, -0.5, 0.5, 1.5})
    for (const double z : {-1.5, -0.5, 0.5, 1.5}) centers.push_back({x, 0.25, z});
  expect_first_wins(square_json({0, 0.25, 0}, 0.5, 2),
                    json{{"type", "spheres"}, {"centers", centers}, {"radius", 0.5}},
                    from_the_camera);
}

TEST(Tie, of_two_cylinders_goes_to_the_first_in_the_document) {
  for (const bool caps : {true, false}) {
    const json cylinder = cylinder_json({-1.3, -0.9, 0.7}, {1.6, 1.1, 0.9}, 0.8, caps);
    const json set{{"type", "cylinders"},
                   {"from", {cylinder["from"]}},
                   {"to", {cylinder["to"]}},
                   {"radius", cylinder["radius"]},
                   {"caps", caps}};
    expect_first_wins(cylinder, cylinder, from_the_camera);
    expect_first_wins(cylinder, set, from_the_camera);
  }
}

TEST(Tie, of_two_planes_goes_to_the_first_in_the_document) {
  const json plane = plane_json({0, 0, 3}, {0.1, 0.2, -1});
  expect_first_wins(plane, plane, from_the_camera);
}

TEST(Tie, of_two_meshes_goes_to_the_first_in_the_document) {
  const json mesh = mesh_json({{-3, -3.1, 0.2}, {3, -3.3, 0.9}, {0.1, 4, 0.7}}, {{0, 1, 2}});
  expect_first_wins(mesh, mesh, from_the_camera);
}

TEST(Tie, of_a_plane_and_a_mesh_in_it_goes_to_the_first_in_the_document) {
  // The mesh must not cover the image, or else the plane beside it would be seen: all of it does.
  for (const double z : {0.0, 0.7}) {
    expect_first_wins(plane_json({0, 0, z}, {0, 0, 1}),
                      mesh_json({{-90, -90, z}, {90, -90, z}, {0, 90, z}}, {{0, 1, 2}}),
                      from_the_camera);
  }
}

/// The image is that of the first object alone: nothing coincident shadows it.
void expect_like_alone(const json& object, const json& coincident) {
  const json camera = camera_json(64, 48, 1, {0.25, 1, -5}, {0, 0, 0});
  for (const json& light : {distant_json({-1, -1, 2}), point_json({3, 4, -4}, 300)}) {
    const Image alone = image_of(on_magenta(camera, {object}, light));
    const Image both = image_of(on_magenta(camera, {object, coincident}, light));
    EXPECT_EQ(count_different(alone, both), 0);
    EXPECT_GT(count_lit(alone), 500);
  }
}

TEST(CoincidentSurfaces, do_not_shadow_each_other) {
  const json sphere = sphere_json({0.3, 0.1, 0.7}, 1.7);
  expect_like_alone(sphere, sphere);
  expect_like_alone(sphere, single(sphere));
  const json square = square_json({0.3, 0.1, 0.7}, 0.7, 2);
  expect_like_alone(square, square);
  const json mesh = mesh_json({{-3, -3.1, 0.2}, {3, -3.3, 0.9}, {0.1, 4, 0.7}}, {{0, 1, 2}});
  expect_like_alone(mesh, mesh);
  for (const bool caps : {true, false}) {
    const json cylinder = cylinder_json({-1.3, -0.9, 0.7}, {1.6, 1.1, 0.9}, 0.8, caps);
    expect_like_alone(cylinder, cylinder);
  }
  expect_like_alone(plane_json({0, -1, 3}, {0.1, 1, -0.3}),
                    plane_json({0, -1, 3}, {-0.1, -1, 0.3}));
  expect_like_alone(plane_json({0.1, -1, 0}, {0, 1, 0}), plane_json({-7.3, -1, 1e3}, {0, -3, 0}));
  expect_like_alone(plane_json({0, -0.7, 0}, {0, 1, 0}),
                    mesh_json({{-3.3, -0.7, -3.1}, {3, -0.7, -2.9}, {0.1, -0.7, 4}}, {{0, 1, 2}}));
}

TEST(Mesh, of_a_floor_in_many_triangles_is_lit_like_a_plane) {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
  Random random(60);
  const int side = 12;
  for (int i = 0; i <= side; ++i)
    for (int k = 0; k <= side; ++k)
      vertices.push_back(
          {(i + random.between(-0.3, 0.3)) - 6, -0.7, (k + random.between(-0.3, 0.3)) - 6});
  for (int i = 0; i < side; ++i) {
    for (int k = 0; k < side; ++k) {
      const int corner = i * (side + 1) + k;
      triangles.push_back({corner, corner + 1, corner + side + 2});
      triangles.push_back({corner, corner + side + 1, corner + side + 2});
    }
  }
  const Image image = image_of(on_magenta(camera_json(200, 150, 1, {0.25, 3, -5}, {0, 0, 0}),
                                          {mesh_json(vertices, triangles, constant_material(red))},
                                          point_json({3, 0.1, -4}, 300)));
  EXPECT_EQ(count_color(image, red) + count_color(image, magenta), 200 * 150);
  EXPECT_GT(count_color(image, red), 10'000);
}

/// A ball of flat faces: rings of longitude and latitude around a centre, closed at the poles.
json ball_mesh(const Vec3& center, double radius, int rings) {
  std::vector<Vec3> vertices{center + Vec3{0, radius, 0}, center - Vec3{0, radius, 0}};
  std::vector<std::array<int, 3>> triangles;
  const int around = 2 * rings;
  const auto vertex = [&](int ring, int k) { return 2 + (ring - 1) * around + k % around; };
  for (int ring = 1; ring < rings; ++ring) {
    for (int k = 0; k < around; ++k) {
      const double polar = std::numbers::pi * ring / rings;
      const double turn = std::numbers::pi * k / rings;
      vertices.push_back(center + radius * Vec3{std::sin(polar) * std::cos(turn), std::cos(polar),
                                                std::sin(polar) * std::sin(turn)});
      if (ring == 1) triangles.push_back({0, vertex(1, k), vertex(1, k + 1)});
      if (ring == rings - 1) triangles.push_back({1, vertex(ring, k), vertex(ring, k + 1)});
      if (ring == 1) continue;
      triangles.push_back({vertex(ring - 1, k), vertex(ring, k), vertex(ring, k + 1)});
      triangles.push_back({vertex(ring - 1, k), vertex(ring, k + 1), vertex(ring - 1, k + 1)});
    }
  }
  return mesh_json(vertices, triangles, diffuse_material());
}

TEST(Mesh, that_is_convex_does_not_shadow_itself) {
  // A face of a convex body that is turned towards a light is reached by it.
  for (const int rings : {3, 8, 40}) {
    for (const double radius : {1.0, 1e-3, 1e3}) {
      const Vec3 eye{0.25, 1, -5};
      const Vec3 center = eye + radius * Vec3{-0.1, -0.7, 4.3};
      json text =
          document(camera_json(120, 90, 0.7, eye, center), {ball_mesh(center, radius, rings)},
                   {distant_json({-1, -1, 2}), distant_json({0.3, -1, 0}),
                    point_json(center + radius * Vec3{2, 1, -1}, radius * radius)});
      text["background"] = {0, 0, 1};
      const Image shadowed = image_of(text);
      text["shadows"] = "off";
      text["ambient"] = 0;
      const Image unshadowed = image_of(text);
      EXPECT_EQ(count_different(shadowed, unshadowed, 1e-6), 0) << rings << ' ' << radius;
      EXPECT_GT(count_color(unshadowed, {0, 0, 1}), 1000);
      EXPECT_LT(count_color(unshadowed, {0, 0, 1}), 120 * 90 - 3000);
    }
  }
}

TEST(ConcentricShells, show_the_outer_one_alone_however_close_they_are) {
  const json camera = camera_json(64, 48, 1, {0.25, 1, -5}, {0, 0, 0});
  for (const double inner : {0.5, 0.999, 1 - 1e-6, 1 - 1e-12, 1 - 1e-13}) {
    for (const Vec3& center : {Vec3{0, 0, 0}, Vec3{0.3, 0.1, 0.7}}) {
      for (const json& light : {distant_json({-1, -1, 2}), point_json({3, 4, -4}, 300)}) {
        const json shell = sphere_json(center, 1.3);
        const Image alone = image_of(on_magenta(camera, {shell}, light));
        const Image both =
            image_of(on_magenta(camera, {sphere_json(center, 1.3 * inner), shell}, light));
        EXPECT_EQ(count_different(alone, both), 0) << inner;
      }
    }
  }
}

TEST(ConcentricShells, are_lit_between_them) {
  // The camera and the light are between the two: all that is seen is lit, and one or the other.
  for (const double gap : {0.5, 1e-3, 1e-6}) {
    const Vec3 eye{0, 1 + gap / 2, 0};
    const Image image =
        image_of(on_magenta(camera_json(64, 48, 2, eye, eye + Vec3{1, 0, 0}),
                            {sphere_json({0, 0, 0}, 1, constant_material(red)),
                             sphere_json({0, 0, 0}, 1 + gap, constant_material(green))},
                            point_json(eye, 1)));
    EXPECT_EQ(count_color(image, red) + count_color(image, green), 64 * 48) << gap;
    EXPECT_GT(count_color(image, red), 100) << gap;
    EXPECT_GT(count_color(image, green), 500) << gap;
  }
}

TEST(Sphere, that_touches_a_plane_shadows_its_disc_only) {
  // From above the shadow of the sphere (0, r, 0) is the disc of radius r: at (x, 0, 0).
  for (const double r : {1.0, 0.1, 1e-6}) {
    for (const double share : {0.0001, 0.5, 0.99, 1.01, 1.5}) {
      const Vec3 target{share * r, 0, 0};
      // Looks along the floor, under the sphere's equator.
      const Vec3 eye = target + Vec3{0, 0, -3 * r};
      json text = document(camera_json(1, 1, 1e-4, eye + Vec3{0, 1e-4 * r, 0}, target),
                           {plane_json({0, 0, 0}, {0, 1, 0}, constant_material(red)),
                            sphere_json({0, r, 0}, r, constant_material(green))},
                           {distant_json({0, -1, 0})});
      text["ambient"] = 1;
      EXPECT_EQ(only_color(text), share < 1 ? Vec3{} : red) << r << ' ' << share;
    }
  }
}

TEST(Camera, inside_a_sphere_sees_it_everywhere) {
  for (const double offset : {0.0, 0.5, 0.999, 1 - 1e-9, 1 - 0x1p-53}) {
    const Vec3 eye{0, 0, -offset};
    const Image image = image_of(on_magenta(camera_json(64, 48, 2.5, eye, {0.1, 0, 5}),
                                            {sphere_json({0, 0, 0}, 1, constant_material(red))},
                                            point_json({0, 0, 0.25}, 1)));
    EXPECT_EQ(count_color(image, red), 64 * 48) << offset;
  }
}

TEST(Camera, on_a_sphere_sees_it_on_the_inner_side_only) {
  const std::vector<json> objects{sphere_json({0, 0, 0}, 1, constant_material(red))};
  const json light = point_json({0, 0, 0.25}, 1);
  const Vec3 eye{0, 0, -1};
  const Image inwards =
      image_of(on_magenta(camera_json(64, 48, 2, eye, {0, 0, 0}), objects, light));
  EXPECT_EQ(count_color(inwards, red), 64 * 48);
  const Image outwards =
      image_of(on_magenta(camera_json(64, 48, 2, eye, {0, 0, -2}), objects, light));
  EXPECT_EQ(count_color(outwards, magenta), 64 * 48);
}

TEST(Camera, inside_a_closed_cylinder_sees_it_everywhere) {
  for (const double offset : {0.0, 0.5, 0.999, 1 - 1e-9, 1 - 0x1p-53}) {
    for (const Vec3& eye : {Vec3{0, 0, -offset}, Vec3{0, -offset, 0}, Vec3{0.1, offset, 0.2}}) {
      const Image image = image_of(
          on_magenta(camera_json(64, 48, 2.5, eye, {0.1, 0, 5}),
                     {cylinder_json({0, -1, 0}, {0, 1, 0}, 1, true, constant_material(red))},
                     point_json({0, 0, 0.25}, 1)));
      EXPECT_EQ(count_color(image, red), 64 * 48) << offset;
    }
  }
}

TEST(Camera, on_a_closed_cylinder_sees_it_on_the_inner_side_only) {
  const std::vector<json> objects{
      cylinder_json({0, -1, 0}, {0, 1, 0}, 1, true, constant_material(red))};
  const json light = point_json({0, 0, 0.25}, 1);
  for (const Vec3& eye : {Vec3{0, 0, -1}, Vec3{0, 0.5, -1}, Vec3{1, 0, 0}}) {
    const Vec3 outward{eye.x, 0, eye.z};
    const Image inwards =
        image_of(on_magenta(camera_json(64, 48, 2, eye, eye - outward), objects, light));
    EXPECT_EQ(count_color(inwards, red), 64 * 48);
    const Image outwards =
        image_of(on_magenta(camera_json(64, 48, 2, eye, eye + outward), objects, light));
    EXPECT_EQ(count_color(outwards, magenta), 64 * 48);
  }
}

TEST(Camera, in_an_open_cylinder_looks_out_of_its_ends) {
  const Vec3 eye{0.25, -1, 0};
  const Image image =
      image_of(on_magenta(camera_json(64, 48, 1, eye, {0.25, 9, 0}),
                          {cylinder_json({0, -2, 0}, {0, 3, 0}, 1, false, constant_material(red))},
                          point_json(eye, 1)));
  // The far rim is seen as a circle of a quarter of 1 at distance 1.
  const double pixels_at_1 = 64 / (2 * std::tan(0.5));
  EXPECT_NEAR(count_color(image, magenta), std::numbers::pi * std::pow(pixels_at_1 / 4, 2), 25);
  EXPECT_EQ(count_color(image, red) + count_color(image, magenta), 64 * 48);
}

TEST(Camera, on_a_plane_does_not_see_it) {
  for (const Vec3& look_at : {Vec3{0, 0, 1}, Vec3{0, -1, 1}, Vec3{0, 1, 1}}) {
    const Image image = image_of(on_magenta(
        camera_json(64, 48, 2, {0, 0, 0}, look_at),
        {plane_json({3, 0, 5}, {0, 1, 0}, constant_material(red))}, distant_json({0, -1, 0})));
    EXPECT_EQ(count_color(image, magenta), 64 * 48);
  }
}

TEST(Camera, just_above_a_plane_sees_it_below_the_horizon) {
  for (const double height : {1.0, 1e-6, 1e-12, 1e-100, 1e-300}) {
    const Image image = image_of(on_magenta(
        camera_json(64, 48, 2, {0, height, 0}, {0, height, 1}),
        {plane_json({0, 0, 0}, {0, 1, 0}, constant_material(red))}, distant_json({0.1, -1, 0.3})));
    EXPECT_EQ(count_color(image, red), 64 * 24) << height;
    EXPECT_EQ(count_color(image, magenta), 64 * 24) << height;
  }
}

TEST(Camera, just_above_a_huge_sphere_sees_it_below_the_horizon_and_fully_lit) {
  for (const double radius : {1e3, 6.4e6, 1e9, 1e12}) {
    const double height = std::max(1.7, radius * 1e-14);
    const Image image = image_of(on_magenta(
        camera_json(64, 48, 2, {0, height, 0}, {0, height, 1}),
        {sphere_json({0, -radius, 0}, radius, constant_material(red))}, distant_json({0, -1, 0})));
    EXPECT_EQ(count_color(image, {0, 0, 0}), 0) << radius;
    // The horizon is sqrt(2 h / R) below the middle: under two pixels here.
    EXPECT_LE(count_color(image, red), 64 * 24) << radius;
    EXPECT_GE(count_color(image, red), 64 * 21) << radius;
  }
}

TEST(Camera, inside_a_sphere_of_a_square_sees_it_everywhere) {
  const Image image =
      image_of(on_magenta(camera_json(64, 48, 2, {0.5, 0.1, 0.5}, {3, 0.5, 2}),
                          {square_json({0, 0, 0}, 0.5, 3, "xz", constant_material(red))},
                          point_json({0.5, 0, 0.4}, 1)));
  EXPECT_EQ(count_color(image, red), 64 * 48);
}

}  // namespace
}  // namespace raytracer::test
