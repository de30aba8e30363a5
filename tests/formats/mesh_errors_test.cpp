// What is wrong with a mesh is said with its line, and what a scene cannot say of it is told.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "client/failure.h"
#include "tests/formats/read_text.h"

namespace raytracer::test {
namespace {

client::Reading reading_of(const std::string& ending, const std::string& text) {
  return read_text(*client::format_of(ending), text).at(0);
}

/// What reading it throws: that has no line.
std::string refusal(const std::string& ending, const std::string& text) {
  try {
    reading_of(ending, text);
  } catch (const client::InputError& error) {
    return error.what();
  }
  return {};
}

struct MeshMistake {
  std::string text;
  int line;
  std::string says;
};

void expect_errors(const std::string& ending, const std::string& before,
                   const std::vector<MeshMistake>& table, const std::string& after = "") {
  for (const auto& [text, line, says] : table) {
    SCOPED_TRACE(text);
    std::string file = before;
    file.append(text).append(after);
    const auto errors = reading_of(ending, file).errors;
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_EQ(errors[0].line, line);
    EXPECT_NE(errors[0].what.find(says), std::string::npos) << errors[0].what;
  }
}

struct Told {
  std::string one;
  int count;
  int first_line;
};

void expect_told(const client::Reading& reading, const std::vector<Told>& expected) {
  EXPECT_TRUE(reading.errors.empty());
  ASSERT_EQ(reading.omissions.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(reading.omissions[i].one, expected[i].one);
    EXPECT_EQ(reading.omissions[i].count, expected[i].count);
    EXPECT_EQ(reading.omissions[i].first_line, expected[i].first_line);
  }
}

std::size_t triangles_of(const client::Reading& reading) {
  std::size_t count = 0;
  for (const client::model::Objects& objects : reading.scene.objects)
    count += std::get<client::model::Mesh>(objects.shape).triangles.size();
  return count;
}

const std::string obj_corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(MeshErrors, obj_says_line_and_what_to_write) {
  expect_errors(
      ".obj", obj_corners + "f 1 2 3\n",
      {
          {"f 1 2 9", 5, "'9' names number 9 of the vertices, and there are 3; write f V V V"},
          {"\nf -1 -2 -4", 6, "number -4 of the vertices, and there are 3 so far"},
          {"f 1 2 0", 5, "'0' is no corner: OBJ counts from 1"},
          {"f 1 2 x", 5, "'x' is no corner; write f V V V"},
          {"f 1 2 3.5", 5, "'3.5' is no corner"},
          {"f 1 2 3/1/1/1", 5, "'3/1/1/1' is no corner"},
          {"f 1 2 99999999999999999999", 5, "is no corner"},
          {"f 1 2 -9223372036854775808", 5, "of the vertices"},
          {"f 1 \\\n2 x\n", 6, "'x' is no corner"},
          {"vt 0 0\nf 1/1 2/1 3/2", 6, "'3/2' names number 2 of the places of textures"},
          {"vn 0 0 1\nf 1//1 2//1 3//2", 6, "'3//2' names number 2 of the normals"},
          {"l 1 8", 5, "'8' names number 8 of the vertices"},
          {"v 0 0 zero", 5, "'zero' stands where a number is to be; write v X Y Z"},
          {"v 0 0 4x", 5, "'4x' stands where a number is to be"},
          {"v 0 0", 5, "the vertex has 2 numbers; write v X Y Z"},
          {"v 0 0 0 0", 5, "the vertex is divided by 0"},
          {"vn 0 1", 5, "the normal has 2 numbers; write vn X Y Z"},
          {"vt 0 1 0 1", 5, "the place of a texture has 4 numbers; write vt U"},
      });
}

TEST(MeshErrors, obj_counts_lines_as_editors_do) {
  expect_errors(".obj", "v 0 0 0\r\nv 1 0 0\r\n\r\nv 0 1 0\r\n", {{"f 1 2 9\r\n", 5, "'9'"}});
  expect_errors(".obj", "v 0 0 0\rv 1 0 0\rv 0 1 0\r", {{"f 1 2 9\r", 4, "'9'"}});
}

TEST(MeshErrors, all_are_said_up_to_twenty) {
  EXPECT_EQ(reading_of(".obj", obj_corners + "f 1 2 9\nf 1 2 8\nf 1 2 3\n").errors.size(), 2U);
  std::string many = obj_corners;
  for (int i = 0; i < 1000; ++i) many += "f 1 2 9\n";
  EXPECT_EQ(reading_of(".obj", many).errors.size(), 20U);
}

TEST(MeshErrors, obj_that_is_legal_is_read) {
  const std::vector<std::string> legal{
      obj_corners + "f -3 -2 -1\n",
      "f 1 2 3\n" + obj_corners,  // what it names may come later
      obj_corners + "f 1/ 2/ 3/\n",
      obj_corners + "f 1/7 2/8 3/9\n",  // of a file without places of textures
      obj_corners + "vt 0.5\nvt .5 .5\nvn 0 0 1\nf 1/1/1 2/2/1 3/-1/-1 # all\n",
      obj_corners + "vn nan -nan(ind) 1.#IND\nf 1 2 3\n",
      "v 0 0 0 1\nv 1 0 0 1 # with a weight\nv 0 1 0 1\n  f 1 2 3\n",
      "v 0 0 0 1 1 1\nv 1. +0 .0 1 1 1\nv -0e0 1e0 0 1 1 1\nf 1 2 3",
      "v 0 0 0 1 1 1 0.5\nv 1 0 0 .1 1 1 1\nv 0 1 0 1 1\nf 1 2 3",  // an alpha, and one too many
      "\xEF\xBB\xBFv 0 0 0\n\tv 1 0 0\nv 0 \\\n1 0\n# a comment that ends in \\\nf 1 \\\r\n 2 3",
      "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
      obj_corners + "f 1 2 3\nl 1\n",
      "o a\ng b c\ns off\nmg 1 2\nlod 1\n" + obj_corners + "f 1 2 3\n"};
  for (const std::string& text : legal) {
    SCOPED_TRACE(text);
    const client::Reading reading = reading_of(".obj", text);
    ASSERT_TRUE(reading.errors.empty()) << reading.errors[0].what;
    EXPECT_EQ(triangles_of(reading), 1U);
  }
}

TEST(MeshErrors, what_an_obj_has_besides_triangles_is_told) {
  const client::Reading reading =
      reading_of(".obj", obj_corners +
                             "f 1 2 3\nl 1 2\nl 2 3 1\nf 1 2\n"
                             "vp 0 0\ncstype bezier\ndeg 2\ncurv 0 1 1 2 3\nparm u 0 1\nend\n"
                             "foo 1 2 3\ngroupage 7\np 1\np 2 3\n");
  expect_told(reading, {{"line left out", 2, 5},
                        {"face with fewer than three corners left out", 1, 7},
                        {"curve or surface by equations left out", 1, 11},
                        {"statement left out that is not known", 2, 14},
                        {"point beside faces left out", 3, 16}});
  EXPECT_EQ(triangles_of(reading), 1U);
  const std::string steel = "usemtl steel\nf 1 2 3\n";
  expect_told(reading_of(".obj", obj_corners + steel + "usemtl oak\nf 1 2 3\n" + steel),
              {{"material left out that no mtllib says", 2, 4}});
  const client::Reading points = reading_of(".obj", obj_corners + "p 1 2 3\n");
  EXPECT_TRUE(points.omissions.empty());
  EXPECT_EQ(std::get<client::model::Spheres>(points.scene.objects.at(0).shape).radii.size(), 3U);
}

const std::string ply_begin = "ply\nformat ascii 1.0\ncomment c\n";
const std::string ply_vertices =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string ply_faces =
    "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
const std::string ply_header = ply_begin + ply_vertices + ply_faces;

TEST(MeshErrors, ply_says_line_and_what_is_wrong) {
  expect_errors(
      ".ply", ply_header,
      {
          {"0 0 0\n1 0 0\n", 12, "the file ends after 2 of 3 vertices"},
          {"0 0 0\n1 0 0\n0 1 0\n", 13, "the file ends after 0 of 2 faces"},
          {"0 0 0\n\n1 0 0\n0 1 0\n3 0 1 2\n\n", 16, "the file ends after 1 of 2 faces"},
          {"0 0 0\n1 0\n0 1 0\n3 0 1 2\n3 2 1 0", 12, "the line ends where a number is to be"},
          {"0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n3 2 1 0", 12,
           "'x' stands where a number is to be, in 'z' of a vertex"},
          {"0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n3 2 1 0", 14, "'3' is no index of a vertex: there are 3"},
          {"0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n3 2 1 0", 14, "'-1' is no index of a vertex"},
          {"0 0 0\n1 0 0\n0 1 0\n3 0 1\n3 2 1 0", 14,
           "the line ends where the index of a vertex is to be"},
          {"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 b", 15, "'b' stands where the index of a vertex"},
          {"0 0 0\n1 0 0\n0 1 0\n0\n3 2 1 0", 14, "a face without corners"},
          {"0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n-3 2 1 0", 15, "'-3' stands where the number of a list"},
      });
  expect_errors(".ply", ply_begin,
                {
                    {"element vertex many\nend_header\n", 4, "'many' is no number of elements"},
                    {"element vertex 1\nproperty flot x\nend_header\n", 5, "'flot' is no type"},
                    {"property float x\nend_header\n", 4, "a property of no element"},
                    {ply_vertices, 7, "the file ends in its header"},
                });
  const std::string camera = "element camera 1\nproperty float focus\n";
  expect_errors(".ply", ply_begin,
                {
                    {camera + ply_vertices + "end_header\n1\n0 0 0\n1 0 0\n0 1 0\n", 4,
                     "the element camera stands before the vertices"},
                    {ply_vertices + "element tristrips 1\nproperty list int int vertex_indices\n"
                                    "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                     8, "strips of triangles cannot be read"},
                });
}

/// Assimp keeps places in single precision.
TEST(MeshErrors, places_that_are_rounded_are_told) {
  const auto read = [](const std::string& text) {
    return read_text(*client::format_of(".obj"), text).at(0);
  };
  EXPECT_TRUE(read("v 1000 0 0\nv 1001 0 0\nv 1001 1 0\nf 1 2 3\n").omissions.empty());
  const client::Reading far =
      read("v 500000.1 4649776.1 0\nv 500000.4 4649776.1 0\nv 500000.4 4649777 0\nf 1 2 3\n");
  ASSERT_EQ(far.omissions.size(), 1U);
  EXPECT_NE(far.omissions[0].one.find("steps of 0.55"), std::string::npos) << far.omissions[0].one;
  EXPECT_TRUE(read("v 1.000 2.000 3.000\np 1\n").omissions.empty());
  try {
    read("v 1e9 0 0\nv 1000000001 0 0\nv 1000000001 1 0\nf 1 2 3\n");
    FAIL() << "it was read";
  } catch (const client::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("single precision"), std::string::npos);
  }
}

TEST(MeshErrors, ply_that_is_legal_is_read) {
  const std::string other =
      "element vertex 3\nproperty double x\nproperty float32 y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty list uchar float w\n"
      "element face 1\nproperty list uint8 uint32 vertex_index\nproperty float quality\n";
  const std::string body =
      "0 0 0 1 2 3 0\n1. .0 +0 1 2 3 2 0.5 0.5\n\n0 1e0 0 1 2 3 1 nan\n3 0 1 2 7\n";
  const client::Reading reading =
      reading_of(".ply", "ply\nformat ascii 1.0\nobj_info i\n" + other + "end_header\n" + body);
  ASSERT_TRUE(reading.errors.empty()) << reading.errors[0].what;
  EXPECT_EQ(triangles_of(reading), 1U);
  expect_told(reading, {{"property of the vertices left out", 1, 11}});
}

TEST(MeshErrors, what_a_ply_has_besides_triangles_is_told) {
  const client::Reading reading = reading_of(
      ".ply", ply_begin + ply_vertices +
                  "element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\n"
                  "property uchar green\nproperty uchar blue\nelement edge 1\n"
                  "property int vertex1\nproperty int vertex2\nend_header\n"
                  "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n2 0 1 255 0 0\n0 1\n");
  expect_told(reading, {{"colour of a face left out", 2, 10},
                        {"edge left out", 1, 13},
                        {"face with fewer than three corners left out", 1, 21}});
  EXPECT_EQ(triangles_of(reading), 1U);
}

TEST(MeshErrors, properties_of_vertices_that_nothing_is_made_of_are_told) {
  const client::Reading reading =
      reading_of(".ply",
                 "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                 "property float z\nproperty float radius\nproperty uchar alpha\n"
                 "property float quality\nelement face 1\nproperty list uchar int vertex_indices\n"
                 "end_header\n0 0 0 1 9 7\n1 0 0 1 9 7\n0 1 0 1 9 7\n3 0 1 2\n");
  expect_told(reading, {{"property of the vertices left out", 2, 7}});
  EXPECT_EQ(triangles_of(reading), 1U);
}

/// A PLY of three vertices and a face in bytes, of which the last byte comes first if asked for.
std::string binary_ply(bool is_big_endian) {
  std::string text = "ply\nformat binary_" + std::string(is_big_endian ? "big" : "little") +
                     "_endian 1.0\n" + ply_vertices +
                     "element face 1\nproperty list ushort int vertex_indices\nend_header\n";
  const auto add = [&](unsigned value, int bytes) {
    for (int i = 0; i < bytes; ++i)
      text += static_cast<char>(value >> 8 * (is_big_endian ? bytes - 1 - i : i));
  };
  constexpr unsigned one = 0x3F800000;  // as a float
  for (const unsigned number : {0U, 0U, 0U, one, 0U, 0U, 0U, one, 0U}) add(number, 4);
  add(3, 2);
  for (const unsigned corner : {0U, 1U, 2U}) add(corner, 4);
  return text;
}

TEST(MeshErrors, ply_in_bytes_that_is_cut_off_is_refused) {
  for (const bool is_big_endian : {false, true}) {
    const std::string whole = binary_ply(is_big_endian);
    EXPECT_EQ(triangles_of(reading_of(".ply", whole)), 1U);
    EXPECT_EQ(refusal(".ply", whole.substr(0, whole.size() - 1)),
              "the file ends after 0 of 1 faces");
    EXPECT_EQ(refusal(".ply", whole.substr(0, whole.size() - 20)),
              "the file ends after 2 of 3 vertices");
    std::string none = whole.substr(0, whole.size() - 12);  // of its three corners
    none[none.size() - 2] = none.back() = '\0';
    EXPECT_EQ(refusal(".ply", none), "a face without corners cannot be read: leave it out");
  }
}

/// It is a line's end to whoever reads on by lines.
TEST(MeshErrors, ply_in_bytes_may_begin_with_any) {
  const std::string whole = binary_ply(false);
  const std::size_t body = whole.find("end_header\n") + 11;
  for (const char first : {'\n', '\r', ' '}) {
    std::string text = whole;
    text[body] = first;  // a hair from 0
    const client::Reading reading = reading_of(".ply", text);
    ASSERT_EQ(triangles_of(reading), 1U) << int{first};
    EXPECT_EQ(std::get<client::model::Mesh>(reading.scene.objects[0].shape).vertices[1][0], 1);
  }
}

const std::string stl_facet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

TEST(MeshErrors, stl_says_line_and_what_to_write) {
  expect_errors(".stl", "solid s\n" + stl_facet,
                {
                    {"", 8, "the file ends after 1 triangle, without endsolid"},
                    {"facet normal 0 0 1\nouter loop\nvertex 0 0", 11, "the file ends after 1 tri"},
                    {"facet normal 0 0 up\n" + stl_facet.substr(19) + "endsolid s\n", 9,
                     "'up' stands where a number is to be; write facet normal X Y Z"},
                    {"facet norm 0 0 1\n" + stl_facet.substr(19) + "endsolid s\n", 9,
                     "'norm' stands where normal is to be"},
                    {"facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 o\nvertex 0 1 0\n"
                     "endloop\nendfacet\nendsolid s\n",
                     12, "'o' stands where a number is to be; write vertex X Y Z"},
                    {"facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                     "endloop\nendfacet\nendsolid s\n",
                     14, "the facet has 2 vertices"},
                });
}

TEST(MeshErrors, stl_that_is_legal_is_read) {
  std::string in_a_line = "solid s " + stl_facet + "endsolid s";
  for (char& c : in_a_line)
    if (c == '\n') c = ' ';
  for (const std::string& text : {"solid\n" + stl_facet + "endsolid\n",
                                  "solid the facet of \xC3\xBC\r\n" + stl_facet + "endsolid",
                                  " solid s\n\n" + stl_facet + "\t endsolid s\n\n", in_a_line}) {
    SCOPED_TRACE(text);
    const client::Reading reading = reading_of(".stl", text);
    ASSERT_TRUE(reading.errors.empty()) << reading.errors[0].what;
    EXPECT_EQ(triangles_of(reading), 1U);
    EXPECT_TRUE(reading.omissions.empty());
  }
}

TEST(MeshErrors, what_an_stl_has_besides_triangles_is_told) {
  const client::Reading reading =
      reading_of(".stl", "solid s\ncolor 1 0 0\n" + stl_facet + "endsolid s\n");
  expect_told(reading, {{"statement left out that is not known", 1, 2}});
  EXPECT_EQ(triangles_of(reading), 1U);
}

TEST(MeshErrors, stl_in_bytes_that_is_cut_off_is_refused) {
  std::string bytes(84 + 50 * 2, '\0');
  bytes[80] = 3;
  EXPECT_EQ(refusal(".stl", bytes), "the file ends after 2 of 3 triangles");
}

TEST(MeshErrors, gltf_that_is_no_json_says_so) {
  EXPECT_NE(refusal(".gltf", "nothing of the kind").find("not JSON"), std::string::npos);
  expect_errors(".gltf", "{\"asset\": {\"version\": \"2.0\"},\n",
                {
                    {"\"nodes\": [1, 2}", 2, "} stands where ] is to close line 2's"},
                    {"\"nodes\": [1, 2],\n", 2, "the file ends before the } of line 1"},
                    {"\"nodes: [1, 2],\n}", 2, "a string does not end"},
                });
  EXPECT_NE(refusal(".glb", std::string("glTF\2\0\0\0", 8)).find("no binary glTF"),
            std::string::npos);
  EXPECT_NE(
      refusal(".glb", std::string("glTF\2\0\0\0\x40\0\0\0{}", 14)).find("after 14 of 64 bytes"),
      std::string::npos);
  EXPECT_EQ(refusal(".gltf", "{\"nodes\": 1}").find("No suitable reader"), std::string::npos);
}

}  // namespace
}  // namespace raytracer::test
