// --allow-origin: which pages of other origins may read answers (CORS, as the WHATWG's fetch
// standard has it).
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/process/program.h"
#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

const std::string page = "https://example.org";
const std::string other_page = "http://localhost:3000";
const std::string stranger = "https://example.com";

const char* const allowed_origin = "Access-Control-Allow-Origin";

Answer preflight(const ServerProcess& server, const std::string& target, const std::string& origin,
                 const std::string& method = "POST") {
  return request(server, "OPTIONS", target,
                 {{"Origin", origin},
                  {"Access-Control-Request-Method", method},
                  {"Access-Control-Request-Headers", "authorization,content-type"}});
}

/// "a, B" has each of them, whatever its case.
void expect_list(const std::string& list, const std::vector<std::string>& names) {
  const auto lower = [](std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ", " + text + ",";
  };
  for (const std::string& name : names)
    EXPECT_NE(lower(list).find(lower(name)), std::string::npos) << name << " is not in " << list;
}

TEST(CrossOrigin, pages_of_other_origins_may_read_nothing_by_default) {
  const ServerProcess server;
  const Answer answer = get(server, "/version", {{"Origin", page}});
  EXPECT_EQ(answer.status, 200);
  EXPECT_FALSE(answer.has_header(allowed_origin));
  EXPECT_EQ(answer.get_header_value("Vary").find("Origin"), std::string::npos);
  EXPECT_EQ(preflight(server, "/render", page).status, 405);
}

TEST(CrossOrigin, allowed_page_may_read_answers_and_their_fields) {
  const ServerProcess server({"--allow-origin", page, "--allow-origin", other_page});
  for (const std::string& origin : {page, other_page}) {
    const Answer answer = post(server, "/render", small_scene, {{"Origin", origin}});
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.get_header_value(allowed_origin), origin);
    EXPECT_EQ(answer.get_header_value_count(allowed_origin), 1U);
    EXPECT_EQ(answer.get_header_value("Vary"), "Accept, Origin");
    expect_list(answer.get_header_value("Access-Control-Expose-Headers"),
                {"ETag", "Location", "Server-Timing", "Retry-After", "Render-Samples",
                 "Render-Light-Samples", "Render-Error", "Render-Precision", "Render-Stop",
                 "X-Request-Id"});
    const Answer known =
        post(server, "/render", small_scene, {{"Origin", origin}, {"If-None-Match", "*"}});
    EXPECT_EQ(known.status, 304);
    EXPECT_EQ(known.get_header_value(allowed_origin), origin);
  }
}

TEST(CrossOrigin, others_may_not_and_caches_are_told) {
  const ServerProcess server({"--allow-origin", page});
  for (const Headers& fields : {Headers{{"Origin", stranger}}, Headers{{"Origin", page + ".evil"}},
                                Headers{{"Origin", "null"}}, Headers{}}) {
    const Answer answer = get(server, "/version", fields);
    EXPECT_EQ(answer.status, 200);
    EXPECT_FALSE(answer.has_header(allowed_origin));
    EXPECT_EQ(answer.get_header_value("Vary"), "Accept-Encoding, Origin");
  }
  EXPECT_EQ(preflight(server, "/render", stranger).status, 405);
  EXPECT_EQ(request(server, "OPTIONS", "/render", {{"Origin", page}}).status, 405)
      << "it is no preflight";
}

TEST(CrossOrigin, preflight_is_answered_for_every_route) {
  const ServerProcess server({"--allow-origin", page});
  for (const char* const target : {"/render", "/render?scene=demo&samples=4", "/plan", "/jobs",
                                   "/jobs/1", "/jobs/1/events", "/scenes", "/metrics", "/"}) {
    const Answer answer = preflight(server, target, page);
    EXPECT_EQ(answer.status, 204) << target;
    EXPECT_EQ(answer.body, "");
    EXPECT_EQ(answer.get_header_value(allowed_origin), page);
    expect_list(answer.get_header_value("Access-Control-Allow-Methods"),
                {"GET", "HEAD", "POST", "DELETE"});
    expect_list(answer.get_header_value("Access-Control-Allow-Headers"),
                {"content-type", "authorization", "cache-control", "if-none-match", "scene-digest",
                 "x-request-id"});
    expect_list(answer.get_header_value("Vary"), {"Origin"});
    EXPECT_TRUE(answer.has_header("Access-Control-Max-Age"));
  }
}

TEST(CrossOrigin, works_with_a_token) {
  const ServerProcess server({"--allow-origin", page, "--token", "s3cret"});
  EXPECT_EQ(preflight(server, "/render", page).status, 204) << "browsers send none with it";
  const Answer refused = post(server, "/render", small_scene, {{"Origin", page}});
  expect_problem(refused, 401, "Bearer");
  EXPECT_EQ(refused.get_header_value(allowed_origin), page);
  const Answer answer =
      post(server, "/render", small_scene, {{"Origin", page}, {"Authorization", "Bearer s3cret"}});
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.get_header_value(allowed_origin), page);
}

TEST(CrossOrigin, errors_can_be_read_too) {
  const ServerProcess server({"--allow-origin", page});
  const Headers from_page{{"Origin", page}};
  for (const Answer& answer :
       {get(server, "/nothing", from_page), post(server, "/render", "{", from_page),
        request(server, "DELETE", "/render", from_page),
        get(server, "/" + std::string(5000, 'a'), from_page)}) {
    EXPECT_GE(answer.status, 400);
    EXPECT_EQ(answer.get_header_value(allowed_origin), page) << answer.status;
    expect_list(answer.get_header_value("Vary"), {"Origin"});
  }
}

TEST(CrossOrigin, star_allows_every_page) {
  const ServerProcess server({}, {{"RAYTRACER_ALLOW_ORIGIN", "*"}});
  for (const std::string& origin : {page, stranger, std::string("null")}) {
    EXPECT_EQ(get(server, "/version", {{"Origin", origin}}).get_header_value(allowed_origin), "*");
    EXPECT_EQ(preflight(server, "/jobs/1", origin, "DELETE").status, 204);
  }
}

TEST(CrossOrigin, variable_takes_several_with_commas) {
  const ServerProcess server({}, {{"RAYTRACER_ALLOW_ORIGIN", page + "," + other_page}});
  for (const std::string& origin : {page, other_page})
    EXPECT_EQ(get(server, "/version", {{"Origin", origin}}).get_header_value(allowed_origin),
              origin);
}

TEST(CrossOrigin, what_is_no_origin_is_refused) {
  for (const char* const wrong :
       {"", "example.org", "https://example.org/", "https://example.org/page", "https://",
        "https://user@example.org", "https://example.org:port", "**", "null"}) {
    const Outcome outcome = run({RAYTRACER_SERVER_PATH, {"--port", "0", "--allow-origin", wrong}});
    EXPECT_EQ(outcome.status, 1) << wrong;
    EXPECT_NE(outcome.err.find("--allow-origin"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("https://"), std::string::npos) << "no example: " << outcome.err;
  }
}

}  // namespace
}  // namespace raytracer::test
