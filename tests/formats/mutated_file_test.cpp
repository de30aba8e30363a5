// Files with random damage: each is read, and its document is JSON, or its errors have lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "client/failure.h"
#include "client/formats/format.h"
#include "tests/formats/read_text.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

/// Takes away, doubles, or replaces some bytes, as often by words of the formats as by any.
std::string damaged(std::string text, std::mt19937& random) {
  static const char* const words[] = {
      "v",     "p ",       "pp ",  " 0 ",    "-1",     "1e308", "nan",    "3 ",    "\n",
      "s ",    "from",     "#",    "c ",     "9e-320", "l ",    "f ",     "b ",    "\"",
      ",",     "\t",       "x",    "ITEM: ", "ATOM",   "END",   "MODEL ", "loop_", "_atom_",
      "data_", "TIMESTEP", "type", "1e99",   "?",      "'"};
  for (int hits = 1 + static_cast<int>(random() % 4); hits > 0; --hits) {
    const std::size_t at = random() % text.size();
    const std::size_t length = random() % 12;
    switch (random() % 4) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, text.substr(random() % text.size(), length));
        break;
      case 2:
        text.replace(at, 1, words[random() % std::size(words)]);
        break;
      default:
        text[at] = static_cast<char>(random());
    }
    if (text.empty()) text = " ";
  }
  return text;
}

TEST(MutatedFile, is_read_or_refused_with_lines) {
  const std::filesystem::path folder =
      std::filesystem::path(RAYTRACER_SOURCE_DIR) / "tests/formats/files";
  std::mt19937 random(11);
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    SCOPED_TRACE(file.path());
    const client::Format* const format = client::format_of(file.path().string());
    ASSERT_NE(format, nullptr);
    const std::string whole = read_file(file.path());
    int read = 0;
    int refused = 0;
    for (const client::Reading& frame : read_text(*format, whole))
      ASSERT_TRUE(frame.errors.empty()) << frame.errors.front().what;
    // Meshes have a process each.
    const bool is_mesh = format->openness == client::Openness::picture;
    const int rounds = is_mesh ? 100 : 2'000;
    for (int round = 0; round < rounds; ++round) {
      const std::string text = damaged(whole, random);
      const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
      client::ImportOptions options;
      options.style = static_cast<client::AtomStyle>(round % 3);
      try {
        for (const client::Reading& frame : read_text(*format, text, options)) {
          for (const client::LineError& error : frame.errors) {
            ASSERT_GE(error.line, 1);
            ASSERT_LE(error.line, lines);
            ASSERT_FALSE(error.what.empty());
          }
          ASSERT_TRUE(!frame.errors.empty() ||
                      nlohmann::json::accept(client::model::to_document(frame.scene)))
              << text;
          ++(frame.errors.empty() ? read : refused);
        }
      } catch (const client::InputError& error) {
        ASSERT_STRNE(error.what(), "");
        ++refused;
      }
    }
    EXPECT_GT(read, rounds / 40);
    EXPECT_GT(refused, rounds / 40);
  }
}

}  // namespace
}  // namespace raytracer::test
