// raytracer render --watch: again whenever the file changes, until a signal.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>

#include "tests/cli/client.h"
#include "tests/process/patience.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

TEST(Watch, renders_each_version_of_the_file_until_it_is_interrupted) {
  const TemporaryFolder folder;
  const std::string scene = folder.write("scene.json", small_scene);
  const std::string image = folder / "image.png";
  const ServerProcess server;
  Process client(
      client_command({"render", scene, "--watch", "-o", image, "--server", server.url()}));
  const auto image_bytes = [&] { return fs::exists(image) ? read_file(image) : std::string(); };
  ASSERT_TRUE(eventually([&] { return !image_bytes().empty(); })) << client.err();
  const std::string first = image_bytes();

  folder.write("scene.json", wrong_scene);
  ASSERT_TRUE(eventually([&] { return client.err().find("/objects/0") != std::string::npos; }))
      << client.err();
  EXPECT_EQ(image_bytes(), first) << "a wrong scene took the last right picture away";

  std::string other = small_scene;
  const std::size_t width = other.find("\"width\": 16") + 9;
  folder.write("scene.json", other.replace(width, 2, "24"));
  ASSERT_TRUE(eventually([&] { return image_bytes() != first; })) << client.err();

  client.signal(SIGINT);
  EXPECT_EQ(client.wait(5s), 128 + SIGINT);
}

TEST(Watch, needs_a_file) {
  expect_input_error(run_client({"render", "demo", "--watch"}), "'demo'");
  expect_input_error(run_client({"render", "-", "--watch"}), "'-'");
}

}  // namespace
}  // namespace raytracer::test
