// A scene planned and built, once for everything that is traced of it: a forecast, a picture, or
// the regions of a picture that several machines share.
#pragma once

#include <memory>

#include "engine/parallel/worker_pool.h"
#include "engine/plan/plan.h"
#include "engine/scene/scene.h"

namespace raytracer {

struct BuiltScene;

class PreparedScene {
 public:
  /// Plans and builds, on the pool's threads. `scene` must outlive it.
  PreparedScene(const Scene& scene, WorkerPool& pool);
  ~PreparedScene();
  PreparedScene(PreparedScene&&) noexcept;
  PreparedScene& operator=(PreparedScene&&) = delete;

  const Scene& scene() const;
  const Plan& plan() const;
  double plan_ms() const;  ///< that it took to pack and to plan
  double build_ms() const;
  /// What the engine's own stages work on.
  const BuiltScene& built() const { return *built_; }

 private:
  std::unique_ptr<const BuiltScene> built_;
};

}  // namespace raytracer
