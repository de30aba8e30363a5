// The frames of a film, each a job. Several are under way at a time, so that the server works while
// frames are read, fetched and written.
#pragma once

#include <chrono>
#include <functional>
#include <optional>

#include "client/api.h"
#include "client/film.h"
#include "client/progress_bar.h"
#include "client/scene_text.h"

namespace raytracer::client {

/// A frame as it is asked for.
struct FrameRequest {
  SceneText scene;  ///< without a text where the query names it
  Overrides query;
};

/// The next frame, or nothing behind the last one.
using NextRequest = std::function<std::optional<FrameRequest>()>;

/// How far an animation has come, with the time that it still takes where that can be known.
class FilmProgress {
 public:
  /// `count`: of frames; 0: not known.
  explicit FilmProgress(int count) : count_(count) {}

  void show(int frame, double of_frame);
  /// Before that frame, while others keep the server busy.
  void show_waiting(int frame);

  /// Frames before this one were there.
  void skip_to(int frame);

 private:
  double share_before(int frame) const;

  int count_;
  int first_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  ProgressBar bar_;
};

/// Renders all frames that the film does not have, as many at a time as the server takes, and adds
/// them in their order. Throws InputError if something is wrong with a frame; those before it are
/// finished then. Throws ServerBusy if others keep the server busy for minutes.
void shoot(Api& api, const NextRequest& next, Film& film, FilmProgress& progress);

}  // namespace raytracer::client
