// What glTF 2.0 says of materials, mirroring nodes and extensions.
#include <gtest/gtest.h>

#include <string>

#include "client/failure.h"
#include "tests/formats/read_text.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

using nlohmann::json;

/// A triangle in z = 0, and three times (0, 0, 1): normals that point out of it, or blue.
json triangle() {
  return json::parse(
      R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
      "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
      "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0,
                                              "baseColorFactor": [1, 0.5, 0.5, 0.25]}}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                     "min": [0, 0, 0], "max": [1, 1, 0]},
                    {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"}],
      "bufferViews": [{"buffer": 0, "byteLength": 36},
                      {"buffer": 0, "byteOffset": 36, "byteLength": 36}],
      "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64,)"
      "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAA"
      R"(AAAAAIA/"}]})");
}

client::Reading read(const json& file) {
  return read_text(*client::format_of(".gltf"), file.dump()).at(0);
}

double transparency_of(const json& file) {
  const client::Reading reading = read(file);
  return reading.scene.materials.at(*reading.scene.objects.at(0).material).transparency;
}

TEST(Gltf, alpha_counts_as_its_mode_says) {
  json file = triangle();
  json& material = file["materials"][0];
  EXPECT_EQ(transparency_of(file), 0);
  material["alphaMode"] = "BLEND";
  EXPECT_EQ(transparency_of(file), 0.75);
  material["alphaMode"] = "MASK";
  EXPECT_THROW(read(file), client::InputError);  // nothing is left of it
  material["alphaCutoff"] = 0.2;
  EXPECT_EQ(transparency_of(file), 0);
}

TEST(Gltf, glass_bends_light_where_it_has_a_volume) {
  json file = triangle();
  file["extensionsUsed"] = {"KHR_materials_transmission", "KHR_materials_volume",
                            "KHR_materials_ior"};
  json& extensions = file["materials"][0]["extensions"];
  extensions["KHR_materials_transmission"]["transmissionFactor"] = 0.75;
  EXPECT_EQ(transparency_of(file), 0.75);
  EXPECT_EQ(read(file).scene.materials.at(0).ior, 1);
  extensions["KHR_materials_volume"]["thicknessFactor"] = 0.1;
  extensions["KHR_materials_ior"]["ior"] = 1.25;
  EXPECT_EQ(read(file).scene.materials.at(0).ior, 1.25);
  extensions["KHR_materials_transmission"]["transmissionFactor"] = 1;
  EXPECT_EQ(transparency_of(file), 1);
}

TEST(Gltf, colours_of_vertices_are_multiplied_with_their_material_s) {
  json file = triangle();
  file["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 1;
  const client::Reading reading = read(file);
  for (const auto& color : std::get<client::model::Mesh>(reading.scene.objects.at(0).shape).colors)
    EXPECT_EQ(color, (client::model::Rgb{0, 0, 0.5F}));
}

TEST(Gltf, node_that_mirrors_leaves_the_outside_outside) {
  json file = triangle();
  file["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1;
  for (const json& scale : {json{1, 1, 1}, json{-1, 1, 1}, json{1, -1, 1}, json{-1, -1, 1}}) {
    file["nodes"][0]["scale"] = scale;
    const client::Reading reading = read(file);
    const auto& mesh = std::get<client::model::Mesh>(reading.scene.objects.at(0).shape);
    const auto corner = [&](std::size_t i) { return mesh.vertices.at(mesh.triangles.at(0)[i]); };
    const auto [ax, ay, az] = corner(0);
    const auto [bx, by, bz] = corner(1);
    const auto [cx, cy, cz] = corner(2);
    EXPECT_GT((bx - ax) * (cy - ay) - (by - ay) * (cx - ax), 0) << scale;
    EXPECT_GT(mesh.normals.at(0)[2], 0) << scale;
  }
}

TEST(Gltf, extensions_that_a_file_requires_are_known_or_it_is_refused) {
  json file = triangle();
  file["extensionsRequired"] = {"KHR_materials_unlit", "KHR_texture_transform"};
  EXPECT_TRUE(read(file).omissions.empty());
  file["extensionsRequired"] = {"EXT_of_somebody"};
  EXPECT_EQ(read(file).omissions.size(), 1U);
  file["extensionsRequired"] = {"KHR_mesh_quantization", "EXT_meshopt_compression"};
  try {
    read(file);
    FAIL() << "it was read";
  } catch (const client::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("KHR_mesh_quantization and EXT_meshopt_compression"),
              std::string::npos)
        << error.what();
  }
}

TEST(Gltf, materials_that_nothing_has_are_not_told_of) {
  json file = triangle();
  file["materials"].push_back({{"emissiveFactor", {1, 1, 1}}});
  EXPECT_TRUE(read(file).omissions.empty());
  file["meshes"][0]["primitives"][0]["material"] = 1;
  EXPECT_EQ(read(file).omissions.size(), 2U);  // it glows, and is a metal if nothing is said
}

TEST(Gltf, names_of_files_are_uris) {
  const TemporaryFolder folder;
  const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  folder.write("my corners.bin",
               std::string(reinterpret_cast<const char*>(corners), sizeof corners));
  json file = triangle();
  file["buffers"] = {{{"byteLength", 36}, {"uri", "my%20corners.bin"}}};
  file["bufferViews"].erase(1);
  file["accessors"].erase(1);
  const std::string path = folder.write("blank.gltf", file.dump());
  const auto scene =
      client::format_of(path)->open({client::source_of_file(path), path}, client::ImportOptions());
  EXPECT_EQ(scene->next_frame().value().scene.objects.size(), 1U);
}

}  // namespace
}  // namespace raytracer::test
