// raytracer: the command line of the service. It speaks HTTP to a raytracer-server and knows
// nothing of rendering.
#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <variant>

#include "client/arguments.h"
#include "client/commands.h"
#include "client/failure.h"

namespace {

using namespace raytracer::client;

void run(const Arguments& arguments) {
  if (const auto* command = std::get_if<RenderArguments>(&arguments.command))
    render(*command, arguments.server);
  else if (const auto* planned = std::get_if<PlanArguments>(&arguments.command))
    plan(*planned, arguments.server);
  else if (const auto* measured = std::get_if<TradeoffArguments>(&arguments.command))
    tradeoff(*measured, arguments.server);
  else if (const auto* other = std::get_if<ValidateArguments>(&arguments.command))
    validate(*other, arguments.server);
  else
    list_scenes(arguments.server);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a server or a reader that leaves is an error with a message
  try {
    const auto asked = read_arguments(argc, argv);
    if (const auto* help = std::get_if<HelpText>(&asked))
      fmt::print("{}", help->text);
    else
      run(std::get<Arguments>(asked));
    if (std::fflush(stdout) != 0) throw InputError("standard output: cannot be written");
    return 0;
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  } catch (const Interrupted& interrupted) {
    return 128 + interrupted.signal_number();
  } catch (const std::exception& error) {
    fmt::print(stderr, "raytracer: {}\n", error.what());
    return 2;
  }
}
