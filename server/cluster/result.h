// What a task came to, as it is stored: a line of JSON that says what follows, then the values as
// they lie in memory. Only builds that are alike read each other's (JobRecord::renderer).
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "engine/engine.h"
#include "server/job.h"

namespace raytracer {

struct TaskResult {
  std::string worker;  ///< the name of who made it
  std::variant<RegionRendering<float>, RegionRendering<unsigned char>, Rendering, CurveText> made;
};

std::string to_bytes(const TaskResult& result);
/// Throws NatsRefused if it is none.
TaskResult read_result(std::string_view bytes);

}  // namespace raytracer
