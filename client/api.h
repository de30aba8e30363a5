// The service as the client uses it: requests as functions, answers as values.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "client/interrupts.h"
#include "client/scene_text.h"
#include "client/server_choice.h"

namespace raytracer::client {

struct ShippedScene {
  std::string name;
  std::string description;
};

/// A server of a cluster.
struct ClusterMember {
  std::string name;
  std::string build;
  std::string instruction_set;
  std::int64_t threads = 0;
  std::int64_t tasks_done = 0;
  double last_heard_s = 0;
  bool works = true;  ///< takes tasks
};

struct Cluster {
  std::vector<ClusterMember> members;
  std::int64_t tasks_waiting = 0;
  std::int64_t tasks_running = 0;
  std::int64_t redelivered = 0;  ///< tasks that were given to another worker
};

struct Job {
  std::string id;
  std::string status;   ///< "queued", "running", "done", "failed", "cancelled"
  double progress = 0;  ///< 0 to 1
  std::string detail;   ///< why it failed or was cancelled
};

/// An image and what its headers say; a text is empty where the header is missing.
struct RenderedImage {
  std::string bytes;
  std::string samples;
  std::string error;
  std::string precision;
  std::string stop;
  std::string server_timing;
};

/// One server. Every function may throw ServerError (the message names the URL), InputError for
/// what the server refuses, with a line for each error of a scene, and Interrupted.
class Api {
 public:
  /// Does not connect yet. `interrupts` outlives it and cuts its requests short.
  Api(const ServerUrl& url, const std::string& token, Interrupts& interrupts);
  ~Api();
  Api(const Api&) = delete;
  Api& operator=(const Api&) = delete;

  /// "http://127.0.0.1:8080"
  std::string url() const;

  std::vector<ShippedScene> scenes();
  /// Throws InputError that lists the names if there is none of this one.
  SceneText shipped_scene(const std::string& name);

  /// Throws ServerError with the server's reason if it works alone.
  Cluster cluster();

  /// Returns if the scene is valid; renders nothing.
  void validate(const SceneText& scene);

  /// The server's plan for the scene, a JSON text.
  std::string plan(const SceneText& scene, const Overrides& overrides);

  /// Keeps a scene for later: the name that `scene` in a query may have.
  std::string keep_scene(const SceneText& scene);

  /// If `query` names a scene, it is that one. Throws ServerBusy if no job can be taken
  /// now. `query` may say the task; without it the job is a render. `media_type`: of the picture
  /// that will be fetched; empty for a curve.
  Job start_job(const SceneText& scene, const Overrides& query, std::string_view media_type = {});
  Job job(const std::string& id);
  RenderedImage job_image(const std::string& id, std::string_view media_type);
  /// What a job that is no render has made, a JSON text.
  std::string job_result(const std::string& id);
  /// Waits between two questions.
  void pause(std::chrono::microseconds duration);
  /// Best effort, even after an interruption: throws nothing.
  void delete_job(const std::string& id) noexcept;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace raytracer::client
