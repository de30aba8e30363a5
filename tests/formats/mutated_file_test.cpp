// Files with random damage: each is read, and its document is JSON, or its errors have lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "client/formats/format.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

/// Takes away, doubles, or replaces some bytes, as often by words of the format as by any.
std::string damaged(std::string text, std::mt19937& random) {
  static const char* const words[] = {"v",      "p ", "pp ", " 0 ", "-1",   "1e308",
                                      "nan",    "3 ", "\n",  "s ",  "from", "#",
                                      "9e-320", "c ", "l ",  "f ",  "b "};
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
  int read = 0;
  int refused = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    const client::Format* const format = client::format_of(file.path().string());
    ASSERT_NE(format, nullptr) << file.path();
    const std::string whole = read_file(file.path());
    ASSERT_TRUE(format->read(whole).errors.empty()) << format->read(whole).errors.front().what;
    for (int round = 0; round < 20'000; ++round) {
      const std::string text = damaged(whole, random);
      const client::Reading reading = format->read(text);
      const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
      for (const client::LineError& error : reading.errors) {
        ASSERT_GE(error.line, 1);
        ASSERT_LE(error.line, lines);
        ASSERT_FALSE(error.what.empty());
      }
      if (reading.errors.empty()) {
        ASSERT_TRUE(nlohmann::json::accept(client::model::to_document(reading.scene))) << text;
        ++read;
      } else {
        ++refused;
      }
    }
  }
  EXPECT_GT(read, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace raytracer::test
