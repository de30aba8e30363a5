// raytracer open: the page of a server that keeps the scene, in the browser if there is one.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/environment.h"
#include "client/interrupts.h"
#include "client/notice.h"
#include "client/with_server.h"

namespace raytracer::client {
namespace {

/// The program that shows an address; empty where there is no display.
std::string browser() {
#ifdef __APPLE__
  return "open";
#else
  if (std::string chosen = variable("BROWSER"); !chosen.empty()) return chosen;
  return variable("DISPLAY").empty() && variable("WAYLAND_DISPLAY").empty() ? "" : "xdg-open";
#endif
}

/// Without waiting for it: it may stay as long as the page does. Whether there is one cannot be
/// told, so that the address is printed anyway.
void show(const std::string& address) {
  const std::string program = browser();
  if (program.empty()) return;
  const pid_t child = fork();
  if (child == 0) {
    setsid();                   // Ctrl-C is for this program, not for the browser
    if (fork() != 0) _exit(0);  // its parent is init then, which waits for it
    restore_signals();
    const int nothing = ::open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nothing, stream);
    execlp(program.c_str(), program.c_str(), address.c_str(), nullptr);
    _exit(1);
  }
  if (child > 0) waitpid(child, nullptr, 0);
}

void open_page(const SceneChoice& choice, const ServerChoice& server) {
  with_scene(choice, {}, server, [&](Api& api, const SceneText& scene) {
    const std::string address = fmt::format("{}/#scene={}", api.url(), api.keep_scene(scene));
    fmt::print("{}\n", address);
    std::fflush(stdout);
    show(address);
    if (server.url) return;
    notice("The page stays until Ctrl-C.");
    for (;;) api.pause(std::chrono::hours(1));
  });
}

}  // namespace

void add_open(CLI::App& app, const ServerChoice& server) {
  const auto choice = std::make_shared<SceneChoice>();
  add_scene_command(app, "open", "Open a scene in the browser", *choice)
      .callback([choice, &server] { open_page(*choice, with_variables(server)); });
}

}  // namespace raytracer::client
