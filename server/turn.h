// A turn at the worker pool for a client that waits: in the queue, then at work, given up when the
// client leaves or the server ends.
#pragma once

#include <functional>

#include "engine/engine.h"
#include "server/call.h"
#include "server/services.h"

namespace raytracer {

/// Calls work(progress) when it is this request's turn, and returns how long it waited, in
/// milliseconds. Throws Refusal if the queue is full or closed, or if work returns false: it was
/// stopped.
double take_turn(Services& services, const Call& call,
                 const std::function<bool(RenderProgress&)>& work);

}  // namespace raytracer
