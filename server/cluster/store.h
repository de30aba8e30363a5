// What a cluster keeps in JetStream; under which names, see subjects.h.
//
// A task is queued only if it is not, and a result is stored only if there is none: whatever is
// done twice, by whomever, counts once.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "server/cluster/nats.h"
#include "server/cluster/record.h"
#include "server/cluster/stored_text.h"

namespace raytracer {

/// A worker or a front, as it says itself.
struct Member {
  std::string name;
  std::string build;
  std::string instruction_set;
  std::string renderer;  ///< see renderer_id_of()
  std::size_t threads = 0;
  std::uint64_t tasks_done = 0;
  bool works = false;
  std::int64_t heard_ms = 0;  ///< when it said so, by NATS's clock
  double silence_s = 0;       ///< from then to the last heartbeat of any
};

/// A task that failed, or that one who took it said nothing of any more.
struct TaskFailure {
  std::string worker;
  std::string reason;
};

/// The tasks of one job, of all that are open.
struct OpenJob {
  std::string id;
  std::string renderer;
  std::string document;
  std::uint64_t waiting = 0;
  std::uint64_t running = 0;
};

struct StoreLimits {
  std::chrono::milliseconds task_timeout{5000};  ///< from a worker's last heartbeat
  std::chrono::seconds longest_kept{24 * 3600};  ///< jobs, results and scenes
  std::int64_t most_bytes = std::int64_t{4} << 30;
  bool changes_longest_kept = false;  ///< also of streams that others made
  bool changes_most_bytes = false;
};

/// Every member function may be called from any thread, and throws as NatsConnection's do.
class ClusterStore {
 public:
  ClusterStore(NatsConnection& nats, const StoreLimits& limits) : nats_(nats), limits_(limits) {}

  const StoreLimits& limits() const { return limits_; }

  /// Makes the streams that are missing.
  void ensure_streams();
  /// Has all streams that there are be as the limits say, whoever made them, where these are to
  /// change them. Returns what that changed of the results' stream, for people; nothing if it was
  /// so.
  std::string change_streams();
  /// Why the streams could not be made when that was last tried, while there was a connection;
  /// empty if they are there.
  std::string trouble() const;
  /// Whether there is none. Waits for nothing.
  bool has_streams() const { return has_streams_; }
  /// Throws NatsUnavailable with the trouble if there is one.
  void require_streams() const;

  /// The digest under which a text is stored.
  static std::string digest_of(std::string_view document);
  /// Stores a job's scene, unless it is stored and stays so for half as long as jobs do. Where
  /// there is no room, those go that no open job needs; the job's record is stored before, so that
  /// it is one of them.
  void put_document(const std::string& digest, std::string_view document);
  /// Throws NatsRefused if it is no longer there.
  std::string document(const std::string& digest);
  /// Stores a posted scene, unless it would push out most of the others.
  void keep_scene(const std::string& id, std::string_view document);
  std::optional<std::string> kept_scene(const std::string& id);

  /// Stores it in place of what it was read from or stored as; false if that was changed or
  /// removed meanwhile.
  bool put_job(JobRecord& record);
  /// Has it fail, unless it is gone or has failed; what was made of it goes in any case.
  void fail_job(const std::string& id, const std::string& reason, bool lacked_room = false);
  std::optional<JobRecord> job(const std::string& id);
  std::vector<std::string> job_ids();
  /// Removes all that belongs to it, and tells who works on it.
  void remove_job(const std::string& id);
  /// Removes what is stored for it beside its record, its consumer last: as long as that is there,
  /// something may be left of a removal that was cut off.
  void remove_rest(const std::string& id, const std::string& renderer);
  /// Whether something of it is still to be made.
  bool is_open(const JobRecord& record);
  /// Takes what is queued of it back: it needs no more.
  void close_job(const JobRecord& record);

  /// Queues those of a job's tasks that are not queued.
  void queue_tasks(const JobRecord& record, const std::vector<int>& tasks);
  std::vector<OpenJob> open_jobs();
  /// How many these are: far cheaper, as each of them is asked for by itself.
  std::size_t open_job_count();
  TaskSource tasks_of(const OpenJob& job);
  /// "raytracer.task.ID.7" as the id and 7.
  static std::pair<std::string, int> task_of(const std::string& subject);

  bool has_result(const std::string& id, int task);
  /// Stores it and tells those who wait; false if there is one, or the job is gone or has failed:
  /// then no result of the job stays.
  bool put_result(const std::string& id, int task, std::string_view bytes);
  std::set<int> results(const std::string& id);
  std::optional<StoredMessage> result(const std::string& id, int task);

  /// A task's delivery of that number was handed back untried or unfinished, so nothing is to be
  /// concluded from it.
  void note_hand_back(const std::string& id, int task, std::uint64_t delivery);
  std::size_t hand_backs(const std::string& id, int task);

  void put_progress(const std::string& id, double fraction);
  double progress(const std::string& id);

  std::vector<TaskFailure> failures(const std::string& id, int task);
  void add_failure(const std::string& id, int task, std::size_t number, const TaskFailure& failure);

  void put_member(const Member& member);
  void remove_member(const std::string& name);
  std::vector<Member> members();

  void note_redelivery(const std::string& id, int task);
  std::uint64_t redelivered();

  StreamFill fill_of_results();

  /// Calls `heard` on another thread when tasks were queued or a job has changed, and for fronts
  /// also when a result was stored.
  std::shared_ptr<const void> listen_for_news(std::function<void()> heard, bool with_results);
  /// Calls `heard` with the id of a job that was removed.
  std::shared_ptr<const void> listen_for_removals(std::function<void(const std::string& id)> heard);

 private:
  StoredText document_at(const std::string& digest) const;
  StoredText kept_at(const std::string& id) const;
  std::vector<StreamSpec> streams() const;
  std::int64_t most_kept_bytes() const { return limits_.most_bytes / 16; }  ///< of posted scenes
  void note_trouble(const std::string& trouble);
  bool is_wanted(const std::string& id);
  void remove_unused_documents();
  void remove_results(const std::string& id);

  NatsConnection& nats_;
  const StoreLimits limits_;
  mutable std::mutex mutex_;
  std::string trouble_;
  std::atomic<bool> has_streams_ = true;  ///< as far as is known
};

}  // namespace raytracer
