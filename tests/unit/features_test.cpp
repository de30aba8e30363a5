// What of shading and geometry a scene needs: what no pixel can show does not count.
#include "engine/scene/features.h"

#include <gtest/gtest.h>

#include "engine/scene/scene.h"
#include "tests/support/edit.h"

namespace raytracer::test {
namespace {

/// A sphere under a distant light; material 0 is matt and specular, 1 is a mirror that nothing
/// is made of.
Scene lit_sphere() {
  Scene scene;
  scene.camera = {.origin = {0, 0, -5}, .look_at = {}, .fov = 1, .width = 8, .height = 8};
  scene.lights = {{DistantLight{{0, -1, 1}}}};
  Material mirror;
  mirror.shininess = 3.5;
  mirror.reflectivity = 0.9;
  scene.materials = {Material{}, mirror};
  scene.objects = {{Sphere{{0, 0, 0}, 1}, 0}};
  return scene;
}

TEST(Features, count_primitives_by_kind) {
  Scene scene = lit_sphere();
  append(scene.objects, {Spheres{{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {0.1}, {}}, 0});
  append(scene.objects, {SphereSquare{{0, -3, 0}, 1, 1000, Axes::xz}, 0});
  append(scene.objects, {Plane{{0, -9, 0}, {0, 1, 0}}, 0});
  append(scene.objects,
         {Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}, {}, {}}, 0});
  const Features features = find_features(scene);
  EXPECT_EQ(features.primitives[kind_index<SphereKind>], 4U);
  EXPECT_EQ(features.primitives[kind_index<LatticeKind>], 1U);
  EXPECT_EQ(features.primitives[kind_index<PlaneKind>], 1U);
  EXPECT_EQ(features.primitives[kind_index<TriangleKind>], 2U);
}

/// Of a scene where all are the same.
IntegerExponents only(std::uint32_t exponent) { return {true, exponent, exponent}; }

TEST(Features, know_integers_that_are_small) {
  EXPECT_EQ(find_integer_exponents({0}), only(0));
  EXPECT_EQ(find_integer_exponents({4096}), only(4096));
  EXPECT_EQ(find_integer_exponents({1, 6, 3}), (IntegerExponents{true, 7, 0}));
  EXPECT_FALSE(find_integer_exponents({}).are_all);
  EXPECT_FALSE(find_integer_exponents({2, 4097}).are_all);
  EXPECT_FALSE(find_integer_exponents({2, 0.5}).are_all);
}

TEST(Features, leave_out_a_material_that_nothing_is_made_of) {
  const Features features = find_features(lit_sphere());
  EXPECT_EQ(features.materials, 1U);
  EXPECT_FALSE(features.reflects);
  EXPECT_EQ(features.max_depth, 0);
  EXPECT_EQ(features.reflectivity, 0);
  EXPECT_EQ(features.integer_shininess, only(50)) << "the mirror's 3.5 is nobody's";
}

TEST(Features, leave_out_the_material_of_an_empty_set) {
  Scene scene = lit_sphere();
  append(scene.objects, {Spheres{{}, {1}, {}}, 1});
  append(scene.objects, {Mesh{}, 1});
  EXPECT_FALSE(find_features(scene).reflects);
  EXPECT_EQ(find_features(scene).materials, 1U);
}

TEST(Features, count_a_material_once_whatever_colours_objects_bring) {
  Scene scene = lit_sphere();
  edit(scene.materials, [](auto& materials) { materials[0].color = {}; });
  EXPECT_FALSE(find_features(scene).has_specular);
  append(scene.objects, {Spheres{{{1, 0, 0}}, {0.1}, {{0, 0, 0}}}, 0});
  EXPECT_FALSE(find_features(scene).has_specular) << "black again";
  append(scene.objects, {Spheres{{{1, 0, 0}, {2, 0, 0}}, {0.1}, {{0, 0, 0}, {0, 1, 0}}}, 0});
  append(scene.objects, {Spheres{{{3, 0, 0}}, {0.1}, {{1, 0, 0}}}, 0});
  EXPECT_TRUE(find_features(scene).has_specular);
  EXPECT_EQ(find_features(scene).materials, 1U);
}

TEST(Features, count_a_mirror_that_is_used) {
  Scene scene = lit_sphere();
  edit(scene.objects, [](auto& objects) { objects[0].material = 1; });
  const Features features = find_features(scene);
  EXPECT_TRUE(features.reflects);
  EXPECT_EQ(features.max_depth, 5);
  EXPECT_EQ(features.reflectivity, 0.9);
  EXPECT_FALSE(features.integer_shininess.are_all) << "3.5 is no integer";
}

TEST(Features, tell_glass_from_mirrors) {
  Scene scene = lit_sphere();
  Material glass;
  glass.transparency = 0.75;
  edit(scene.materials, [&](auto& materials) { materials[0] = glass; });
  const Features features = find_features(scene);
  EXPECT_TRUE(features.transmits);
  EXPECT_EQ(features.transparency, 0.75);
  EXPECT_FALSE(features.reflects);
  EXPECT_EQ(features.max_depth, 5);
  scene.render.max_depth = 0;
  EXPECT_TRUE(find_features(scene).transmits) << "light comes through it";
}

TEST(Features, leave_out_mirrors_when_no_ray_may_be_reflected) {
  Scene scene = lit_sphere();
  edit(scene.objects, [](auto& objects) { objects[0].material = 1; });
  scene.render.max_depth = 0;
  EXPECT_FALSE(find_features(scene).reflects);
}

TEST(Features, leave_out_highlights_where_nothing_shows_them) {
  Scene without_ks = lit_sphere();
  edit(without_ks.materials, [](auto& materials) { materials[0].ks = 0; });
  EXPECT_FALSE(find_features(without_ks).has_specular);
  EXPECT_EQ(find_features(without_ks).shininess, 0);
  EXPECT_TRUE(find_features(without_ks).has_diffuse);

  Scene dark = lit_sphere();
  edit(dark.lights, [](auto& lights) { lights[0].intensity = 0; });
  EXPECT_FALSE(find_features(dark).has_specular);
  EXPECT_FALSE(find_features(dark).has_diffuse);

  Scene black = lit_sphere();
  edit(black.materials, [](auto& materials) { materials[0].color = {0, 0, 0}; });
  EXPECT_FALSE(find_features(black).has_specular);
}

TEST(Features, ask_only_the_specular_for_integer_exponents) {
  Scene scene = lit_sphere();
  append(scene.objects, {Sphere{{3, 0, 0}, 1}, 1});
  EXPECT_FALSE(find_features(scene).integer_shininess.are_all);
  edit(scene.materials, [](auto& materials) { materials[1].shininess = 48; });
  EXPECT_EQ(find_features(scene).integer_shininess, (IntegerExponents{true, 50, 48}));
  edit(scene.materials, [](auto& materials) { materials[1].ks = 0; });
  EXPECT_EQ(find_features(scene).integer_shininess, only(50));
}

TEST(Features, leave_out_a_light_that_changes_no_colour) {
  Scene scene = lit_sphere();
  append(scene.lights, {PointLight{{0, 9, 0}}, {1, 1, 1}, 0});
  scene.shadows = Shadows::ambient;
  EXPECT_EQ(find_features(scene).light_count(LightRays::converging), 0U);
  scene.shadows = Shadows::black;
  EXPECT_EQ(find_features(scene).light_count(LightRays::converging), 1U)
      << "it brings the ambient part";
  scene.ambient = 0;
  EXPECT_EQ(find_features(scene).light_count(LightRays::converging), 0U);
  EXPECT_FALSE(find_features(scene).has_ambient);
}

TEST(Features, cast_shadows_only_under_lights_that_have_some) {
  Scene scene = lit_sphere();
  EXPECT_TRUE(find_features(scene).casts_shadows);
  scene.shadows = Shadows::off;
  EXPECT_FALSE(find_features(scene).casts_shadows);
  scene.shadows = Shadows::black;
  scene.lights = {};
  EXPECT_FALSE(find_features(scene).casts_shadows);
  EXPECT_FALSE(find_features(scene).has_ambient) << "what no light reaches is black";
}

TEST(Features, of_nothing_are_none) {
  const Features features = find_features(Scene{});
  EXPECT_EQ(features.materials, 0U);
  EXPECT_EQ(features.light_count(), 0U);
  EXPECT_FALSE(features.casts_shadows || features.has_ambient || features.has_diffuse ||
               features.has_specular || features.reflects);
}

}  // namespace
}  // namespace raytracer::test
