// Where each library is used, so that it can be replaced there and is in nobody's way elsewhere.
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <string_view>

#include "tests/structure/source_tree.h"

namespace raytracer::test {
namespace {

/// Every user of `header` in the product satisfies `may`, and there is one.
void expect_users(std::string_view header, const std::function<bool(const std::string&)>& may) {
  int count = 0;
  for (const SourceFile& file : source_files({"engine", "server", "client"})) {
    if (!file.includes_library(header)) continue;
    EXPECT_TRUE(may(file.path)) << file.path << " includes " << header;
    ++count;
  }
  EXPECT_GT(count, 0) << "nobody includes " << header;
}

TEST(Libraries, json_is_where_json_is_read_or_written) {
  expect_users("nlohmann/", [](const std::string& path) {
    return path == "engine/scene/syntax_error.cpp" ||    // says what is wrong with text
           path == "engine/scene/schema.cpp" ||          // writes the schema of scenes
           path == "engine/plan/explain.cpp" ||          // writes plans
           path == "server/answer.h" ||                  // writes answers (forward declarations)
           path == "server/answer.cpp" ||                //
           path == "server/problem.cpp" ||               // writes problems
           path == "server/information_handlers.cpp" ||  // writes lists and limits
           path == "server/job_handlers.cpp" ||          // writes jobs
           path == "server/scene_handlers.cpp" ||        // writes lists of scenes
           path == "server/tradeoff.cpp" ||              // writes curves
           path == "server/catalog.cpp" ||               // reads the shipped scenes' descriptions
           path == "server/openapi_handler.cpp" ||       // writes OpenAPI
           path == "server/cluster/record.cpp" ||        // reads and writes what NATS keeps
           path == "server/cluster/result.cpp" ||        //
           path == "server/cluster/store.cpp" ||         //
           path == "server/cluster_handler.cpp" ||       // writes who is in the cluster
           path == "server/request_text.cpp" ||          // reads numbers as JSON writes them
           path == "client/api.cpp" ||                   // reads answers
           path == "client/plan_command.cpp" ||          // reads plans
           path == "client/curve.cpp" ||                 // reads curves
           path == "client/scene_errors.cpp" ||          // reads problems
           path == "client/turntable.cpp" ||             // reads cameras of scenes
           path == "client/formats/meshes/gltf_stage.cpp" ||  // reads cameras and lights
           path == "client/formats/meshes/gltf_extensions.cpp" ||
           path == "client/convert_command.cpp" ||  // says what is wrong with text
           path == "client/pointer_lines.cpp";      // finds places in scenes
  });
}

TEST(Libraries, scenes_are_parsed_in_one_file) {
  expect_users("simdjson.h",
               [](const std::string& path) { return path == "engine/scene/document.h"; });
}

TEST(Libraries, http_is_in_the_server_and_the_clients_api) {
  expect_users("httplib.h", [](const std::string& path) {
    return path.starts_with("server/") || path == "client/api.cpp" || path == "client/api.h";
  });
}

TEST(Libraries, png_encoder_is_in_one_file) {
  expect_users("stb_image_write.h",
               [](const std::string& path) { return path == "engine/image/png.cpp"; });
}

TEST(Libraries, pngs_are_decoded_in_one_file) {
  expect_users("png.h", [](const std::string& path) { return path == "client/png.cpp"; });
}

TEST(Libraries, compression_is_in_one_file) {
  expect_users("isa-l/", [](const std::string& path) { return path == "engine/image/isal.cpp"; });
}

TEST(Libraries, digests_are_in_two_files) {
  expect_users("openssl/", [](const std::string& path) {
    return path == "server/digest.cpp" || path == "server/request_validation.cpp";
  });
}

TEST(Libraries, pictures_in_terminals_are_drawn_in_one_file) {
  expect_users("chafa.h",
               [](const std::string& path) { return path == "client/terminal_picture.cpp"; });
}

TEST(Libraries, command_lines_are_read_in_one_place_of_the_server_and_by_each_command) {
  expect_users("CLI/CLI.hpp", [](const std::string& path) {
    return path == "server/config.cpp" || path == "client/main.cpp" ||
           path == "client/command_line.cpp" ||  // the options that commands share
           path == "client/import_flags.cpp" ||  //
           (path.starts_with("client/") && path.ends_with("_command.cpp"));
  });
}

TEST(Libraries, meshes_are_read_in_a_library_of_its_own) {
  expect_users("assimp/", [](const std::string& path) {
    return path == "client/formats/meshes/import_meshes.cpp" ||
           path.starts_with("client/formats/meshes/assimp_files.") ||
           path.starts_with("client/formats/meshes/mesh_material.");
  });
}

TEST(Libraries, molecules_are_known_where_particles_are_read) {
  expect_users("gemmi/", [](const std::string& path) {
    return path.starts_with("client/formats/particles/");
  });
}

TEST(Libraries, compressed_files_are_unpacked_in_one_file) {
  const auto may = [](const std::string& path) {
    return path == "client/formats/unpacking.cpp" || path == "client/apng.cpp";  // a checksum
  };
  expect_users("zlib.h", may);
  expect_users("zstd.h", may);
}

TEST(Libraries, numbers_of_files_are_read_in_one_file) {
  expect_users("fast_float/",
               [](const std::string& path) { return path == "client/formats/numbers.cpp"; });
}

TEST(Libraries, page_uses_none) {
  for (const SourceFile& file : source_files({"web"}))
    for (const std::string_view elsewhere :
         {"src=\"http", "href=\"http", "from \"http", "import \"http", "import(\"http", "url(http",
          "@import"})
      EXPECT_EQ(file.text.find(elsewhere), std::string::npos) << file.path << ": " << elsewhere;
}

TEST(Libraries, nats_is_in_one_place) {
  expect_users("nats/",
               [](const std::string& path) { return path.starts_with("server/cluster/nats"); });
}

}  // namespace
}  // namespace raytracer::test
