// A running server and requests to it as functions: what every test of the service stands on.
#pragma once

#include <gtest/gtest.h>
#include <httplib.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "tests/process/server_process.h"

namespace raytracer::test {

using Answer = httplib::Response;
using Headers = httplib::Headers;

/// For a picture that is to be rendered, not taken from the server's cache.
inline const Headers without_cache{{"Cache-Control", "no-cache"}};

/// Sends one request on a connection of its own. Throws std::runtime_error without an answer.
Answer request(const ServerProcess& server, const std::string& method, const std::string& target,
               const Headers& headers = {}, const std::string& body = {});

Answer get(const ServerProcess& server, const std::string& target, const Headers& headers = {});

/// The body goes as application/json.
Answer post(const ServerProcess& server, const std::string& target, const std::string& body,
            Headers headers = {});

/// The answer's body as JSON; fails the test and gives null if it is none.
nlohmann::json json_of(const Answer& answer);

/// Expects problem+json (RFC 9457) with this status, everything that belongs to it, and a detail
/// that contains `detail`.
void expect_problem(const Answer& answer, int status, std::string_view detail);

/// A problem's errors as "POINTER DETAIL" lines.
std::string errors_of(const Answer& answer);

/// One server for all tests of a suite.
class Service : public testing::Test {
 protected:
  static void SetUpTestSuite() { shared_server = std::make_unique<ServerProcess>(); }
  static void TearDownTestSuite() { shared_server.reset(); }

  static Answer get(const std::string& target, const Headers& headers = {}) {
    return test::get(*shared_server, target, headers);
  }
  static Answer post(const std::string& target, const std::string& body, Headers headers = {}) {
    return test::post(*shared_server, target, body, std::move(headers));
  }
  static Answer request(const std::string& method, const std::string& target,
                        const Headers& headers = {}, const std::string& body = {}) {
    return test::request(*shared_server, method, target, headers, body);
  }
  static const ServerProcess& server() { return *shared_server; }

 private:
  static std::unique_ptr<ServerProcess> shared_server;
};

}  // namespace raytracer::test
