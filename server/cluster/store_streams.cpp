// The streams of a cluster's store: made where they are missing, changed where somebody says so.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "server/cluster/store.h"
#include "server/cluster/subjects.h"

namespace raytracer {
namespace {

constexpr std::chrono::seconds longest_silence{60};  // then a member is forgotten

}  // namespace

std::vector<StreamSpec> ClusterStore::streams() const {
  const auto kept = limits_.longest_kept;
  const std::int64_t all = limits_.most_bytes;
  return {{.name = stream::scenes,
           .subjects = "raytracer.scene.>",
           .most_bytes = all / 4,
           .longest_kept = kept},
          {.name = stream::kept,
           .subjects = "raytracer.kept.>",
           .most_bytes = most_kept_bytes(),
           .longest_kept = kept,
           .drops_oldest = true},
          {.name = stream::jobs,
           .subjects = "raytracer.job.>",
           .most_bytes = all / 8,
           .longest_kept = kept},
          {.name = stream::tasks,
           .subjects = "raytracer.task.>",
           .most_bytes = all / 16,
           .longest_kept = kept,
           .is_queue = true},
          {.name = stream::results,
           .subjects = "raytracer.result.>",
           .most_bytes = all / 2,
           .longest_kept = kept},
          {.name = stream::workers,
           .subjects = "raytracer.worker.>",
           .most_bytes = 16 << 20,
           .longest_kept = longest_silence,
           .is_in_memory = true},
          {.name = stream::redelivered,
           .subjects = "raytracer.redelivered.>",
           .most_bytes = 1 << 20,
           .longest_kept = kept,
           .drops_oldest = true,
           .most_messages = 1}};
}

void ClusterStore::ensure_streams() {
  try {
    for (const StreamSpec& stream : streams()) nats_.ensure_stream(stream);
    note_trouble("");
  } catch (const NatsAway&) {
    throw;  // nothing is known of them
  } catch (const std::exception& error) {
    note_trouble(error.what());
    throw;
  }
}

std::string ClusterStore::change_streams() {
  StreamLimits before;
  for (const StreamSpec& stream : streams()) {
    if (stream.is_in_memory) continue;  // heartbeats: they need what they have
    StreamLimits wish;
    if (limits_.changes_longest_kept) wish.longest_kept = stream.longest_kept;
    if (limits_.changes_most_bytes) wish.most_bytes = stream.most_bytes;
    const StreamLimits changed = nats_.change_stream(stream.name, wish);
    if (stream.name == stream::results) before = changed;
  }
  std::vector<std::string> changes;
  if (before.longest_kept)
    changes.push_back(fmt::format("--keep {} (before: {})", limits_.longest_kept.count(),
                                  before.longest_kept->count()));
  if (before.most_bytes) {
    // As the flag would have to be for that, of which results have half.
    const std::string flag =
        *before.most_bytes < 0 ? "no limit" : std::to_string(2 * *before.most_bytes);
    changes.push_back(fmt::format("--max-stored {} (before: {})", limits_.most_bytes, flag));
  }
  return fmt::format("{}", fmt::join(changes, ", "));
}

void ClusterStore::note_trouble(const std::string& trouble) {
  const std::scoped_lock lock(mutex_);
  trouble_ = trouble;
  has_streams_ = trouble.empty();
}

std::string ClusterStore::trouble() const {
  const std::scoped_lock lock(mutex_);
  return trouble_;
}

void ClusterStore::require_streams() const {
  if (const std::string reason = trouble(); !reason.empty()) throw NatsUnavailable(reason);
}

}  // namespace raytracer
