#include "server/config.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <sstream>
#include <thread>

#include "engine/engine.h"
#include "server/request_text.h"

namespace raytracer {
namespace {

/// What sets a value: "--port (RAYTRACER_PORT)" in messages.
struct Source {
  std::string flag;
  std::string variable;

  [[noreturn]] void refuse(std::string_view rule) const {
    throw ConfigError(fmt::format("{} ({}) must be {}", flag, variable, rule));
  }
};

std::int64_t integer_of(const std::string& text, const Source& source, std::int64_t least,
                        std::int64_t most) {
  std::int64_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end || value < least || value > most)
    source.refuse(fmt::format("an integer from {} to {}, not \"{}\"", least, most, text));
  return value;
}

double number_of(const std::string& text, const Source& source, double least, double most) {
  const std::optional<double> value = read_double(text);
  if (!value || *value < least || *value > most)
    source.refuse(fmt::format("a number from {} to {}, not \"{}\"", least, most, text));
  return *value;
}

/// Whether only this machine can reach a server that listens on `host`.
bool is_loopback(const std::string& host) {
  if (host == "localhost") return true;
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24) == 127;
  in6_addr v6{};
  return inet_pton(AF_INET6, host.c_str(), &v6) == 1 && IN6_IS_ADDR_LOOPBACK(&v6);
}

void require_meaning(const ClusterConfig& cluster, bool names_no_work) {
  if (cluster.is_worker && cluster.nats_url.empty())
    throw ConfigError("--worker goes with --nats: a worker takes its tasks from NATS");
  if (cluster.is_worker && names_no_work)
    throw ConfigError("--worker and --no-work do not go together: a worker does nothing but work");
  if (names_no_work && cluster.nats_url.empty())
    throw ConfigError("--no-work goes with --nats: others have to do the work");
}

void require_token_beyond_loopback(const Config& config) {
  if (!config.token.empty() || is_loopback(config.host)) return;
  throw ConfigError(fmt::format(
      "--host {} can be reached from other machines, so a token is required: set --token or "
      "RAYTRACER_TOKEN, or listen on 127.0.0.1, ::1 or localhost",
      config.host));
}

/// Each option's help names its variable, for the manual too.
class HelpFormatter : public CLI::Formatter {
  std::string make_option_opts(const CLI::Option* option) const override {
    return option->get_type_name().empty() ? "" : " " + option->get_type_name();
  }
};

/// The table of settings, which --help prints and which writes into a Config.
class CommandLine {
 public:
  explicit CommandLine(Config& config);
  CommandLine(const CommandLine&) = delete;  // the options refer to it
  CommandLine& operator=(const CommandLine&) = delete;

  CLI::App& app() { return app_; }

 private:
  using Read = std::function<void(const std::string& text, const Source&)>;

  CLI::Option* add(const Source& source, const std::string& placeholder, std::string_view help,
                   std::string_view default_text, const Read& read) {
    const auto read_all = [source, read](const std::vector<std::string>& texts) {
      for (const std::string& text : texts) read(text, source);
    };
    return app_
        .add_option_function<std::vector<std::string>>(
            source.flag, read_all,
            fmt::format("{}\n[{}] (or {})", help, default_text, source.variable))
        ->type_name(placeholder)
        ->envname(source.variable)
        ->expected(1);
  }

  void add_number(const Source& source, const std::string& placeholder, std::string_view help,
                  double& value, double least, double most) {
    add(source, placeholder, help, fmt::format("{}", value),
        [&value, least, most](const std::string& text, const Source& from) {
          value = number_of(text, from, least, most);
        });
  }

  /// Of its variable, 1 or true sets it, 0 or false does not.
  void add_flag(const Source& source, std::string_view help, const std::function<void(bool)>& set) {
    app_.add_flag_function(
            source.flag, [set](std::int64_t count) { set(count > 0); },
            fmt::format("{}\n[0] (or {})", help, source.variable))
        ->envname(source.variable)
        ->check(CLI::IsMember({"1", "0", "true", "false"}));
  }

  void add_listening(Config& config);
  void add_limits(Config& config);
  void add_access(Config& config);
  void add_cluster(ClusterConfig& cluster);

  template <typename Integer>
  void add_integer(const Source& source, const std::string& placeholder, std::string_view help,
                   std::string_view default_text, Integer& value, std::int64_t least,
                   std::int64_t most) {
    add(source, placeholder, help, default_text,
        [&value, least, most](const std::string& text, const Source& from) {
          value = static_cast<Integer>(integer_of(text, from, least, most));
        });
  }

  CLI::App app_{"Renders scenes over HTTP. Options override their environment variables."};
};

CommandLine::CommandLine(Config& config) {
  app_.formatter(std::make_shared<HelpFormatter>());
  app_.set_version_flag("--version",
                        fmt::format("raytracer-server {} (build {})", version, build_id));
  add_flag({"--quiet", "RAYTRACER_QUIET"}, "Do not log requests to standard error",
           [&config](bool is_quiet) { config.quiet = is_quiet; });
  add_listening(config);
  add_limits(config);
  add_access(config);
  add_integer({"--drain-delay", "RAYTRACER_DRAIN_DELAY"}, "MS",
              "Milliseconds between a signal to end, when /readyz says draining, and the refusal\n"
              "of new work: time for a load balancer to notice",
              std::to_string(config.drain_delay_ms), config.drain_delay_ms, 0, 60'000);
  add_cluster(config.cluster);
  app_.footer(
      fmt::format("SIGTERM and SIGINT: no new work; what runs has {} s to finish, and a job's "
                  "result {} s to be "
                  "fetched. A second signal ends both.\n",
                  time_to_finish.count(), time_to_fetch.count()));
}

void CommandLine::add_listening(Config& config) {
  add({"--host", "RAYTRACER_HOST"}, "ADDRESS",
      "Address to listen on; beyond loopback --token is required", config.host,
      [&config](const std::string& text, const Source& source) {
        if (text.empty()) source.refuse("an address, such as 127.0.0.1");
        config.host = text;
      });
  add_integer({"--port", "RAYTRACER_PORT"}, "PORT", "Port to listen on; 0 takes a free one",
              std::to_string(config.port), config.port, 0, 65'535);
  add_integer({"--threads", "RAYTRACER_THREADS"}, "COUNT", "Number of threads that trace",
              "every core", config.threads, 1, 1024);
}

void CommandLine::add_limits(Config& config) {
  for (const LimitRow& row : limit_table) {
    std::int64_t& limit = config.limits.*row.value;
    add_integer({row.flag, row.variable}, "COUNT", fmt::format("Maximum number of {}", row.meaning),
                std::to_string(limit), limit, 1, row.largest);
  }
  for (const SizeRow& row : size_table) {
    std::size_t& size = config.*row.value;
    add_integer({row.flag, row.variable}, "COUNT", fmt::format("Maximum number of {}", row.meaning),
                std::to_string(size), size, 0, row.largest);
  }
}

void CommandLine::add_access(Config& config) {
  add({"--token", "RAYTRACER_TOKEN"}, "TOKEN",
      "Bearer token that requests must carry; other users can list it here,\nbut not in its "
      "variable",
      "none", [&config](const std::string& text, const Source& source) {
        // RFC 6750's b64token: what can travel in an Authorization field.
        constexpr std::string_view allowed =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~+/=";
        if (text.empty() || text.find_first_not_of(allowed) != text.npos)
          source.refuse("a non-empty text of letters, digits and -._~+/=");
        config.token = text;
      });
  add({"--allow-origin", "RAYTRACER_ALLOW_ORIGIN"}, "ORIGIN",
      "Pages that may read answers, by their origin, or * for all; repeatable, or a list with "
      "commas",
      "none: pages of other origins may not",
      [&config](const std::string& text, const Source& source) {
        for (const std::string_view part : parts_of(text, ',')) {
          const std::optional<std::string> origin = read_origin(std::string(part));
          if (!origin)
            source.refuse(
                fmt::format("origins as browsers write them, such as https://example.org or "
                            "http://localhost:3000, or *, not \"{}\"",
                            part));
          config.allowed_origins.push_back(*origin);
        }
      })
      ->expected(1, CLI::detail::expected_max_vector_size)
      ->allow_extra_args(false);
}

void CommandLine::add_cluster(ClusterConfig& cluster) {
  add({"--nats", "RAYTRACER_NATS"}, "URL",
      "Share renders and jobs with the servers at this NATS, such as nats://host:4222, or\n"
      "several of one NATS cluster, with commas; its credentials and TLS by NATS_CREDS,\n"
      "NATS_CA, NATS_CERT, NATS_KEY",
      "none: this server works alone", [&cluster](const std::string& text, const Source& source) {
        if (text.empty()) source.refuse("a URL, such as nats://127.0.0.1:4222");
        cluster.nats_url = text;
      });
  add_flag({"--worker", "RAYTRACER_WORKER"},
           "With --nats: take tasks and nothing else; of HTTP only /healthz, /readyz,\n"
           "/metrics and /version",
           [&cluster](bool is_worker) { cluster.is_worker = is_worker; });
  add_flag({"--no-work", "RAYTRACER_NO_WORK"}, "With --nats: take no tasks",
           [&cluster](bool is_idle) { cluster.works = !is_idle; });
  add_number({"--share-from", "RAYTRACER_SHARE_FROM"}, "MS",
             "Share renders that are predicted to trace for so many milliseconds",
             cluster.share_from_ms, 0, 1e9);
  add_number({"--task-timeout", "RAYTRACER_TASK_TIMEOUT"}, "SECONDS",
             "After a worker's last heartbeat, others take its tasks", cluster.task_timeout_s, 0.1,
             3600);
  for (const SharedRow& row : shared_table) {
    add({row.flag, row.variable}, row.unit,
        fmt::format("Maximum number of {};\na server that is told sets it for all", row.meaning),
        std::to_string(cluster.*row.value),
        [&cluster, &row](const std::string& text, const Source& source) {
          cluster.*row.value = integer_of(text, source, row.least, row.largest);
          cluster.*row.is_named = true;
        });
  }
}

}  // namespace

std::variant<Config, std::string> read_config(int argc, const char* const* argv) {
  Config config;
  config.threads = std::max(1U, std::thread::hardware_concurrency());
  CommandLine line(config);
  try {
    line.app().parse(argc, argv);
  } catch (const CLI::Success& request) {
    std::ostringstream text;
    line.app().exit(request, text, text);
    return text.str();
  } catch (const CLI::ExtrasError&) {  // its own words name them in the reverse order
    throw ConfigError(
        fmt::format("'{}' is no flag (--help lists the flags)", line.app().remaining().front()));
  } catch (const CLI::ParseError& error) {
    throw ConfigError(fmt::format("{} (--help lists the flags)", error.what()));
  }
  require_token_beyond_loopback(config);
  require_meaning(config.cluster, !config.cluster.works);
  return config;
}

}  // namespace raytracer
