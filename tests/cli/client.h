// The program `raytracer` as tests run it, and the scenes that they give it.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/process/endless_scene.h"
#include "tests/process/program.h"
#include "tests/process/server_process.h"

namespace raytracer::test {

/// A sphere in 16 x 12 pixels.
extern const std::string small_scene;
/// The same before nothing, in a constant red.
extern const std::string transparent_scene;
/// A misspelt key on line 3, a radius that is not positive on line 4, and a material that does not
/// exist on line 5.
extern const std::string wrong_scene;

/// `raytracer ARGUMENTS`.
Command client_command(std::vector<std::string> arguments, std::string input = {},
                       std::map<std::string, std::string> environment = {});

/// Runs it to its end.
Outcome run_client(std::vector<std::string> arguments, std::string input = {},
                   std::map<std::string, std::string> environment = {});

/// Expects exit status 1, nothing on standard output, and a message that contains `says`.
void expect_input_error(const Outcome& outcome, const std::string& says);

/// How many lines a text has.
int count_lines(const std::string& text);

/// Tests that share one daemon, so that none has to start its own.
class Client : public testing::Test {
 protected:
  static void SetUpTestSuite() { shared_server = std::make_unique<ServerProcess>(); }
  static void TearDownTestSuite() { shared_server.reset(); }

  static const ServerProcess& server() { return *shared_server; }
  /// `raytracer ARGUMENTS` with RAYTRACER_SERVER naming the shared daemon.
  static Outcome run_with_server(std::vector<std::string> arguments, std::string input = {}) {
    return run_client(std::move(arguments), std::move(input),
                      {{"RAYTRACER_SERVER", shared_server->url()}});
  }

 private:
  static std::unique_ptr<ServerProcess> shared_server;
};

}  // namespace raytracer::test
