// The limits of a service, and what a request's query says over the document's own.

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/scenes.h"

namespace raytracer::test {
namespace {

void expect_limit(const std::vector<Error>& errors, const std::string& pointer,
                  const std::string& flag) {
  ASSERT_EQ(errors.size(), 1U) << describe(errors);
  EXPECT_EQ(errors[0].kind, ErrorKind::limit);
  EXPECT_EQ(errors[0].pointer, pointer);
  EXPECT_NE(errors[0].detail.find(flag), std::string::npos) << errors[0].detail;
}

json with_samples(int width, int height, int samples) {
  json text = document(camera_json(width, height));
  text["render"]["samples"] = samples;
  return text;
}

TEST(Limit, of_pixels_is_the_product_and_inclusive) {
  const Limits limits{.pixels = 100};
  EXPECT_TRUE(errors_of(document(camera_json(10, 10)), limits).empty());
  expect_limit(errors_of(document(camera_json(101, 1)), limits), "/camera", "--max-pixels");
  expect_limit(errors_of(document(camera_json(11, 10)), limits), "/camera", "--max-pixels");
}

TEST(Limit, of_pixels_holds_where_their_product_leaves_an_int) {
  json text = document(camera_json(1, 1));
  for (const double side : {65536.0, 2147483648.0, 4294967297.0, 1e15}) {
    text["camera"]["width"] = text["camera"]["height"] = side;
    const std::vector<Error> errors = errors_of(text);
    ASSERT_FALSE(errors.empty()) << side;
    for (const Error& error : errors) EXPECT_EQ(error.kind, ErrorKind::limit) << error.detail;
  }
}

TEST(Limit, of_samples_is_inclusive) {
  const Limits limits{.samples = 16};
  EXPECT_TRUE(errors_of(with_samples(2, 2, 16), limits).empty());
  expect_limit(errors_of(with_samples(2, 2, 17), limits), "/render/samples", "--max-samples");
}

TEST(Limit, of_objects_counts_each_item_of_a_set_and_each_triangle) {
  const std::vector<json> objects = {
      json{{"type", "spheres"}, {"centers", {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}}, {"radius", 1}},
      mesh_json({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {2, 1, 0}}),
      sphere_json({}, 1),
      plane_json({}, {0, 1, 0}),
      square_json({}, 1, 1'000'000'000),
      json{{"type", "cylinder"}, {"from", {0, 0, 0}}, {"to", {0, 1, 0}}, {"radius", 1}},
      json{{"type", "cylinders"},
           {"from", {{1, 0, 0}, {2, 0, 0}}},
           {"to", {{1, 1, 0}, {2, 1, 0}}},
           {"radius", 1}}};
  const json text = document(camera_json(), objects);  // 3 + 2 + 1 + 1 + 1 + 1 + 2
  EXPECT_TRUE(errors_of(text, {.objects = 11}).empty());
  expect_limit(errors_of(text, {.objects = 10}), "/objects", "--max-objects");
}

TEST(Limit, of_lights_is_inclusive) {
  const json text = document(camera_json(), {}, {distant_json({0, 0, 1}), distant_json({0, 1, 0})});
  EXPECT_TRUE(errors_of(text, {.lights = 2}).empty());
  expect_limit(errors_of(text, {.lights = 1}), "/lights", "--max-lights");
}

TEST(Limit, of_work_is_pixels_times_samples) {
  EXPECT_TRUE(errors_of(with_samples(10, 10, 5), {.work = 500}).empty());
  expect_limit(errors_of(with_samples(10, 10, 5), {.work = 499}), "/render", "--max-work");
}

TEST(Limit, of_work_counts_reflections_where_something_reflects) {
  json text = with_samples(10, 10, 1);
  text["render"]["max_depth"] = 4;
  EXPECT_TRUE(errors_of(text, {.work = 100}).empty());
  text["objects"][0] = sphere_json({0, 0, 5}, 1, {{"reflectivity", 0.5}});
  EXPECT_TRUE(errors_of(text, {.work = 500}).empty());
  expect_limit(errors_of(text, {.work = 499}), "/render", "--max-work");
}

TEST(Limit, of_work_counts_rays_that_branch_by_their_weight) {
  json text = with_samples(10, 10, 1);
  const auto expect_rays = [&](double transparency, double reflectivity, int depth,
                               std::int64_t most) {
    text["render"]["max_depth"] = depth;
    text["objects"][0] =
        sphere_json({0, 0, 5}, 1, {{"transparency", transparency}, {"reflectivity", reflectivity}});
    EXPECT_TRUE(errors_of(text, {.work = 100 * most}).empty()) << most;
    expect_limit(errors_of(text, {.work = 100 * most - 1}), "/render", "--max-work");
  };
  expect_rays(0.5, 0, 4, 5);    // one follows one
  expect_rays(0.5, 0.5, 4, 5);  // two weigh as much as the one that they follow
  expect_rays(0.3, 0.6, 20, 21);
  expect_rays(1, 1, 10, 2047);  // and here twice as much
  for (const double weight : {0.5, 0.5000001, 1.0}) {
    text["render"]["max_depth"] = 2'000'000'000;
    text["objects"][0] =
        sphere_json({0, 0, 5}, 1, {{"transparency", weight}, {"reflectivity", weight}});
    expect_limit(errors_of(text), "/render", "--max-work");
  }
}

/// Where nothing branches no ray is left out for its weight.
TEST(Limit, of_work_counts_all_reflections_however_weak) {
  json text = with_samples(3, 3, 1);
  text["render"]["max_depth"] = 1'000'000;
  text["objects"][0] = sphere_json({0, 0, 5}, 1, {{"reflectivity", 0.5}});
  expect_limit(errors_of(text, {.work = 9'000'000}), "/render", "--max-work");
}

TEST(Limit, exceeded_stands_beside_the_documents_errors) {
  json text = with_samples(100, 100, 1);
  text["ambient"] = -1;
  const std::vector<Error> errors = errors_of(text, {.pixels = 100});
  ASSERT_EQ(errors.size(), 2U) << describe(errors);
  EXPECT_EQ(errors[0].pointer, "/ambient");
  EXPECT_EQ(errors[1].kind, ErrorKind::limit);
}

TEST(Limit, rows_name_their_flags) {
  EXPECT_STREQ(row_of(&Limits::pixels).flag, "--max-pixels");
  EXPECT_STREQ(row_of(&Limits::objects).flag, "--max-objects");
  EXPECT_STREQ(row_of(&Limits::lights).flag, "--max-lights");
  EXPECT_STREQ(row_of(&Limits::samples).flag, "--max-samples");
  EXPECT_STREQ(row_of(&Limits::work).flag, "--max-work");
  EXPECT_STREQ(row_of(&Limits::body).flag, "--max-body");
  EXPECT_THROW(row_of(nullptr), std::logic_error);
}

TEST(Override, of_the_size_is_applied_before_the_limits) {
  const json large = document(camera_json(100, 100));
  const json small = document(camera_json(10, 10));
  Overrides to_small;
  to_small.width = to_small.height = 10;
  Overrides to_large;
  to_large.width = 11;
  EXPECT_TRUE(errors_of(large, {.pixels = 100}, to_small).empty());
  expect_limit(errors_of(small, {.pixels = 100}, to_large), "/camera", "--max-pixels");
}

TEST(Override, of_samples_is_applied_before_the_limits) {
  Overrides overrides;
  overrides.samples = 4;
  EXPECT_TRUE(errors_of(with_samples(2, 2, 64), {.samples = 16}, overrides).empty());
  overrides.samples = 64;
  expect_limit(errors_of(with_samples(2, 2, 4), {.samples = 16}, overrides), "/render/samples",
               "--max-samples");
}

TEST(Override, stands_over_the_documents_value) {
  Overrides overrides;
  overrides.width = 3;
  overrides.height = 4;
  overrides.precision = Precision::double_precision;
  overrides.transfer = Transfer::srgb;
  overrides.max_depth = 9;
  overrides.origin = Vec3{1, 2, 3};
  overrides.look_at = Vec3{4, 5, 6};
  overrides.up = Vec3{1, 0, 0};
  overrides.fov = 0.5;
  const Scene scene = scene_of(document(camera_json(70, 50)), overrides);
  EXPECT_EQ(scene.camera.width, 3);
  EXPECT_EQ(scene.camera.height, 4);
  EXPECT_EQ(scene.render.precision, Precision::double_precision);
  EXPECT_EQ(scene.render.transfer, Transfer::srgb);
  EXPECT_EQ(scene.render.max_depth, 9);
  EXPECT_EQ(scene.camera.origin, (Vec3{1, 2, 3}));
  EXPECT_EQ(scene.camera.look_at, (Vec3{4, 5, 6}));
  EXPECT_EQ(scene.camera.up, (Vec3{1, 0, 0}));
  EXPECT_EQ(scene.camera.fov, 0.5);
}

TEST(Override, of_samples_drops_the_documents_contracts) {
  json text = document();
  text["render"] = {{"target_rmse", 0.01}, {"budget_ms", 50}};
  Overrides overrides;
  overrides.samples = 4;
  const Scene scene = scene_of(text, overrides);
  EXPECT_EQ(scene.render.samples, 4);
  EXPECT_FALSE(scene.render.target_rmse);
  EXPECT_FALSE(scene.render.budget_ms);
}

TEST(Override, of_a_contract_drops_the_documents_samples) {
  Overrides target;
  target.target_rmse = 0.5;
  Overrides budget;
  budget.budget_ms = 7;
  const Scene by_target = scene_of(with_samples(2, 2, 4), target);
  EXPECT_FALSE(by_target.render.samples);
  EXPECT_EQ(by_target.render.target_rmse, 0.5);
  const Scene by_budget = scene_of(with_samples(2, 2, 4), budget);
  EXPECT_FALSE(by_budget.render.samples);
  EXPECT_EQ(by_budget.render.budget_ms, 7);
}

TEST(Override, of_one_contract_keeps_the_documents_other) {
  json text = document();
  text["render"] = {{"target_rmse", 0.01}, {"budget_ms", 50}};
  Overrides target;
  target.target_rmse = 0.5;
  const Scene scene = scene_of(text, target);
  EXPECT_EQ(scene.render.target_rmse, 0.5);
  EXPECT_EQ(scene.render.budget_ms, 50);
}

struct WrongOverride {
  const char* name;
  const char* pointer;
  void (*set)(Overrides&);
};

// NOLINTNEXTLINE(readability-identifier-naming): the name that GoogleTest looks for
void PrintTo(const WrongOverride& row, std::ostream* out) { *out << row.name; }

class OverrideOutOfRange : public testing::TestWithParam<WrongOverride> {};

TEST_P(OverrideOutOfRange, is_refused_like_the_documents) {
  Overrides overrides;
  GetParam().set(overrides);
  const std::vector<Error> errors = errors_of(document(), {}, overrides);
  ASSERT_EQ(errors.size(), 1U) << describe(errors);
  EXPECT_EQ(errors[0].kind, ErrorKind::invalid);
  EXPECT_EQ(errors[0].pointer, GetParam().pointer);
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    All, OverrideOutOfRange,
    testing::Values(
        WrongOverride{"WidthZero", "/camera/width", [](Overrides& o) { o.width = 0; }},
        WrongOverride{"HeightNegative", "/camera/height", [](Overrides& o) { o.height = -5; }},
        WrongOverride{"SamplesZero", "/render/samples", [](Overrides& o) { o.samples = 0; }},
        WrongOverride{"TargetZero", "/render/target_rmse", [](Overrides& o) { o.target_rmse = 0; }},
        WrongOverride{"TargetNaN", "/render/target_rmse",
                      [](Overrides& o) { o.target_rmse = nan; }},
        WrongOverride{"BudgetNegative", "/render/budget_ms",
                      [](Overrides& o) { o.budget_ms = -1; }},
        WrongOverride{"MaxDepthNegative", "/render/max_depth",
                      [](Overrides& o) { o.max_depth = -1; }},
        WrongOverride{"UpZero", "/camera/up", [](Overrides& o) { o.up = Vec3{}; }},
        WrongOverride{"UpNaN", "/camera/up",
                      [](Overrides& o) {
                        o.up = Vec3{0, nan, 0};
                      }},
        WrongOverride{"FovPi", "/camera/fov", [](Overrides& o) { o.fov = 3.141592653589793; }},
        WrongOverride{"FovInfinite", "/camera/fov", [](Overrides& o) { o.fov = infinity; }},
        WrongOverride{"LookAtIsOrigin", "/camera/look_at",
                      [](Overrides& o) { o.look_at = Vec3{}; }},
        WrongOverride{"OriginIsLookAt", "/camera/look_at",
                      [](Overrides& o) {
                        o.origin = Vec3{0, 0, 1};
                      }},
        WrongOverride{"OriginInfinite", "/camera/origin",
                      [](Overrides& o) {
                        o.origin = Vec3{infinity, 0, 0};
                      }},
        WrongOverride{"LookAtNaN", "/camera/look_at",
                      [](Overrides& o) {
                        o.look_at = Vec3{0, nan, 0};
                      }}),
    [](const auto& row) { return row.param.name; });

TEST(Override, does_not_heal_an_invalid_document) {
  json text = document();
  text["camera"]["width"] = 0;
  Overrides overrides;
  overrides.width = 10;
  const std::vector<Error> errors = errors_of(text, {}, overrides);
  ASSERT_EQ(errors.size(), 1U);
  EXPECT_EQ(errors[0].pointer, "/camera/width");
}

}  // namespace
}  // namespace raytracer::test
