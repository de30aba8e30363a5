#include "tests/cli/client.h"

#include <algorithm>

namespace raytracer::test {

std::unique_ptr<ServerProcess> Client::shared_server;

const std::string small_scene = R"({
  "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9, "width": 16, "height": 12},
  "background": [0, 0, 1],
  "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}]
})";

const std::string transparent_scene = R"({
  "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9, "width": 16, "height": 12},
  "background": "transparent", "ambient": 1, "shadows": "ambient",
  "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": 1,
               "material": {"color": [1, 0, 0]}}]
})";

const std::string wrong_scene = R"({
  "camera": {"origin": [0, 0, -5], "look_at": [0, 0, 0], "fov": 0.9, "width": 16, "height": 12},
  "backgruond": [0, 0, 1],
  "objects": [{"type": "sphere", "center": [0, 0, 0], "radius": -1},
              {"type": "sphere", "center": [0, 0, 0], "radius": 1, "material": "rde"}],
  "materials": {"red": {}}
})";

Command client_command(std::vector<std::string> arguments, std::string input,
                       std::map<std::string, std::string> environment) {
  return {RAYTRACER_CLIENT_PATH, std::move(arguments), std::move(input), std::move(environment)};
}

Outcome run_client(std::vector<std::string> arguments, std::string input,
                   std::map<std::string, std::string> environment) {
  return run(client_command(std::move(arguments), std::move(input), std::move(environment)));
}

void expect_input_error(const Outcome& outcome, const std::string& says) {
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find(says), std::string::npos)
      << "\"" << outcome.err << "\" does not contain \"" << says << "\"";
}

int count_lines(const std::string& text) {
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace raytracer::test
