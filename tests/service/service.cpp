#include "tests/service/service.h"

#include <fmt/format.h>

#include <stdexcept>

namespace raytracer::test {

std::unique_ptr<ServerProcess> Service::shared_server;

Answer request(const ServerProcess& server, const std::string& method, const std::string& target,
               const Headers& headers, const std::string& body) {
  // Without keep-alive, because httplib 0.11 waits for the body of a 304 until the connection ends.
  httplib::Client client = server.client();
  httplib::Request request;
  request.method = method;
  request.path = target;
  request.headers = headers;
  request.body = body;
  const httplib::Result result = client.send(request);
  if (!result)
    throw std::runtime_error(fmt::format("{} {} got no answer ({}); the server's log:\n{}", method,
                                         target.substr(0, 200), httplib::to_string(result.error()),
                                         server.log()));
  return *result;
}

Answer get(const ServerProcess& server, const std::string& target, const Headers& headers) {
  return request(server, "GET", target, headers);
}

Answer post(const ServerProcess& server, const std::string& target, const std::string& body,
            Headers headers) {
  if (headers.count("Content-Type") == 0) headers.emplace("Content-Type", "application/json");
  return request(server, "POST", target, headers, body);
}

nlohmann::json json_of(const Answer& answer) {
  auto json = nlohmann::json::parse(answer.body, nullptr, false);
  if (!json.is_discarded()) return json;
  ADD_FAILURE() << "not JSON: " << answer.body.substr(0, 500);
  return nullptr;
}

void expect_problem(const Answer& answer, int status, std::string_view detail) {
  EXPECT_EQ(answer.status, status) << answer.body.substr(0, 500);
  EXPECT_EQ(answer.get_header_value("Content-Type"), "application/problem+json");
  EXPECT_FALSE(answer.has_header("ETag"));
  const nlohmann::json problem = json_of(answer);
  if (!problem.is_object()) return;
  EXPECT_EQ(problem.value("status", 0), status);
  EXPECT_TRUE(problem.value("type", nlohmann::json()).is_string());
  EXPECT_NE(problem.value("title", ""), "");
  EXPECT_NE(problem.value("detail", "").find(detail), std::string::npos)
      << "\"" << problem.value("detail", "") << "\" does not contain \"" << detail << "\"";
}

std::string errors_of(const Answer& answer) {
  std::string lines;
  const nlohmann::json problem = json_of(answer);
  if (!problem.is_object() || !problem.contains("errors")) return lines;
  for (const nlohmann::json& error : problem.at("errors"))
    lines += fmt::format("{} {}\n", error.value("pointer", "?"), error.value("detail", "?"));
  return lines;
}

}  // namespace raytracer::test
