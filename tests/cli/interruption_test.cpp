// Ctrl-C: the client ends soon, takes back what it began, and leaves nothing behind.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <regex>
#include <string>

#include "tests/cli/client.h"
#include "tests/process/patience.h"
#include "tests/process/pseudo_terminal.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class Interruption : public Client {
 protected:
  static bool server_renders() { return server().log().find("GET /jobs/") != std::string::npos; }
};

TEST_F(Interruption, ends_the_client_with_the_signals_status) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const ServerProcess server;
    Process client(client_command({"render", "-", "--server", server.url()}, endless_scene()));
    ASSERT_TRUE(eventually([&] { return server.log().find("GET /jobs/") != std::string::npos; }));
    client.signal(signal);
    EXPECT_EQ(client.wait(5s), 128 + signal);
    EXPECT_EQ(client.out(), "");
  }
}

TEST_F(Interruption, takes_the_render_back) {
  const TemporaryFolder folder;
  Process client(client_command(
      {"render", "-", "-o", folder / "image.png", "--server", server().url()}, endless_scene()));
  ASSERT_TRUE(eventually(server_renders));
  client.signal(SIGINT);
  EXPECT_TRUE(client.wait(5s).has_value());
  EXPECT_TRUE(eventually([&] { return server().log().find("DELETE /jobs/") != std::string::npos; }))
      << server().log();
  std::smatch job;
  const std::string log = server().log();
  ASSERT_TRUE(std::regex_search(log, job, std::regex("GET (/jobs/[^ ]+)")));
  EXPECT_EQ(server().client().Get(job.str(1))->status, 404);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()), 0);
}

TEST_F(Interruption, works_from_the_keyboard) {
  if (!PseudoTerminal::is_available()) GTEST_SKIP() << "there is no terminal: mount /dev/pts";
  PseudoTerminal terminal(client_command({"render", "-", "--server", server().url()}, ""), 80, 24);
  // The scene is typed, so this also says that a terminal's input is read to its end (Ctrl-D).
  terminal.type(R"({"camera": {"origin": [0,0,-5], "look_at": [0,0,0], "fov": 1, "width": 1500,)");
  terminal.type("\n\"height\": 1500}, \"render\": {\"samples\": 1500},\n");
  terminal.type(R"("objects": [{"type": "sphere", "center": [0,0,0], "radius": 4}],)");
  terminal.type("\n\"lights\": [{\"type\": \"distant\", \"direction\": [1,1,9]}]}\n\x04");
  EXPECT_TRUE(terminal.shows(" %", 10s)) << terminal.screen();
  terminal.type("\x03");
  EXPECT_EQ(terminal.wait(5s), 128 + SIGINT) << terminal.screen();
}

}  // namespace
}  // namespace raytracer::test
