// Whether a render is shared, and how it is cut into tasks.
#pragma once

#include "engine/engine.h"

namespace raytracer {

struct TaskCut {
  double predicted_ms = 0;  ///< of tracing, here
  double plan_ms = 0;       ///< that were spent here
  double build_ms = 0;
  int side_px = 0;  ///< of its regions; 0: one task makes the whole
  int task_count = 1;
};

/// For how long tasks are cut, of one thread.
inline constexpr double task_s = 0.25;

/// Whether nobody needs to predict that the scene is traced in less than `ms`, even if each ray
/// took many times as long as most do.
bool is_short(const PreparedScene& scene, double ms, std::size_t thread_count);

/// Regions that take one thread some 100 to 500 ms each, and whose values fit into a message. A
/// contract looks at the whole image and is one task.
TaskCut cut_into_tasks(const PreparedScene& scene, const Prediction& prediction, bool is_8_bit);

}  // namespace raytracer
