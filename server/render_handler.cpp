// POST and GET /render: the scene in, the image out, while the client waits.
#include "engine/engine.h"
#include "server/handlers.h"
#include "server/image_answer.h"
#include "server/query.h"
#include "server/scene_request.h"
#include "server/turn.h"

namespace raytracer {
void post_or_get_render(Services& services, Call& call) {
  const ImageFormat format = demand_format(call.request);
  const RenderQuery query = read_query(call.request.target, QueryOf::render);
  const SceneRequest request = read_scene_request(call, query, services);
  const Reproducible digest = reproducible_digest(request.scene);
  if (answer_not_modified(call, digest, format)) return;
  if (call.is_head()) return answer_image_head(call, digest, format);

  Rendering rendering;
  const double queue_ms = take_turn(services, call, [&](RenderProgress& progress) {
    rendering = render(request.scene, services.config.limits, services.pool, progress);
    return rendering.stop != Stop::cancelled;
  });
  services.metrics.rendered(rendering, digest);
  const Preparation before{queue_ms, request.parse_ms};
  services.metrics.took(Stage::encode,
                        answer_image(call, rendering, before, digest, format, services.pool));
}

}  // namespace raytracer
