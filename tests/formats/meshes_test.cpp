// Meshes and clouds of points, as assimp reads them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <numbers>
#include <string>
#include <thread>

#include "client/failure.h"
#include "client/formats/meshes/own_process.h"
#include "tests/formats/read_text.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

using nlohmann::json;

json document_of_file(const std::string& name) {
  const std::filesystem::path path =
      std::filesystem::path(RAYTRACER_SOURCE_DIR) / "tests/formats/files" / name;
  return document(path.extension().string(), read_file(path));
}

TEST(Meshes, torus_keeps_normals_colours_and_common_corners) {
  const json ply = document_of_file("torus.ply").at("objects")[0];
  EXPECT_EQ(ply.at("vertices").size(), 96U);
  EXPECT_EQ(ply.at("normals").size(), 96U);
  EXPECT_EQ(ply.at("colors").size(), 96U);
  EXPECT_EQ(ply.at("triangles").size(), 192U);
  const json obj = document_of_file("torus.obj").at("objects")[0];
  EXPECT_EQ(obj.at("vertices").size(), 96U);
  EXPECT_EQ(obj.at("normals").size(), 96U);
  EXPECT_FALSE(obj.contains("colors"));
}

TEST(Meshes, numbers_of_an_obj_may_begin_with_their_point) {
  const std::string text = "v 0 .5 0\nv 1 .5 -.5\nv 1 1 .25\nf 1 2 3\n";
  const json corners = json::parse("[[0, 0.5, 0], [-1, 0.5, -0.5], [-1, 1, 0.25]]");
  EXPECT_EQ(document(".obj", text).at("objects")[0].at("vertices"), corners);
  const TemporaryFolder folder;
  const std::string path = folder.write("bare.obj", text);
  const auto file =
      client::format_of(path)->open({client::source_of_file(path), path}, client::ImportOptions());
  const client::Reading reading = file->next_frame().value();
  EXPECT_EQ(reading.scene.objects.size(), 1U);
}

TEST(Meshes, materials_of_an_obj_shine_as_their_file_says_and_what_is_lost_is_told) {
  const TemporaryFolder folder;
  folder.write("there.mtl", "newmtl a\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 80\nKe 1 0 0\n");
  const auto reading_of = [&](const std::string& library) {
    const std::string path = folder.write(
        "one.obj", "mtllib " + library + "\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    return client::format_of(path)
        ->open({client::source_of_file(path), path}, client::ImportOptions())
        ->next_frame()
        .value();
  };
  const client::Reading there = reading_of("there.mtl");
  const client::model::Material& material =
      there.scene.materials.at(there.scene.objects.at(0).material.value());
  EXPECT_EQ(material.ks, 0.5);
  EXPECT_EQ(material.shininess, 80);
  ASSERT_EQ(there.omissions.size(), 1U);
  EXPECT_NE(there.omissions[0].one.find("glows"), std::string::npos);
  const client::Reading missing = reading_of("missing.mtl");
  ASSERT_EQ(missing.omissions.size(), 1U);
  EXPECT_NE(missing.omissions[0].one.find("not found"), std::string::npos);
}

TEST(Meshes, mistake_in_a_file_of_materials_is_told_with_its_place) {
  const TemporaryFolder folder;
  const auto reading_with = [&](const std::string& materials) {
    folder.write("paints.mtl", materials);
    const std::string path = folder.write("one.obj",
                                          "v 0 0 0\nv 1 0 0\nv 0 1 0\nmtllib paints.mtl\n"
                                          "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n");
    return client::format_of(path)
        ->open({client::source_of_file(path), path}, client::ImportOptions())
        ->next_frame()
        .value();
  };
  const std::string right = "newmtl a\nKd 1 .5 0\nKs 0.5\nNs 80 \nd 1\nillum 2\n";
  struct Mistake {
    std::string statement;
    std::string says;
  };
  for (const auto& [statement, says] : std::vector<Mistake>{
           {"Kd red 0 0", "paints.mtl:8: 'red' stands where a number is to be; write Kd R G B"},
           {"Ks 1 1", "paints.mtl:8: Ks has 2 numbers; write Ks R G B"},
           {"Ns", "paints.mtl:8: Ns has 0 numbers; write Ns EXPONENT"},
           {"d -halo 0.5",
            "paints.mtl:8: '-halo' stands where a number is to be; write d OPACITY"}}) {
    const client::Reading reading = reading_with(right + "newmtl b\n" + statement + "\n");
    ASSERT_EQ(reading.errors.size(), 1U) << statement;
    EXPECT_EQ(reading.errors[0].what, says);
    EXPECT_EQ(reading.errors[0].line, 4);
  }
  for (const std::string& harmless :
       {std::string("newmtl b\nfoo bar\nmap_Kd b.png\n"), std::string("newmtl  b \nillum two\n")}) {
    const client::Reading reading = reading_with(right + harmless);
    EXPECT_TRUE(reading.errors.empty()) << reading.errors[0].what;
  }
  // A material that the file does not have.
  const client::Reading reading = reading_with(right);
  ASSERT_EQ(reading.omissions.size(), 1U);
  EXPECT_EQ(reading.omissions[0].one, "material left out that no mtllib says");
  EXPECT_EQ(reading.omissions[0].first_line, 7);
}

TEST(Meshes, glass_of_an_obj_bends_light_if_its_model_of_illumination_does) {
  const TemporaryFolder folder;
  const auto ior_of = [&](const std::string& statements) {
    folder.write("glass.mtl", "newmtl a\nKd 1 1 1\nNi 1.5\n" + statements);
    const std::string path =
        folder.write("one.obj", "mtllib glass.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const client::Reading reading = client::format_of(path)
                                        ->open({client::source_of_file(path), path}, {})
                                        ->next_frame()
                                        .value();
    return reading.scene.materials.at(reading.scene.objects.at(0).material.value()).ior;
  };
  EXPECT_EQ(ior_of("d 0.25\nillum 6\n"), 1.5);
  EXPECT_EQ(ior_of("d 0.25\nillum 7\n"), 1.5);
  EXPECT_EQ(ior_of("d 0.25\nillum 4\n"), 1) << "glass without refraction";
  EXPECT_EQ(ior_of("d 0.25\n"), 1);
  EXPECT_EQ(ior_of("illum 7\n"), 1) << "nothing passes it";
}

/// As a compressed file has it.
std::string packed(const std::string& text) {
  std::string bytes(ZSTD_compressBound(text.size()), '\0');
  bytes.resize(ZSTD_compress(bytes.data(), bytes.size(), text.data(), text.size(), 1));
  return bytes;
}

TEST(Meshes, files_that_a_compressed_one_names_lie_beside_it) {
  const TemporaryFolder folder;
  const auto reading_of = [&](const std::string& name, const std::string& text) {
    const std::string path = folder.write(name, packed(text));
    return client::format_of(path)
        ->open({client::source_of_file(path), path}, client::ImportOptions())
        ->next_frame()
        .value();
  };
  folder.write("there.mtl", "newmtl a\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 80\n");
  const std::string shape = "usemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const client::Reading obj = reading_of("one.obj.zst", "mtllib there.mtl\n" + shape);
  EXPECT_EQ(obj.scene.materials.at(obj.scene.objects.at(0).material.value()).shininess, 80);
  EXPECT_TRUE(obj.omissions.empty());
  const client::Reading missing = reading_of("two.obj.zst", "mtllib missing.mtl\n" + shape);
  ASSERT_EQ(missing.omissions.size(), 1U);
  EXPECT_NE(missing.omissions[0].one.find("not found"), std::string::npos);

  const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string bytes(reinterpret_cast<const char*>(corners), sizeof corners);
  const std::string gltf = R"({"asset": {"version": "2.0"}, "scene": 0,
      "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                     "min": [0, 0, 0], "max": [1, 1, 0]}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "buffers": [{"uri": "corners.bin", "byteLength": 36}]})";
  EXPECT_THROW(reading_of("one.gltf.zst", gltf), client::InputError);
  folder.write("corners.bin", bytes);
  EXPECT_EQ(reading_of("one.gltf.zst", gltf).scene.objects.size(), 1U);
}

TEST(Meshes, file_without_a_folder_has_none_beside_it) {
  const std::string text = "mtllib there.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const client::Reading reading = read_text(*client::format_of(".obj"), text).at(0);
  ASSERT_EQ(reading.omissions.size(), 1U);
  EXPECT_NE(reading.omissions[0].one.find("not found"), std::string::npos);
}

TEST(Meshes, stl_is_flat) {
  const json mesh = document_of_file("tetrahedron.stl").at("objects")[0];
  EXPECT_EQ(mesh.at("vertices").size(), 4U);
  EXPECT_FALSE(mesh.contains("normals"));
}

TEST(Meshes, gltf_stands_where_its_nodes_say_in_its_colour) {
  for (const char* const name : {"pyramids.gltf", "pyramids.glb"}) {
    const json scene = document_of_file(name);
    double highest = 0;
    std::size_t triangles = 0;
    for (const json& object : scene.at("objects")) {
      triangles += object.at("triangles").size();
      for (const json& vertex : object.at("vertices"))
        highest = std::max(highest, vertex[1].get<double>());
    }
    EXPECT_EQ(triangles, 12U);
    EXPECT_EQ(highest, 3);  // of the one that is twice as high
    const json& object = scene.at("objects")[0];
    const json& color =
        scene.at("materials").at(object.at("material").get<std::string>()).at("color");
    EXPECT_NEAR(color[0].get<double>(), 0.7, 1e-6);
  }
}

/// A triangle in front of what `nodes` say, with one camera and three lights to refer to.
json staged(const std::string& nodes, const std::string& roots) {
  const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const TemporaryFolder folder;
  folder.write("corners.bin", std::string(reinterpret_cast<const char*>(corners), sizeof corners));
  const std::string path = folder.write("stage.gltf", R"({"asset": {"version": "2.0"},
      "scene": 0, "extensionsUsed": ["KHR_lights_punctual"],
      "extensions": {"KHR_lights_punctual": {"lights": [
        {"type": "directional", "intensity": 300},
        {"type": "point", "color": [1, 0.5, 0], "intensity": 5000},
        {"type": "spot", "intensity": 5000, "spot": {}}]}},
      "cameras": [
        {"type": "perspective", "perspective": {"yfov": 0.7, "aspectRatio": 3, "znear": 0.1}},
        {"type": "orthographic",
         "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 9}}],
      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
      "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                     "min": [0, 0, 0], "max": [1, 1, 0]}],
      "bufferViews": [{"buffer": 0, "byteLength": 36}],
      "buffers": [{"uri": "corners.bin", "byteLength": 36}],
      "scenes": [{"nodes": )" + roots + R"(}], "nodes": [{"mesh": 0}, )" +
                                                          nodes + "]}");
  const auto file =
      client::format_of(path)->open({client::source_of_file(path), path}, client::ImportOptions());
  const client::Reading reading = file->next_frame().value();
  json document = json::parse(to_document(reading.scene));
  for (const client::Omission& kind : reading.omissions) document["told"][kind.one] = kind.count;
  return document;
}

void expect_near(const json& vector, const std::array<double, 3>& expected) {
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(vector[i].get<double>(), expected[i], 1e-12) << vector;
}

TEST(Meshes, gltf_is_seen_through_its_own_camera) {
  // A quarter turn round y: towards -x.
  const json scene = staged(
      R"({"translation": [5, 0, 0], "rotation": [0, 0.7071067811865476, 0, 0.7071067811865476],
          "children": [2]}, {"translation": [0, 0, 2], "camera": 0}, {"camera": 1}, {"camera": 0})",
      "[0, 1, 3, 4]");
  const json& camera = scene.at("camera");
  expect_near(camera.at("origin"), {-7, 0, 0});
  expect_near(camera.at("look_at"), {-0.5, 0, 0});
  expect_near(camera.at("up"), {0, 1, 0});
  EXPECT_NEAR(camera.at("fov").get<double>(), 2 * std::atan(std::tan(0.35) * 1.4), 1e-12);
  EXPECT_EQ(scene.at("told").at("camera left out"), 2);
}

TEST(Meshes, gltf_has_its_lights_in_their_proportions) {
  const std::string nodes = R"(
      {"extensions": {"KHR_lights_punctual": {"light": 0}}},
      {"translation": [0, 0, 10], "extensions": {"KHR_lights_punctual": {"light": 1}}},
      {"matrix": [1,0,0,0, 0,0,-1,0, 0,1,0,0, 2,3,4,1],
       "extensions": {"KHR_lights_punctual": {"light": 1}}},
      {"translation": [1, 0, 0], "extensions": {"KHR_lights_punctual": {"light": 2}}})";
  const json lights = staged(nodes, "[0, 1, 2, 3, 4]").at("lights");
  ASSERT_EQ(lights.size(), 4U);
  expect_near(lights[0].at("direction"), {0, 0, -1});
  expect_near(lights[1].at("position"), {0, 0, 10});
  expect_near(lights[1].at("color"), {1, 0.5, 0});
  EXPECT_EQ(lights[1].at("falloff"), "inverse_square");
  expect_near(lights[2].at("position"), {-2, 3, 4});
  EXPECT_NEAR(lights[1].at("intensity").get<double>() / lights[0].at("intensity").get<double>(),
              4 * std::numbers::pi * 5000 / 300, 1e-9);
  EXPECT_EQ(staged(nodes, "[0, 4]").at("told").at("spot light shines to all sides"), 1);
  EXPECT_EQ(staged(nodes, "[0, 1]").at("lights")[0].at("intensity"), 0.9);
  EXPECT_EQ(staged(nodes, "[0]").at("lights")[1].at("type"), "sky");
}

TEST(Meshes, gltf_whose_camera_or_lights_make_no_sense_is_seen_without) {
  const std::string steep = R"({"camera": 0, "matrix": [1,0,0,0, 0,0,1,0, 0,0,1,0, 0,0,5,1]})";
  EXPECT_EQ(staged(steep, "[0, 1]").at("told").at("camera left out"), 1);
  const json wrong = staged(R"({"extensions": {"KHR_lights_punctual": {}}})", "[0, 1]");
  EXPECT_EQ(
      wrong.at("told").at("camera or light that cannot be read left out, with all that follow"), 1);
  EXPECT_EQ(wrong.at("lights")[1].at("type"), "sky");
  // Beside the eye, and in it: something is looked at.
  for (const char* const place : {"[1, 0, 0.000000001]", "[0.5, 0.5, 0]"}) {
    const json camera =
        staged(fmt::format(R"({{"camera": 0, "translation": {}}})", place), "[0, 1]").at("camera");
    EXPECT_LT(camera.at("look_at")[2].get<double>() + 0.1, camera.at("origin")[2].get<double>());
  }
}

TEST(Meshes, what_assimp_refuses_is_said) {
  for (const char* const ending : {".ply", ".obj", ".stl", ".gltf", ".glb"})
    EXPECT_THROW(document(ending, "nothing of the kind"), client::InputError) << ending;
}

TEST(OwnProcess, what_it_throws_or_suffers_is_an_error) {
  const client::ProcessLimits limits{std::size_t{256} << 20, 1};
  EXPECT_EQ(client::in_own_process(limits, [] { return std::string("made"); }), "made");
  const auto message = [&](const std::function<std::string()>& make) -> std::string {
    try {
      return client::in_own_process(limits, make);
    } catch (const client::InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(message([]() -> std::string { throw client::InputError("wrong"); }), "wrong");
  EXPECT_EQ(message([]() -> std::string { std::abort(); }), "is damaged: its reader broke off");
  EXPECT_NE(message([]() -> std::string {
              std::raise(SIGKILL);
              return "";
            }).find("the system ended its reader"),
            std::string::npos);
  // What others have the processor for is no fault of the file.
  EXPECT_EQ(message([]() -> std::string {
              std::this_thread::sleep_for(std::chrono::milliseconds(1500));
              return "slept";
            }),
            "slept");
  // A second of the processor's. Where others have it for longer than that, two by the clock are
  // over first: then it is tried again.
  std::string endless;
  for (int i = 0; i < 5 && (i == 0 || endless == "takes longer to read than 2 s; is it damaged?");
       ++i)
    endless = message([]() -> std::string {
      for (volatile bool forever = true; forever;) {
      }
      return "";
    });
  EXPECT_EQ(endless, "takes longer to read than 1 s; is it damaged?");
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_EQ(message([] { return std::string(std::size_t{1} << 30, 'x'); }),
            "needs more memory than 256 MB");
#endif
}

}  // namespace
}  // namespace raytracer::test
