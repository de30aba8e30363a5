#include "server/config.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdint>
#include <deque>
#include <optional>
#include <sstream>
#include <thread>

#include "engine/engine.h"
#include "server/token.h"

namespace raytracer {
namespace {

/// A value and where it came from, for messages: "--port" or "RAYTRACER_PORT".
struct Given {
  std::string source;
  std::string text;
};

/// One flag with its variable. The values stay texts until they are judged, so that a message can
/// say which of the two was wrong.
struct Setting {
  std::string flag;
  std::string variable;
  std::string from_flag{};
  CLI::Option* option = nullptr;

  std::optional<Given> given(const Environment& environment) const {
    if (option->count() > 0) return Given{flag, from_flag};
    const char* const value = environment(variable.c_str());
    if (value && *value) return Given{variable, value};
    return {};
  }
};

[[noreturn]] void refuse(const Given& given, std::string_view rule) {
  throw ConfigError(fmt::format("{} is \"{}\" but must be {}", given.source, given.text, rule));
}

std::int64_t integer_of(const Given& given, std::int64_t least, std::int64_t most) {
  std::int64_t value = 0;
  const char* const end = given.text.data() + given.text.size();
  const auto [stop, error] = std::from_chars(given.text.data(), end, value);
  if (error != std::errc{} || stop != end || value < least || value > most)
    refuse(given, fmt::format("an integer from {} to {}", least, most));
  return value;
}

void require_token_beyond_loopback(const Config& config) {
  if (!config.token.empty() || is_loopback(config.host)) return;
  throw ConfigError(fmt::format(
      "--host {} can be reached from other machines, so a token is required: set --token or "
      "RAYTRACER_TOKEN, or listen on 127.0.0.1, ::1 or localhost",
      config.host));
}

/// The table of settings, which --help prints.
class CommandLine {
 public:
  CommandLine();
  CommandLine(const CommandLine&) = delete;  // the options refer to the settings
  CommandLine& operator=(const CommandLine&) = delete;

  /// A text to print, if one was asked for. Throws ConfigError.
  std::optional<Printout> parse(int argc, const char* const* argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::Success& request) {
      std::ostringstream text;
      app_.exit(request, text, text);
      return Printout{text.str()};
    } catch (const CLI::ParseError& error) {
      throw ConfigError(fmt::format("{} (--help lists the flags)", error.what()));
    }
    return {};
  }

  bool quiet = false;
  const Setting* host = nullptr;
  const Setting* port = nullptr;
  const Setting* threads = nullptr;
  std::vector<const Setting*> limits{};  ///< in the order of limit_table
  std::vector<const Setting*> sizes{};   ///< in the order of size_table
  const Setting* token = nullptr;

 private:
  /// The option takes a text; `help` is followed by the default and the variable.
  const Setting* add(std::string flag, std::string variable, const std::string& placeholder,
                     std::string_view help, std::string_view default_text) {
    Setting& setting = settings_.emplace_back(Setting{std::move(flag), std::move(variable)});
    setting.option =
        app_.add_option(setting.flag, setting.from_flag,
                        fmt::format("{}\n[{}] (or {})", help, default_text, setting.variable));
    setting.option->type_name(placeholder);
    return &setting;
  }

  CLI::App app_{"Renders scenes over HTTP. Options override their environment variables."};
  std::deque<Setting> settings_;  ///< addresses stay
};

CommandLine::CommandLine() {
  const Config defaults;
  app_.set_version_flag("--version",
                        fmt::format("raytracer-server {} (build {})", version, build_id));
  app_.add_flag("--quiet", quiet, "Do not log requests to standard error");
  host = add("--host", "RAYTRACER_HOST", "ADDRESS",
             "Address to listen on; beyond loopback --token is required", defaults.host);
  port = add("--port", "RAYTRACER_PORT", "PORT", "Port to listen on; 0 takes a free one",
             std::to_string(defaults.port));
  threads =
      add("--threads", "RAYTRACER_THREADS", "COUNT", "Number of threads that trace", "every core");
  for (const LimitRow& row : limit_table)
    limits.push_back(add(row.flag, row.variable, "COUNT",
                         fmt::format("Maximum number of {}", row.meaning),
                         std::to_string(defaults.limits.*row.value)));
  for (const SizeRow& row : size_table)
    sizes.push_back(add(row.flag, row.variable, "COUNT",
                        fmt::format("Maximum number of {}", row.meaning),
                        std::to_string(defaults.*row.value)));
  token = add("--token", "RAYTRACER_TOKEN", "TOKEN",
              "Bearer token that requests must carry; other users can list it here,\nbut not in "
              "its variable",
              "none");
}

}  // namespace

std::variant<Config, Printout> read_config(int argc, const char* const* argv,
                                           const Environment& environment) {
  CommandLine line;
  if (auto printout = line.parse(argc, argv)) return *std::move(printout);

  Config config;
  config.threads = std::max(1U, std::thread::hardware_concurrency());
  config.quiet = line.quiet;
  if (const auto given = line.host->given(environment)) {
    if (given->text.empty()) refuse(*given, "an address, such as 127.0.0.1");
    config.host = given->text;
  }
  if (const auto given = line.port->given(environment))
    config.port = static_cast<int>(integer_of(*given, 0, 65'535));
  if (const auto given = line.threads->given(environment))
    config.threads = static_cast<std::size_t>(integer_of(*given, 1, 1024));
  for (std::size_t i = 0; i < limit_table.size(); ++i)
    if (const auto given = line.limits[i]->given(environment))
      config.limits.*limit_table[i].value = integer_of(*given, 1, limit_table[i].largest);
  for (std::size_t i = 0; i < size_table.size(); ++i)
    if (const auto given = line.sizes[i]->given(environment))
      config.*size_table[i].value =
          static_cast<std::size_t>(integer_of(*given, 0, size_table[i].largest));
  if (const auto given = line.token->given(environment)) {
    if (!is_token(given->text))
      throw ConfigError(
          fmt::format("{} must be a non-empty text of letters, digits and -._~+/=", given->source));
    config.token = given->text;
  }
  require_token_beyond_loopback(config);
  return config;
}

bool is_loopback(const std::string& host) {
  if (host == "localhost") return true;
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24) == 127;
  in6_addr v6{};
  return inet_pton(AF_INET6, host.c_str(), &v6) == 1 && IN6_IS_ADDR_LOOPBACK(&v6);
}

}  // namespace raytracer
