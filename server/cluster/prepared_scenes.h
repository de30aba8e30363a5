// Scenes of the cluster's jobs, made ready: each travels here once and is built once for each view
// of it, and is kept while there is room.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>

#include "engine/engine.h"
#include "server/cluster/record.h"
#include "server/cluster/store.h"
#include "server/lru_cache.h"
#include "server/metrics.h"
#include "server/scenes.h"

namespace raytracer {

/// A view of a scene with its structures.
struct PreparedView {
  PreparedView(SceneView scene_view, WorkerPool& pool)
      : view(std::move(scene_view)), prepared(view.scene, pool) {}
  PreparedView(const PreparedView&) = delete;
  PreparedView& operator=(const PreparedView&) = delete;

  const SceneView view;
  const PreparedScene prepared;
};

/// Every member function may be called from any thread.
class PreparedScenes {
 public:
  /// Keeps about so many bytes of each: scenes as they were read, and structures; the newest
  /// whatever its size, as it is of all tasks of its job. The others must outlive it.
  PreparedScenes(ClusterStore& store, Scenes& scenes, WorkerPool& pool, Metrics& metrics,
                 std::size_t most_bytes)
      : store_(store),
        scenes_(scenes),
        pool_(pool),
        metrics_(metrics),
        read_(most_bytes, Oversized::kept_alone),
        prepared_(most_bytes, Oversized::kept_alone) {}

  /// The view that the job is of. Throws NatsUnavailable, NatsRefused if its scene is gone, and
  /// HttpError if the limits of the job's front refuse it.
  SceneView view_of(const JobRecord& record);
  std::shared_ptr<const PreparedView> prepare(const JobRecord& record);

  /// Whether a scene with this document is here.
  bool has(const std::string& document) const { return read_.contains(document); }

 private:
  ClusterStore& store_;
  Scenes& scenes_;
  WorkerPool& pool_;
  Metrics& metrics_;
  LruCache<KnownScene> read_;        ///< by the document's digest
  LruCache<PreparedView> prepared_;  ///< by document and query
  std::mutex reading_;               ///< one at a time: two would fetch the same
  std::mutex preparing_;
};

}  // namespace raytracer
