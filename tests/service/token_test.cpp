// The bearer token: nothing without it but the page and health, and no listening beyond loopback
// without one.
#include <gtest/gtest.h>

#include <string>

#include "tests/service/documents.h"
#include "tests/service/service.h"

namespace raytracer::test {
namespace {

const Headers right{{"Authorization", "Bearer s3cret"}};

TEST(Token, is_demanded_of_every_route_but_the_page_and_health) {
  const ServerProcess server({"--token", "s3cret"});
  for (const char* const path :
       {"/scenes", "/scenes/demo", "/openapi.json", "/version", "/render?scene=demo", "/nothing"}) {
    const Answer refused = get(server, path);
    expect_problem(refused, 401, "Bearer");
    EXPECT_EQ(refused.get_header_value("WWW-Authenticate").rfind("Bearer", 0), 0U);
  }
  expect_problem(post(server, "/render", small_scene), 401, "Bearer");
  for (const char* const path :
       {"/", "/index.html", "/main.js", "/style.css", "/favicon.svg", "/healthz", "/readyz"}) {
    EXPECT_EQ(get(server, path).status, 200) << path;
    EXPECT_EQ(request(server, "HEAD", path).status, 200) << path;
    EXPECT_EQ(request(server, "DELETE", path).status, 401) << path;
  }
}

TEST(Token, opens_every_route) {
  const ServerProcess server({"--token", "s3cret"});
  EXPECT_EQ(get(server, "/scenes", right).status, 200);
  EXPECT_EQ(get(server, "/nothing", right).status, 404);
  EXPECT_EQ(post(server, "/render", small_scene, right).status, 200);
  EXPECT_EQ(get(server, "/scenes", {{"Authorization", "bearer s3cret"}}).status, 200);
}

TEST(Token, must_be_the_right_one) {
  const ServerProcess server({}, {{"RAYTRACER_TOKEN", "s3cret"}});
  for (const char* const wrong : {"Bearer s3cre", "Bearer s3crets", "Bearer S3cret", "Bearer ",
                                  "Bearer", "s3cret", "Basic czNjcmV0", "Bearer s3cret x"})
    EXPECT_EQ(get(server, "/scenes", {{"Authorization", wrong}}).status, 401) << wrong;
}

TEST(Token, is_in_no_answer_and_no_log) {
  const ServerProcess server({"--token", "s3cret"});
  EXPECT_EQ(get(server, "/version", right).body.find("s3cret"), std::string::npos);
  EXPECT_EQ(get(server, "/scenes", {{"Authorization", "Bearer wr0ng"}}).body.find("wr0ng"),
            std::string::npos);
  EXPECT_EQ(server.log().find("s3cret"), std::string::npos) << server.log();
}

TEST(Token, is_required_to_listen_beyond_loopback) {
  for (const char* const host : {"0.0.0.0", "::"}) {
    const Outcome refused = run({RAYTRACER_SERVER_PATH, {"--host", host, "--port", "0"}});
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("--token"), std::string::npos) << refused.err;
  }
  const ServerProcess open({"--host", "0.0.0.0", "--token", "s3cret"});
  EXPECT_EQ(get(open, "/scenes").status, 401);
  EXPECT_EQ(get(open, "/scenes", right).status, 200);
}

}  // namespace
}  // namespace raytracer::test
