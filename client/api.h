// The service as the client uses it: requests as functions, answers as values.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "client/arguments.h"
#include "client/failure.h"
#include "client/image_format.h"
#include "client/interrupts.h"

namespace raytracer::client {

/// One thing that is wrong with a scene.
struct SceneError {
  std::string pointer;  ///< JSON Pointer (RFC 6901)
  std::string detail;
};

/// The server understood and refused: the scene or the arguments are wrong.
class Refused : public InputError {
 public:
  Refused(const std::string& detail, std::vector<SceneError> errors)
      : InputError(detail), errors_(std::move(errors)) {}
  /// Every error of the scene; empty if it is no JSON or something else is wrong.
  const std::vector<SceneError>& errors() const { return errors_; }

 private:
  std::vector<SceneError> errors_;
};

struct ShippedScene {
  std::string name;
  std::string description;
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

/// One daemon. Every function may throw ServerError (the message names the URL), Refused, and
/// Interrupted.
class Api {
 public:
  /// Does not connect yet. `interrupts` outlives it and cuts its requests short.
  Api(const ServerUrl& url, const std::string& token, Interrupts& interrupts);
  ~Api();
  Api(const Api&) = delete;
  Api& operator=(const Api&) = delete;

  std::vector<ShippedScene> scenes();
  /// The document of a scene that scenes() lists.
  std::string scene_document(const std::string& name);

  /// Throws Refused if the scene is not valid; renders nothing.
  void validate(const std::string& scene_text);

  /// The server's plan for the scene, a JSON text.
  std::string plan(const std::string& scene_text, const Overrides& overrides);

  /// `query` may say the task; without it the job is a render.
  Job start_job(const std::string& scene_text, const Overrides& query);
  Job job(const std::string& id);
  RenderedImage job_image(const std::string& id, ImageFormat format);
  /// What a job that is no render has made, a JSON text.
  std::string job_result(const std::string& id);
  /// Waits between two questions.
  void pause(std::chrono::milliseconds duration);
  /// Best effort, even after an interruption: throws nothing.
  void delete_job(const std::string& id) noexcept;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace raytracer::client
