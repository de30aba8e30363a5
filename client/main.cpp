// raytracer: the command line of the service. It speaks HTTP to a raytracer-server and knows
// nothing of rendering.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <exception>
#include <sstream>
#include <string>
#include <string_view>

#include "client/command_line.h"
#include "client/commands.h"
#include "client/failure.h"
#include "client/notice.h"

namespace {

using namespace raytracer::client;

constexpr const char* purpose = "Renders scenes on a raytracer-server.";
constexpr const char* footer =
    "Without --server, a command starts a server of its own on a free loopback port\n"
    "and stops it at the end.\n"
    "\n"
    "Exit status: 0 success; 1 invalid scene or arguments; 2 server unreachable or\n"
    "failed; 128 + N interrupted by signal N.";

/// Standard streams that are closed: the next file or socket would take their numbers, and with
/// them what is said there. What uses them fails as before. As in the server's main, with which
/// this program shares no code.
void hold_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) == -1)
      ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// Where the arguments of a command line are explained that has gone wrong.
std::string help_of(const CLI::App& app) {
  const auto commands = app.get_subcommands();
  return "see raytracer " + (commands.empty() ? "" : commands.front()->get_name() + " ") + "--help";
}

/// Reads the command line and does what it says.
void run(int argc, char** argv) {
  CLI::App app(purpose, "raytracer");
  app.footer(footer);
  app.set_help_flag("-h,--help", "Print this help");
  app.set_version_flag("--version", "raytracer " RAYTRACER_VERSION, "Print the version");
  app.get_formatter()->label("SUBCOMMAND", "COMMAND");
  app.get_formatter()->column_width(43);
  app.require_subcommand(0, 1);
  app.callback([&app] {  // called last: a name that is no command has then been refused as such
    if (app.get_subcommands().empty()) throw CLI::RequiredError("A command");
  });
  ServerChoice server;
  add_server_options(app, server);
  for (AddCommand* const add_command : all_commands) add_command(app, server);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& request) {  // --help, --version
    std::ostringstream text;
    app.exit(request, text);
    fmt::print("{}", text.str());
  } catch (const CLI::ExtrasError&) {  // its own words name them in the reverse order
    throw InputError(fmt::format("'{}' is no command and no option here; {}",
                                 app.remaining(true).front(), help_of(app)));
  } catch (const CLI::ArgumentMismatch& error) {  // "--samples: 1 required INT missing"
    const std::string_view words = error.what();
    throw InputError(fmt::format("{}: its value is missing; {}", words.substr(0, words.find(':')),
                                 help_of(app)));
  } catch (const CLI::ParseError& error) {
    throw InputError(fmt::format("{}; {}", error.what(), help_of(app)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  hold_closed_streams();
  std::signal(SIGPIPE, SIG_IGN);  // a server or a reader that leaves is an error with a message
  try {
    run(argc, argv);
    if (std::fflush(stdout) != 0) throw InputError("standard output: cannot be written");
    return 0;
  } catch (const InputError& error) {
    notice(error.what());
    return 1;
  } catch (const Interrupted& interrupted) {
    return 128 + interrupted.signal_number();
  } catch (const std::exception& error) {
    notice(fmt::format("raytracer: {}", error.what()));
    return 2;
  }
}
