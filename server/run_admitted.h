// Work in an admission slot for a client that waits: in the queue, then at work, given up when it
// is told to stop or the server ends.
#pragma once

#include <functional>

#include "engine/engine.h"
#include "server/services.h"

namespace raytracer {

/// Calls work() once this request is admitted, and returns how long it waited, in milliseconds.
/// Throws HttpError if the queue is full or closed, if `progress.stop` is set before that, or if
/// work returns false: it was stopped.
double run_admitted(Services& services, RenderProgress& progress,
                    const std::function<bool()>& work);

/// What a client is told whose work was stopped. Throws HttpError: 503 if the server ends, 499 if
/// the client has left.
[[noreturn]] void refuse_stopped(Services& services);

}  // namespace raytracer
