// The endings of files that the client reads, which the page knows too.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "client/formats/format.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

TEST(Endings, page_says_of_every_files_ending_that_the_client_reads_it) {
  const std::string script =
      read_file(std::filesystem::path(RAYTRACER_SOURCE_DIR) / "web/files.js");
  std::smatch table;
  ASSERT_TRUE(
      std::regex_search(script, table, std::regex(R"(read_by_client = /\(\\\.\(([a-z|]+)\))")));
  const std::string listed = table[1];
  const std::regex word("[a-z]+");
  std::set<std::string> in_page;
  for (std::sregex_iterator i(listed.begin(), listed.end(), word), end; i != end; ++i)
    in_page.insert("." + i->str());
  std::set<std::string> in_client;
  for (const client::Format& format : client::formats) in_client.emplace(format.ending);
  EXPECT_EQ(in_page, in_client);
}

}  // namespace
}  // namespace raytracer::test
