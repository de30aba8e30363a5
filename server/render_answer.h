// A picture for a client that waits: from the cache, rendered here, or by all of a cluster.
#pragma once

#include "server/call.h"
#include "server/image_answer.h"
#include "server/scenes.h"
#include "server/services.h"

namespace raytracer {

/// `query`: as for Jobs::accept(). Throws HttpError.
void answer_render(Services& services, Call& call, const SceneView& view,
                   const httplib::Params& query, const Representation& wanted);

}  // namespace raytracer
