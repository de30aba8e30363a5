// A job of the cluster, as it is stored for all who have a part in it.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "engine/engine.h"
#include "server/cluster/nats.h"
#include "server/job.h"

namespace raytracer {

struct JobRecord {
  std::string id{};
  JobTask task = JobTask::render;
  std::string document{};                      ///< digest of the scene's text, see ClusterStore
  std::map<std::string, std::string> query{};  ///< the request's, which stands over the document
  std::string renderer{};                      ///< who may trace it: see renderer_id_of()
  std::string front{};                         ///< the name of who accepted it
  bool has_client = false;                     ///< somebody waits at that front: it ends with it
  bool is_8_bit = false;                       ///< its regions' channels are; else floats
  std::optional<std::string> picture_digest{};
  double parse_ms = 0;
  double queue_ms = 0;        ///< that it waited to be admitted on the front that cut it
  double predicted_ms = 0;    ///< that it traces for, on the front that cut it
  double plan_ms = 0;         ///< that it took to plan there
  double build_ms = 0;        ///< and to build its structures
  Limits limits{};            ///< of that front: what it admits is made
  double task_timeout_s = 5;  ///< from a worker's last heartbeat, at that front
  int width = 0;
  int height = 0;
  int channels = 3;
  int samples = 1;
  std::int64_t accepted_ms = 0;  ///< since 1970
  int side_px = 0;               ///< of its regions; 0: one task makes the whole
  int task_count = 0;            ///< 0: not cut yet
  std::string failure{};         ///< why it failed, if it did
  bool lacked_room = false;      ///< it failed because the store was full
  std::uint64_t sequence = 0;    ///< of what is stored; 0: nothing yet
  std::int64_t stored_ms = 0;    ///< when it was, since 1970, of one that was read

  /// Whether one task makes all of it.
  bool is_whole() const { return side_px == 0; }
  std::chrono::milliseconds task_timeout() const {
    return std::chrono::milliseconds(static_cast<std::int64_t>(1000 * task_timeout_s));
  }
};

/// As another build stored it, or damaged.
class UnreadableRecord : public NatsRefused {
  using NatsRefused::NatsRefused;
};

std::string to_text(const JobRecord& record);
/// Throws UnreadableRecord if it is none.
JobRecord read_record(std::string_view text);

/// Milliseconds since 1970.
std::int64_t now_ms();

}  // namespace raytracer
