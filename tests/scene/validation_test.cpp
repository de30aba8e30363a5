// Every rule that a scene document keeps, once kept and once broken.
//
// A row changes one value of a document that uses every key, so that an error can only come from
// that change; the whole list of errors is compared, so that one cause is reported once.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/scene/full_document.h"

namespace raytracer::test {
namespace {

/// A change, and the errors that it must cause: pointers with a piece of the detail each.
struct Wrong {
  const char* name;
  const char* pointer;
  json value;
  std::vector<std::pair<std::string, std::string>> errors;
};

// NOLINTNEXTLINE(readability-identifier-naming): the name that GoogleTest looks for
void PrintTo(const Wrong& row, std::ostream* out) { *out << row.name; }

class WrongValue : public testing::TestWithParam<Wrong> {};

TEST_P(WrongValue, is_refused_with_its_pointer_and_nothing_else) {
  const Wrong& row = GetParam();
  const std::vector<Error> errors = errors_of(changed(row.pointer, row.value));
  ASSERT_EQ(errors.size(), row.errors.size()) << describe(errors);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    EXPECT_EQ(errors[i].kind, ErrorKind::invalid);
    EXPECT_EQ(errors[i].pointer, row.errors[i].first) << describe(errors);
    EXPECT_NE(errors[i].detail.find(row.errors[i].second), std::string::npos) << describe(errors);
  }
}

/// One error, at the place of the change.
Wrong at(const char* name, const char* pointer, json value, const char* detail) {
  return {name, pointer, std::move(value), {{pointer, detail}}};
}

const char* const number = "must be a number";
const char* const range = "out of range";
const char* const integer = "integer";
const char* const one_each = " for 2 centers: give one number, or one for each";

const std::vector<Wrong> wrong_camera{
    at("CameraMissing", "/camera", missing, "\"camera\" is required"),
    at("CameraNoObject", "/camera", 5, "must be an object"),
    at("OriginMissing", "/camera/origin", missing, "\"origin\" is required"),
    at("OriginText", "/camera/origin", "0,0,0", "three numbers"),
    at("OriginOfTwo", "/camera/origin", {1, 2}, "three numbers"),
    at("OriginOfFour", "/camera/origin", {1, 2, 3, 4}, "three numbers"),
    {"OriginOfTexts", "/camera/origin", {1, "2", 3}, {{"/camera/origin/1", number}}},
    {"OriginOfNulls",
     "/camera/origin",
     {nullptr, 2, nullptr},
     {{"/camera/origin/0", number}, {"/camera/origin/2", number}}},
    at("LookAtMissing", "/camera/look_at", missing, "\"look_at\" is required"),
    at("LookAtIsOrigin", "/camera/look_at", {0, 8, -20}, "origin"),
    {"OriginIsLookAt", "/camera/origin", {0, -1, 0}, {{"/camera/look_at", "origin"}}},
    {"OriginIsLookAtButForTheZerosSign",
     "/camera/origin",
     {-0.0, -1, -0.0},
     {{"/camera/look_at", "origin"}}},
    at("UpZero", "/camera/up", {0, 0, 0}, "zero"),
    at("UpText", "/camera/up", "y", "three numbers"),
    at("FovMissing", "/camera/fov", missing, "\"fov\" is required"),
    at("FovText", "/camera/fov", "1", number),
    at("FovZero", "/camera/fov", 0, "between 0 and pi"),
    at("FovPi", "/camera/fov", 3.141592653589793, "between 0 and pi"),
    at("FovTwoPi", "/camera/fov", 6.283185307179586, "between 0 and pi"),
    at("FovFour", "/camera/fov", 4, "between 0 and pi"),
    at("FovMinusOne", "/camera/fov", -1, "between 0 and pi"),
    at("FovThreePi", "/camera/fov", 9.42477796076938, "between 0 and pi"),
    at("FovFourPi", "/camera/fov", 12.566370614359172, "between 0 and pi"),
    at("FovMinusPi", "/camera/fov", -3.141592653589793, "between 0 and pi"),
    at("WidthMissing", "/camera/width", missing, "\"width\" is required"),
    at("WidthZero", "/camera/width", 0, range),
    at("WidthNegative", "/camera/width", -7, range),
    at("WidthFraction", "/camera/width", 1.5, integer),
    at("WidthText", "/camera/width", "70", integer),
    at("WidthBoolean", "/camera/width", true, integer),
    at("HeightMissing", "/camera/height", missing, "\"height\" is required"),
    at("HeightZero", "/camera/height", 0, range),
    at("HeightFraction", "/camera/height", 49.999, integer),
    at("HeightNull", "/camera/height", nullptr, integer),
};

const std::vector<Wrong> wrong_surroundings{
    at("BackgroundOfTwo", "/background", {0, 0}, "three numbers"),
    {"BackgroundTooBright", "/background", {0, 1.5, 0}, {{"/background/1", range}}},
    {"BackgroundNegative", "/background", {0, 0, -0.1}, {{"/background/2", range}}},
    at("BackgroundNumber", "/background", 0.5, "#rrggbb"),
    at("BackgroundOfAnotherWord", "/background", "Transparent", "\"transparent\""),
    at("AmbientNegative", "/ambient", -0.1, range),
    at("AmbientText", "/ambient", "0.2", number),
    at("AmbientNull", "/ambient", nullptr, number),
    at("ShadowsUnknown", "/shadows", "blak", "\"black\""),
    at("ShadowsUpperCase", "/shadows", "Black", "\"black\""),
    at("ShadowsBoolean", "/shadows", false, "must be a string"),
    at("LightsObject", "/lights", json::object(), "must be an array"),
    at("LightsNull", "/lights", nullptr, "must be an array"),
    at("ObjectsObject", "/objects", json::object(), "must be an array"),
    {"MaterialsText",
     "/materials",
     "red",
     {{"/materials", "must be an object"},
      {"/objects/0/material", "red"},
      {"/objects/1/material", "red"},
      {"/objects/2/material", "red"}}},
    {"MaterialsEmpty",
     "/materials",
     json::object(),
     {{"/objects/0/material", "red"},
      {"/objects/1/material", "red"},
      {"/objects/2/material", "red"}}},
    at("NameNumber", "/name", 5, "must be a string"),
    at("DescriptionArray", "/description", json::array(), "must be a string"),
    at("SchemaNull", "/$schema", nullptr, "must be a string"),
};

const std::vector<Wrong> wrong_lights{
    at("LightNumber", "/lights/0", 1, "must be an object"),
    at("LightTypeMissing", "/lights/0/type", missing, "\"type\" is required"),
    at("LightTypeUnknown", "/lights/0/type", "distand", "\"distant\""),
    at("LightTypeNumber", "/lights/0/type", 3, "must be a string"),
    at("DirectionMissing", "/lights/0/direction", missing, "\"direction\" is required"),
    at("DirectionZero", "/lights/0/direction", {0, 0, 0}, "zero"),
    at("DirectionMinusZero", "/lights/0/direction", {0, -0.0, 0}, "zero"),
    at("DirectionText", "/lights/0/direction", "down", "three numbers"),
    at("PositionMissing", "/lights/1/position", missing, "\"position\" is required"),
    at("PositionOfOne", "/lights/1/position", {5}, "three numbers"),
    at("LightColorShort", "/lights/0/color", "#fff", "#rrggbb"),
    at("LightColorNoHash", "/lights/0/color", "ffffff", "#rrggbb"),
    at("LightColorNoHex", "/lights/0/color", "#gg0000", "#rrggbb"),
    at("LightColorSpace", "/lights/0/color", "#ff 000", "#rrggbb"),
    at("LightColorLong", "/lights/0/color", "#ff000000", "#rrggbb"),
    at("LightColorName", "/lights/0/color", "white", "#rrggbb"),
    {"LightColorTooBright", "/lights/1/color", {2, 0, 0}, {{"/lights/1/color/0", range}}},
    at("IntensityNegative", "/lights/0/intensity", -1, range),
    at("IntensityText", "/lights/1/intensity", "bright", number),
    at("FalloffOther", "/lights/1/falloff", "linear", "\"inverse_square\", \"none\""),
    at("AngleNegative", "/lights/0/angle", -0.1, range),
    at("AngleOfPi", "/lights/0/angle", 3.141592653589793, "below 3.14159"),
    at("LightRadiusNegative", "/lights/1/radius", -1, range),
    at("ReachZero", "/lights/2/reach", 0, range),
    at("ReachText", "/lights/2/reach", "far", number),
};

const std::vector<Wrong> wrong_materials{
    at("MaterialNumber", "/materials/red", 1, "must be an object"),
    {"MaterialColor", "/materials/red/color", {1, 1, 7}, {{"/materials/red/color/2", range}}},
    at("KaAboveOne", "/materials/red/ka", 1.1, range),
    at("KaNegative", "/materials/red/ka", -0.1, range),
    at("KdAboveOne", "/materials/red/kd", 2, range),
    at("KsNegative", "/materials/red/ks", -1e-9, range),
    at("KsText", "/materials/red/ks", "0.3", number),
    at("ShininessNegative", "/materials/red/shininess", -1, range),
    at("ReflectivityAboveOne", "/materials/red/reflectivity", 1.0000001, range),
    at("ReflectivityNegative", "/materials/red/reflectivity", -0.5, range),
    at("TransparencyAboveOne", "/materials/red/transparency", 1.5, range),
    at("IorBelowOne", "/materials/red/ior", 0.99, "at least 1"),
    at("FresnelNumber", "/materials/red/fresnel", 1, "true or false"),
    at("UseUnknown", "/objects/0/material", "rd", "\"red\""),
    at("UseEmptyName", "/objects/0/material", "", "\"red\""),
    at("UseNumber", "/objects/0/material", 1, "name of a material"),
    at("UseNull", "/objects/3/material", nullptr, "name of a material"),
    at("UseArray", "/objects/3/material", {"red"}, "name of a material"),
    at("InPlaceKd", "/objects/4/material/kd", 5, range),
    at("InPlaceColor", "/objects/4/material/color", "#12345", "#rrggbb"),
};

const std::vector<Wrong> wrong_objects{
    at("ObjectText", "/objects/0", "sphere", "must be an object"),
    at("ObjectTypeMissing", "/objects/0/type", missing, "\"type\" is required"),
    at("ObjectTypeUnknown", "/objects/0/type", "shpere", "did you mean \"sphere\""),
    at("ObjectTypeBoolean", "/objects/0/type", true, "must be a string"),
    at("CenterMissing", "/objects/0/center", missing, "\"center\" is required"),
    at("CenterText", "/objects/0/center", "here", "three numbers"),
    at("RadiusMissing", "/objects/0/radius", missing, "\"radius\" is required"),
    at("RadiusZero", "/objects/0/radius", 0, "above 0"),
    at("RadiusNegative", "/objects/0/radius", -2, "above 0"),
    at("RadiusList", "/objects/0/radius", {2}, number),
    at("CentersMissing", "/objects/1/centers", missing, "\"centers\" is required"),
    at("CentersText", "/objects/1/centers", "none", "must be an array"),
    {"CentersOfTwo",
     "/objects/1/centers",
     {{0, 0, 0}, {1, 0}},
     {{"/objects/1/centers/1", "three numbers"}}},
    {"CentersOfTexts",
     "/objects/1/centers",
     {{0, 0, "0"}, {1, 0, 0}},
     {{"/objects/1/centers/0/2", number}}},
    at("RadiiMissing", "/objects/1/radius", missing, "\"radius\" is required"),
    at("RadiiTooFew", "/objects/1/radius", {0.1}, one_each),
    at("RadiiTooMany", "/objects/1/radius", {0.1, 0.2, 0.3}, one_each),
    at("RadiiNone", "/objects/1/radius", json::array(), one_each),
    {"RadiiWithZero", "/objects/1/radius", {0.1, 0}, {{"/objects/1/radius/1", "above 0"}}},
    {"RadiiWithText", "/objects/1/radius", {"0.1", 0.2}, {{"/objects/1/radius/0", number}}},
    at("RadiusOfAllNegative", "/objects/1/radius", -1, "above 0"),
    at("RadiusOfAllText", "/objects/1/radius", "0.1", number),
    at("ColorsTooFew", "/objects/1/colors", {"#102030"}, "for 2 centers: give one for each"),
    at("ColorsTooMany", "/objects/1/colors", {"#102030", "#102030", "#102030"},
       "3 colors for 2 centers: give one for each"),
    at("ColorsNone", "/objects/1/colors", json::array(), "0 colors for 2 centers"),
    at("ColorsOfAll", "/objects/1/colors", "#102030", "must be an array"),
    {"ColorsWithTooMuch",
     "/objects/1/colors",
     {{1, 1, 1}, {0, 1.5, 0}},
     {{"/objects/1/colors/1/1", "from 0 to 1"}}},
    {"ColorsWithText",
     "/objects/1/colors",
     {"red", "#00ff00"},
     {{"/objects/1/colors/0", "#rrggbb"}}},
    at("SquareCenterMissing", "/objects/2/center", missing, "\"center\" is required"),
    at("SquareRadiusZero", "/objects/2/radius", 0, "above 0"),
    at("SquareNMissing", "/objects/2/n", missing, "\"n\" is required"),
    at("SquareNZero", "/objects/2/n", 0, range),
    at("SquareNFraction", "/objects/2/n", 2.5, integer),
    at("SquareNTooLarge", "/objects/2/n", 1000000001, range),
    at("SquareNText", "/objects/2/n", "14", integer),
    at("AxesUnknown", "/objects/2/axes", "zx", "did you mean \"xz\""),
    at("AxesList", "/objects/2/axes", {"x", "z"}, "must be a string"),
    at("PlanePointMissing", "/objects/3/point", missing, "\"point\" is required"),
    at("NormalMissing", "/objects/3/normal", missing, "\"normal\" is required"),
    at("NormalZero", "/objects/3/normal", {0, 0, 0}, "zero"),
    at("TrianglesMissing", "/objects/4/triangles", missing, "\"triangles\" is required"),
    at("TrianglesNumber", "/objects/4/triangles", 1, "must be an array"),
    {"TriangleNumber",
     "/objects/4/triangles",
     {0, 1, 2},
     {{"/objects/4/triangles/0", "must be an array"},
      {"/objects/4/triangles/1", "must be an array"},
      {"/objects/4/triangles/2", "must be an array"}}},
    {"TriangleOfTwo",
     "/objects/4/triangles",
     json::parse("[[0, 1]]"),
     {{"/objects/4/triangles/0", "three indices"}}},
    {"TriangleOfFour",
     "/objects/4/triangles",
     json::parse("[[0, 1, 2, 0]]"),
     {{"/objects/4/triangles/0", "three indices"}}},
    {"TriangleBeyondVertices",
     "/objects/4/triangles",
     json::parse("[[0, 1, 3]]"),
     {{"/objects/4/triangles/0/2", range}}},
    {"TriangleBeforeVertices",
     "/objects/4/triangles",
     json::parse("[[-1, 1, 2]]"),
     {{"/objects/4/triangles/0/0", range}}},
    {"TriangleFraction",
     "/objects/4/triangles",
     json::parse("[[0, 1.5, 2]]"),
     {{"/objects/4/triangles/0/1", integer}}},
    {"TriangleText",
     "/objects/4/triangles",
     json::parse(R"([[0, 1, "2"]])"),
     {{"/objects/4/triangles/0/2", integer}}},
    {"VertexOfTwo",
     "/objects/4/vertices",
     json::parse("[[0, 0, 0], [1, 0], [0, 1, 0]]"),
     {{"/objects/4/vertices/1", "three numbers"}}},
    // One cause, one error: indices into vertices that are not there are no mistakes of their own.
    at("VerticesMissing", "/objects/4/vertices", missing, "\"vertices\" is required"),
    at("VerticesText", "/objects/4/vertices", "none", "must be an array"),
    at("NormalsOfCornersTooFew", "/objects/4/normals", json::parse("[[0, 0, 1]]"),
       "1 vector for 3 vert"),
    {"NormalOfACornerZero",
     "/objects/4/normals",
     {{0, 0, 1}, {0, 0, 0}, {1, 0, 0}},
     {{"/objects/4/normals/1", "no direction"}}},
    at("MeshColorsTooMany", "/objects/4/colors", {"#102030", "#102030", "#102030", "#102030"},
       "4 colors for 3 vertices"),
};

const char* const differ = "must differ from from: the axis has no direction";

const std::vector<Wrong> wrong_cylinders{
    at("FromMissing", "/objects/5/from", missing, "\"from\" is required"),
    at("FromOfTwo", "/objects/5/from", {0, 0}, "three numbers"),
    at("ToMissing", "/objects/5/to", missing, "\"to\" is required"),
    at("ToText", "/objects/5/to", "up", "three numbers"),
    at("ToIsFrom", "/objects/5/to", {0, 0, 0}, differ),
    at("ToIsFromButForTheZerosSign", "/objects/5/to", {0, -0.0, -0.0}, differ),
    {"FromIsTo", "/objects/5/from", {0, 3, 0}, {{"/objects/5/to", differ}}},
    at("RadiusMissing", "/objects/5/radius", missing, "\"radius\" is required"),
    at("RadiusZero", "/objects/5/radius", 0, "above 0"),
    at("RadiusNegative", "/objects/5/radius", -1, "above 0"),
    at("RadiusList", "/objects/5/radius", {0.5}, number),
    at("CapsNumber", "/objects/5/caps", 1, "true or false"),
    at("CapsText", "/objects/5/caps", "true", "true or false"),
    at("CapsNull", "/objects/5/caps", nullptr, "true or false"),
    at("FromsMissing", "/objects/6/from", missing, "\"from\" is required"),
    at("FromsText", "/objects/6/from", "none", "must be an array"),
    {"FromsMore",
     "/objects/6/from",
     {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
     {{"/objects/6/to", "2 points for 3 from: give one for each"},
      {"/objects/6/radius", "2 numbers for 3 from: give one number, or one for each"},
      {"/objects/6/colors", "2 colors for 3 from: give one for each"}}},
    at("TosMissing", "/objects/6/to", missing, "\"to\" is required"),
    at("TosOfOnePoint", "/objects/6/to", json::parse("[[0, 1, 0]]"), "1 point for 2 from"),
    at("TosNone", "/objects/6/to", json::array(), "0 points for 2 from: give one for each"),
    {"TosWithText", "/objects/6/to", {{0, 1, 0}, {1, "2", 0}}, {{"/objects/6/to/1/1", number}}},
    {"SecondToIsItsFrom",
     "/objects/6/to",
     {{0, 1, 0}, {1, 0, 0}},
     {{"/objects/6/to/1", "must differ from item 1 of from"}}},
    {"EveryToIsItsFrom",
     "/objects/6/from",
     {{0, 1, 0}, {1, 2, 0}},
     {{"/objects/6/to/0", "must differ from item 0"},
      {"/objects/6/to/1", "must differ from item 1"}}},
    at("RadiiTooFew", "/objects/6/radius", {0.1}, "1 number for 2 from: give one number, or one"),
    {"RadiiWithZero", "/objects/6/radius", {0.1, 0}, {{"/objects/6/radius/1", "above 0"}}},
    at("RadiusOfAllZero", "/objects/6/radius", 0, "above 0"),
    at("CapsOfEach", "/objects/6/caps", {true, false}, "true or false"),
    at("ColorsTooMany", "/objects/6/colors", {"#102030", "#102030", "#102030"},
       "3 colors for 2 from: give one for each"),
};

const std::vector<Wrong> wrong_render{
    at("RenderArray", "/render", json::array(), "must be an object"),
    at("SamplesZero", "/render/samples", 0, range),
    at("SamplesFraction", "/render/samples", 2.5, integer),
    at("SamplesText", "/render/samples", "4", integer),
    at("TargetWithSamples", "/render/target_rmse", 0.01, "samples"),
    at("BudgetWithSamples", "/render/budget_ms", 100, "samples"),
    at("PrecisionUnknown", "/render/precision", "duoble", "did you mean \"double\""),
    at("PrecisionNumber", "/render/precision", 64, "must be a string"),
    at("MaxDepthNegative", "/render/max_depth", -1, range),
    at("MaxDepthFraction", "/render/max_depth", 0.5, integer),
    at("MaxDepthText", "/render/max_depth", "5", integer),
    at("TransferUnknown", "/render/transfer", "gamma", "\"linear\""),
};

const std::vector<Wrong> wrong_contract{
    {"TargetZero", "/render", {{"target_rmse", 0}}, {{"/render/target_rmse", "above 0"}}},
    {"TargetNegative", "/render", {{"target_rmse", -1}}, {{"/render/target_rmse", "above 0"}}},
    {"TargetText", "/render", {{"target_rmse", "low"}}, {{"/render/target_rmse", number}}},
    {"BudgetZero", "/render", {{"budget_ms", 0}}, {{"/render/budget_ms", "above 0"}}},
    {"BudgetText", "/render", {{"budget_ms", "1s"}}, {{"/render/budget_ms", number}}},
    {"BothWithSamples",
     "/render",
     {{"samples", 2}, {"target_rmse", 0.1}, {"budget_ms", 5}},
     {{"/render/target_rmse", "samples"}, {"/render/budget_ms", "samples"}}},
};

const std::vector<Wrong> unknown_keys{
    at("InRoot", "/lihgts", 1, "did you mean \"lights\""),
    at("InCamera", "/camera/lookat", {0, 0, 0}, "did you mean \"look_at\""),
    at("InDistantLight", "/lights/0/direktion", 1, "did you mean \"direction\""),
    at("InDistantLightOfAPointLight", "/lights/0/position", {0, 0, 0}, "unknown key"),
    at("InPointLight", "/lights/1/intensty", 1, "did you mean \"intensity\""),
    at("InMaterial", "/materials/red/shinines", 1, "did you mean \"shininess\""),
    at("InMaterialInPlace", "/objects/4/material/colour", 1, "did you mean \"color\""),
    at("InSphere", "/objects/0/raduis", 1, "did you mean \"radius\""),
    at("InSphereOfASquare", "/objects/0/axes", "xz", "unknown key"),
    at("InSpheres", "/objects/1/center", 1, "did you mean \"centers\""),
    at("InSquare", "/objects/2/N", 3, "did you mean \"n\""),
    at("InPlane", "/objects/3/norml", 3, "did you mean \"normal\""),
    at("InMesh", "/objects/4/vertexes", 3, "did you mean \"vertices\""),
    at("InCylinder", "/objects/5/cap", true, "did you mean \"caps\""),
    at("InCylinderOfMany", "/objects/5/colors", {"#102030"}, "unknown key"),
    at("InCylinders", "/objects/6/color", {"#102030"}, "did you mean \"colors\""),
    at("InRender", "/render/maxdepth", 3, "did you mean \"max_depth\""),
    at("EmptyKey", "/camera/", 3, "unknown key"),
    at("WithSlash", "/camera/a~1b", 3, "unknown key \"a/b\""),
    at("WithTilde", "/camera/a~0b", 3, "unknown key \"a~b\""),
    at("WithTildeOne", "/camera/~01", 3, "unknown key \"~1\""),
    {"InPlaceOfTheType",
     "/objects/0",
     {{"typ", "sphere"}, {"center", {0, 0, 0}}, {"radius", 1}},
     {{"/objects/0/type", "is required"}, {"/objects/0/typ", "did you mean \"type\""}}},
    {"BesideAnUnknownType",
     "/lights/0",
     {{"type", "distand"}, {"direktion", {0, 0, 1}}},
     {{"/lights/0/type", "\"distant\""}, {"/lights/0/direktion", "did you mean \"direction\""}}},
};

std::string name_of(const testing::TestParamInfo<Wrong>& row) { return row.param.name; }

INSTANTIATE_TEST_SUITE_P(Camera, WrongValue, testing::ValuesIn(wrong_camera), name_of);
INSTANTIATE_TEST_SUITE_P(Surroundings, WrongValue, testing::ValuesIn(wrong_surroundings), name_of);
INSTANTIATE_TEST_SUITE_P(Lights, WrongValue, testing::ValuesIn(wrong_lights), name_of);
INSTANTIATE_TEST_SUITE_P(Materials, WrongValue, testing::ValuesIn(wrong_materials), name_of);
INSTANTIATE_TEST_SUITE_P(Objects, WrongValue, testing::ValuesIn(wrong_objects), name_of);
INSTANTIATE_TEST_SUITE_P(Cylinders, WrongValue, testing::ValuesIn(wrong_cylinders), name_of);
INSTANTIATE_TEST_SUITE_P(Render, WrongValue, testing::ValuesIn(wrong_render), name_of);
INSTANTIATE_TEST_SUITE_P(Contract, WrongValue, testing::ValuesIn(wrong_contract), name_of);
INSTANTIATE_TEST_SUITE_P(UnknownKey, WrongValue, testing::ValuesIn(unknown_keys), name_of);

}  // namespace
}  // namespace raytracer::test
