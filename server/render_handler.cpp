// POST and GET /render: the scene in, the image out, while the client waits.
#include "engine/engine.h"
#include "server/handlers.h"
#include "server/image_answer.h"
#include "server/query.h"
#include "server/run_admitted.h"
#include "server/scene_request.h"

namespace raytracer {

void post_or_get_render(Services& services, Call& call) {
  const ImageFormat format = require_format(call.request);
  const RenderQuery query = read_query(call.request.target, QueryOf::render);
  const SceneRequest request = read_scene_request(call, query, services);
  const Reproducible digest = reproducible_digest(request);
  const Representation wanted = represent(digest, format, services.renderer_id);
  if (answer_not_modified(call, wanted)) return;
  if (call.is_head()) return answer_image_head(call, wanted);

  const auto make_with = [&](const auto& render, RenderProgress& progress) {
    auto rendering = decltype(render(request.scene, Limits{}, services.pool, progress)){};
    const double queue_ms = run_admitted(services, progress, [&] {
      rendering = render(request.scene, services.config.limits, services.pool, progress);
      return rendering.stop != Stop::cancelled;
    });
    services.metrics.rendered(rendering, digest);
    FinishedImage image = finish_image(rendering, queue_ms, format, services.pool);
    services.metrics.took(Stage::encode, image.stages.encode_ms);
    return image;
  };
  const auto make = [&](RenderProgress& progress) {
    const bool needs_floats =
        holds_floats(format) || sampling_of(request.scene.render) == Sampling::contract;
    return needs_floats ? make_with(render, progress) : make_with(render_bytes, progress);
  };
  const Delivery delivery = services.image_cache.fetch(image_request(call, wanted), make);
  answer_image(call, delivery, request.parse_ms, wanted);
}

}  // namespace raytracer
