// What lies at the edges of each value's range is accepted.

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "tests/scene/full_document.h"

namespace raytracer::test {
namespace {

/// A change that leaves the document valid.
struct Right {
  const char* name;
  const char* pointer;
  json value;
};

// NOLINTNEXTLINE(readability-identifier-naming): the name that GoogleTest looks for
void PrintTo(const Right& row, std::ostream* out) { *out << row.name; }

class RightValue : public testing::TestWithParam<Right> {};

TEST_P(RightValue, is_accepted) {
  const std::vector<Error> errors = errors_of(changed(GetParam().pointer, GetParam().value));
  EXPECT_TRUE(errors.empty()) << describe(errors);
}

const std::vector<Right> right_values{
    {"TheDocumentItself", "/name", "full"},
    {"UpMissing", "/camera/up", missing},
    {"UpParallelToTheView", "/camera/up", {0, 9, -20}},
    {"UpOfAnyLength", "/camera/up", {0, 1e-300, 0}},
    {"FovTiny", "/camera/fov", 1e-12},
    {"FovJustBelowPi", "/camera/fov", 3.14159265},
    {"FovEightPiThirds", "/camera/fov", 8.377580409572781},
    {"FovMinusFour", "/camera/fov", -4},
    {"FovHundred", "/camera/fov", 101.0},
    {"WidthAsFloat", "/camera/width", 70.0},
    {"BackgroundHex", "/background", "#87ceeb"},
    {"BackgroundMissing", "/background", missing},
    {"BackgroundTransparent", "/background", "transparent"},
    {"AmbientZero", "/ambient", 0},
    {"AmbientLarge", "/ambient", 1e300},
    {"AmbientMissing", "/ambient", missing},
    {"ShadowsAmbient", "/shadows", "ambient"},
    {"ShadowsOff", "/shadows", "off"},
    {"ShadowsMissing", "/shadows", missing},
    {"LightsEmpty", "/lights", json::array()},
    {"LightsMissing", "/lights", missing},
    {"ObjectsEmpty", "/objects", json::array()},
    {"ObjectsMissing", "/objects", missing},
    {"LightColorUpperCase", "/lights/0/color", "#FFEEDD"},
    {"LightColorMissing", "/lights/0/color", missing},
    {"IntensityZero", "/lights/0/intensity", 0},
    {"IntensityMissing", "/lights/1/intensity", missing},
    {"DirectionOfAnyLength", "/lights/0/direction", {0, -1e-200, 0}},
    {"DirectionHuge", "/lights/0/direction", {1.7e308, -1.7e308, 0}},
    {"MaterialEmpty", "/materials/red", json::object()},
    {"MaterialUnused", "/materials/other", json::object()},
    {"MaterialWithAnEmptyName", "/materials/", json::object()},
    {"MaterialAllZero",
     "/materials/red",
     {{"color", {0, 0, 0}},
      {"ka", 0},
      {"kd", 0},
      {"ks", 0},
      {"shininess", 0},
      {"reflectivity", 0}}},
    {"MaterialAllOne",
     "/materials/red",
     {{"color", {1, 1, 1}},
      {"ka", 1},
      {"kd", 1},
      {"ks", 1},
      {"shininess", 1e9},
      {"reflectivity", 1}}},
    {"UseMissing", "/objects/0/material", missing},
    {"UseInPlace", "/objects/0/material", {{"kd", 1}}},
    {"UseEmptyInPlace", "/objects/0/material", json::object()},
    {"RadiusTiny", "/objects/0/radius", 1e-300},
    {"RadiusOfAll", "/objects/1/radius", 0.5},
    {"NoCenters", "/objects/1", {{"type", "spheres"}, {"centers", json::array()}, {"radius", 1}}},
    {"NoCentersNoRadii",
     "/objects/1",
     {{"type", "spheres"}, {"centers", json::array()}, {"radius", json::array()}}},
    {"SquareNLargest", "/objects/2/n", 1000000000},
    {"SquareNAsFloat", "/objects/2/n", 1e9},
    {"AxesXy", "/objects/2/axes", "xy"},
    {"AxesYz", "/objects/2/axes", "yz"},
    {"AxesMissing", "/objects/2/axes", missing},
    {"NormalOfAnyLength", "/objects/3/normal", {0, 0, -1e-300}},
    {"NoTriangles", "/objects/4/triangles", json::array()},
    {"TriangleOfNoArea", "/objects/4/triangles", json::parse("[[0, 0, 1]]")},
    {"TriangleIndexAsFloat", "/objects/4/triangles", json::parse("[[0.0, 1, 2]]")},
    {"CapsMissing", "/objects/5/caps", missing},
    {"CapsOff", "/objects/5/caps", false},
    {"CylinderOfAnyLength", "/objects/5/to", {0, 1e-300, 0}},
    {"CylinderOfAnyRadius", "/objects/5/radius", 1e300},
    {"RadiusOfAllCylinders", "/objects/6/radius", 0.5},
    {"CylindersWithoutColors", "/objects/6/colors", missing},
    {"NoCylinders",
     "/objects/6",
     {{"type", "cylinders"}, {"from", json::array()}, {"to", json::array()}, {"radius", 1}}},
    {"RenderMissing", "/render", missing},
    {"RenderEmpty", "/render", json::object()},
    {"MaxDepthZero", "/render/max_depth", 0},
    {"PrecisionSingle", "/render/precision", "single"},
    {"PrecisionDouble", "/render/precision", "double"},
    {"TransferSrgb", "/render/transfer", "srgb"},
    {"Target", "/render", {{"target_rmse", 0.01}}},
    {"Budget", "/render", {{"budget_ms", 5}}},
    {"TargetAndBudget", "/render", {{"target_rmse", 1e-9}, {"budget_ms", 5.5}}},
    {"NameMissing", "/name", missing},
    {"NameEmpty", "/name", ""},
};

INSTANTIATE_TEST_SUITE_P(All, RightValue, testing::ValuesIn(right_values),
                         [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace raytracer::test
