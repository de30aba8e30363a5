// How the server was told to run: flags over variables over defaults, all checked before anything
// starts, so that nothing is unset or out of range afterwards.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <variant>

#include "engine/engine.h"
#include "server/cross_origin.h"

namespace raytracer {

/// As a part of a cluster; see server/cluster.
struct ClusterConfig {
  std::string nats_url;        ///< empty: this server works alone
  bool is_worker = false;      ///< takes tasks and nothing else
  bool works = true;           ///< takes tasks
  double share_from_ms = 200;  ///< predicted time to trace from which renders are shared
  double task_timeout_s = 5;   ///< from a worker's last heartbeat until others take its tasks
  std::int64_t keep_s = std::int64_t{24} * 3600;    ///< jobs, results and scenes
  std::int64_t max_stored = std::int64_t{4} << 30;  ///< bytes in NATS
  bool names_keep = false;                          ///< was told: others' streams are to be so
  bool names_max_stored = false;
};

/// Every setting; those that no flag or variable names are the defaults here.
struct Config {
  std::string host = "127.0.0.1";
  int port = 8080;  ///< 0: one that is free
  std::size_t threads = 1;
  Limits limits;
  std::size_t max_queue = 64;           ///< renders waiting
  std::size_t max_kept = 256UL << 20;   ///< as size_table says
  std::size_t max_cache = 128UL << 20;  ///< as size_table says
  std::string token;                    ///< empty: none is asked for
  AllowedOrigins allowed_origins{};     ///< whose pages may read answers
  int drain_delay_ms = 0;               ///< between a signal to end and the refusal of new work
  bool quiet = false;                   ///< no line per request
  ClusterConfig cluster{};
};

// Once the server is told to end.
inline constexpr std::chrono::seconds time_to_finish{30};  ///< for what runs
inline constexpr std::chrono::seconds time_to_fetch{5};    ///< after its end, for a job's result

/// A setting of how many there may be, beside the limits of a scene.
struct SizeRow {
  const char* flag;
  const char* variable;
  const char* meaning;
  std::size_t Config::*value;
  std::int64_t largest;
};

// Each of those who wait holds a connection, and most systems give a process 1,024 descriptors.
inline constexpr std::array<SizeRow, 3> size_table{
    {{"--max-queue", "RAYTRACER_MAX_QUEUE", "queued renders", &Config::max_queue, 500},
     {"--max-kept", "RAYTRACER_MAX_KEPT", "bytes of posted scenes to keep", &Config::max_kept,
      1LL << 40},
     {"--max-cache", "RAYTRACER_MAX_CACHE",
      "bytes of images to cache, and as many of parsed scenes", &Config::max_cache, 1LL << 40}}};

/// What all servers of a cluster have together.
struct SharedRow {
  const char* flag;
  const char* variable;
  const char* meaning;
  std::int64_t ClusterConfig::*value;
  bool ClusterConfig::*is_named;
  const char* unit;
  std::int64_t least;
  std::int64_t largest;
};

inline constexpr std::array<SharedRow, 2> shared_table{
    {{"--keep", "RAYTRACER_KEEP", "seconds that NATS keeps jobs, their results and scenes",
      &ClusterConfig::keep_s, &ClusterConfig::names_keep, "SECONDS", 1, 366LL * 24 * 3600},
     {"--max-stored", "RAYTRACER_MAX_STORED", "bytes of all that in NATS",
      &ClusterConfig::max_stored, &ClusterConfig::names_max_stored, "BYTES", 64LL << 20,
      1LL << 50}}};

/// Says which flag and variable, the value, and what is allowed.
class ConfigError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A text to print instead of serving, for --help and --version. Throws ConfigError. A variable
/// that is set but empty counts as not set.
std::variant<Config, std::string> read_config(int argc, const char* const* argv);

}  // namespace raytracer
