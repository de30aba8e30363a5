// What a cluster stores, seen and changed without a server: as another server would, or a broken
// one.
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "server/cluster/store.h"
#include "tests/process/patience.h"

namespace raytracer::test {

class Stored {
 public:
  explicit Stored(const std::string& url, const StoreLimits& limits = {})
      : connection(url), store(connection, limits) {
    if (!eventually([&] { return connection.is_connected(); }))
      throw std::runtime_error("no connection to " + url);
  }

  /// A job of the scene in tasks of `side_px`, not stored yet; its scene is unless `document` is
  /// empty.
  JobRecord new_job(const std::string& id, const std::string& renderer, const std::string& document,
                    int size_px, int side_px, int task_count) {
    JobRecord record{.id = id,
                     .document = ClusterStore::digest_of(document),
                     .renderer = renderer,
                     .front = "another",
                     .width = size_px,
                     .height = size_px,
                     .accepted_ms = now_ms(),
                     .side_px = side_px,
                     .task_count = task_count};
    if (!document.empty()) store.put_document(record.document, document);
    return record;
  }

  /// Stores it and queues all of its tasks.
  void queue(JobRecord record) {
    store.put_job(record);
    std::vector<int> tasks(static_cast<std::size_t>(record.task_count));
    for (std::size_t i = 0; i < tasks.size(); ++i) tasks[i] = static_cast<int>(i);
    store.queue_tasks(record, tasks);
  }

  /// The renderer of a worker that is there.
  std::string renderer() {
    for (const Member& member : store.members())
      if (member.works) return member.renderer;
    return "";
  }

  /// The subjects of all that is stored for jobs.
  std::vector<std::string> of_jobs() {
    std::vector<std::string> all;
    for (const char* const stream : {"raytracer_jobs", "raytracer_tasks", "raytracer_results"})
      for (const std::string& subject : connection.subjects(stream, ">")) all.push_back(subject);
    for (const OpenJob& job : store.open_jobs()) all.push_back("consumer of " + job.id);
    return all;
  }

  NatsConnection connection;
  ClusterStore store;
};

}  // namespace raytracer::test
