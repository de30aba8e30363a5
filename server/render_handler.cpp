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
  const SceneView view = read_scene_request(call, read_query(call.request.params), services);
  const std::optional<std::string> digest = view.picture_digest();
  const Representation wanted = represent(digest, format, services.renderer_id);
  if (answer_without_image(call, wanted)) return;

  const auto make_with = [&](const auto& render, RenderProgress& progress) {
    auto rendering = decltype(render(view.scene, Limits{}, services.pool, progress)){};
    const double queue_ms = run_admitted(services, progress, [&] {
      rendering = render(view.scene, services.config.limits, services.pool, progress);
      return rendering.stop != Stop::cancelled;
    });
    services.metrics.rendered(rendering, digest);
    FinishedImage image = finish_image(rendering, queue_ms, format, services.pool);
    services.metrics.took("encode", image.stages.encode_ms);
    return image;
  };
  const auto make = [&](RenderProgress& progress) {
    const bool needs_floats =
        holds_floats(format) || sampling_of(view.scene.render) == Sampling::contract;
    return needs_floats ? make_with(render, progress) : make_with(render_bytes, progress);
  };
  const bool from_cache = !forbids_cache(call.request);
  const Delivery delivery =
      services.image_cache.fetch(from_cache ? wanted.tag : std::nullopt, call.request, make);
  if (delivery.cache == "shared") services.metrics.add("renders_shared_total");
  answer_image(call, delivery, view.parse_ms, wanted);
}

}  // namespace raytracer
