// Pages of another origin than the server's, in a real browser: the example page, what server/
// README.md says in JavaScript, and that nobody reads anything who was not allowed to.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <httplib.h>

#include <chrono>
#include <filesystem>
#include <regex>
#include <string>
#include <thread>

#include "tests/browser/browser_page.h"
#include "tests/process/patience.h"
#include "tests/process/server_process.h"
#include "tests/process/temporary_folder.h"

namespace raytracer::test {
namespace {

using namespace std::chrono_literals;

const std::filesystem::path server_dir = std::filesystem::path(RAYTRACER_SOURCE_DIR) / "server";

/// A web server of its own, which serves the example page and an empty one.
class WebSite {
 public:
  WebSite() {
    serve("/page.html", read_file(server_dir / "examples/page.html"));
    serve("/empty.html", "<!doctype html><title>empty</title>");
    serve("/favicon.ico", "");
    http_.set_keep_alive_max_count(1);  // it stops only when the browser's connections have ended
    port_ = http_.bind_to_any_port("127.0.0.1");
    thread_ = std::thread([this] { http_.listen_after_bind(); });
    EXPECT_TRUE(eventually([this] { return http_.is_running(); }));
  }
  ~WebSite() {
    http_.stop();
    thread_.join();
  }
  WebSite(const WebSite&) = delete;
  WebSite& operator=(const WebSite&) = delete;

  std::string origin() const { return fmt::format("http://127.0.0.1:{}", port_); }

 private:
  void serve(const std::string& path, const std::string& text) {
    http_.Get(path, [text](const httplib::Request&, httplib::Response& response) {
      response.set_content(text, "text/html; charset=utf-8");
    });
  }

  httplib::Server http_;
  int port_ = 0;
  std::thread thread_;
};

class OtherOrigin : public testing::Test {
 protected:
  static WebDriver& browser() { return shared_browser(); }

  void open_example(const ServerProcess& server) const {
    browser().open(site_.origin() + "/page.html?server=" + server.url());
  }
  void open_empty_page() const { browser().open(site_.origin() + "/empty.html"); }

  /// What the body of an asynchronous function gives, or how it failed.
  static nlohmann::json result_of(const std::string& body) {
    return browser().run_until_called(
        "const done = arguments[arguments.length - 1];"
        "(async () => {" +
        body + "})().then(done, (error) => done(String(error)));");
  }

  const WebSite site_;
};

TEST_F(OtherOrigin, example_page_shows_its_picture) {
  const ServerProcess server({"--allow-origin", site_.origin()});
  open_example(server);
  EXPECT_TRUE(eventually([] {
    return browser().run("return document.getElementById('picture').naturalWidth;") == 320;
  }));
  const std::string said =
      browser().run("return document.getElementById('said').textContent;").get<std::string>();
  EXPECT_TRUE(std::regex_match(said, std::regex("estimated error 0\\.00[0-9]+"))) << said;
}

TEST_F(OtherOrigin, page_that_is_not_allowed_reads_nothing) {
  const ServerProcess server({"--allow-origin", "https://example.org"});
  open_empty_page();
  EXPECT_EQ(result_of(fmt::format("return (await fetch('{}/version')).status;", server.url())),
            "TypeError: Failed to fetch");
}

TEST_F(OtherOrigin, page_sends_a_token_and_reads_refusals) {
  const ServerProcess server({"--allow-origin", "*", "--token", "s3cret"});
  open_empty_page();
  const auto status_with = [&](const std::string& token) {
    return result_of(fmt::format(
        "const answer = await fetch('{}/scenes/demo', {{ headers: {{ Authorization: 'Bearer {}' }} "
        "}}); const body = await answer.json(); return `${{answer.status}} ${{body.title ?? "
        "body.name}} ${{answer.headers.has('X-Request-Id')}}`;",
        server.url(), token));
  };
  EXPECT_EQ(status_with("s3cret"), "200 Demo true");
  EXPECT_EQ(status_with("wrong"), "401 Unauthorized true");
}

TEST_F(OtherOrigin, javascript_of_the_readme_works) {
  const std::string readme = read_file(server_dir / "README.md");
  static const std::regex block("```js\n([^`]*)```");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(readme, match, block));
  const ServerProcess server({"--allow-origin", site_.origin()});
  open_empty_page();
  EXPECT_EQ(result_of(std::regex_replace(match.str(1), std::regex("http://127.0.0.1:8080"),
                                         server.url()) +
                      "return `${answer.status} ${String.fromCharCode(...picture.slice(1, 4))}`;"),
            "200 PNG");
}

}  // namespace
}  // namespace raytracer::test
