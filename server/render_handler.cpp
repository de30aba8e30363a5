// POST and GET /render: the scene in, the image out, while the client waits.
#include "engine/engine.h"
#include "server/handlers.h"
#include "server/image_answer.h"
#include "server/problem.h"
#include "server/query.h"
#include "server/scene_request.h"

namespace raytracer {
namespace {

/// Nobody reads this: 499 is what the log then shows.
[[noreturn]] void give_up_on_client() { throw Refusal({499, "The client has left"}); }

[[noreturn]] void refuse_stopped(const Services& services) {
  if (services.admission.is_closed())
    throw Refusal({503, "The server shut down before the render was finished"});
  give_up_on_client();
}

}  // namespace

void post_or_get_render(Services& services, Call& call) {
  const ImageFormat format = demand_format(call.request);
  const RenderQuery query = read_query(call.request.target, QueryOf::render);
  const SceneRequest request = read_scene_request(call, query, services);
  const Reproducible digest = reproducible_digest(request.scene);
  if (answer_not_modified(call, digest, format)) return;
  if (call.is_head()) return answer_image_head(call, digest, format);

  RenderProgress progress;
  const Departures::Watch watch(services.departures, find_socket(ends_of(call.request)),
                                progress.stop);
  Rendering rendering;
  double queue_ms = 0;
  {
    Admission::Place place = services.admission.enter(progress);
    if (!place.wait_for_turn()) refuse_stopped(services);
    queue_ms = place.queue_ms();
    rendering = render(request.scene, services.config.limits, services.pool, progress);
  }
  if (rendering.stop == Stop::cancelled) refuse_stopped(services);
  answer_image(call, rendering, {queue_ms, request.parse_ms}, digest, format);
}

}  // namespace raytracer
