#include "server/render_answer.h"

#include <optional>
#include <type_traits>

#include "engine/engine.h"
#include "server/run_admitted.h"

namespace raytracer {
namespace {

template <typename Channel>
BasicRendering<Channel> render_here(Services& services, const PreparedScene& scene,
                                    RenderProgress& progress) {
  const Limits& limits = services.config.limits;
  if constexpr (std::is_same_v<Channel, float>)
    return render(scene, limits, services.pool, progress);
  else
    return render_bytes(scene, limits, services.pool, progress);
}

/// Here, or by all if there is a cluster and it takes long.
template <typename Channel>
FinishedImage make_image(Services& services, const SceneView& view, const httplib::Params& query,
                         ImageFormat format, RenderProgress& progress) {
  BasicRendering<Channel> rendering;
  std::optional<TaskCut> cut;
  const double queue_ms = run_admitted(services, progress, [&] {
    const PreparedScene scene(view.scene, services.pool);
    if (services.cluster) cut = services.cluster->choose_cut(scene, sizeof(Channel) == 1, progress);
    if (cut) return true;
    rendering = render_here<Channel>(services, scene, progress);
    return rendering.stop != Stop::cancelled;
  });
  Sharing sharing;
  if (cut) {
    rendering = services.cluster->render<Channel>(view, query, *cut, progress, sharing);
    if (rendering.stop == Stop::cancelled) refuse_stopped(services);
  }
  services.metrics.rendered(rendering, view.picture_digest());
  FinishedImage image = finish_image(rendering, queue_ms, format, services.pool, sharing);
  services.metrics.took("encode", image.stages.encode_ms);
  return image;
}

}  // namespace

void answer_render(Services& services, Call& call, const SceneView& view,
                   const httplib::Params& query, const Representation& wanted) {
  const ImageFormat format = wanted.format;
  const bool is_of_floats = holds_floats(format) || needs_floats(view.scene);
  const auto make = [&](RenderProgress& progress) {
    return is_of_floats ? make_image<float>(services, view, query, format, progress)
                        : make_image<unsigned char>(services, view, query, format, progress);
  };
  const bool from_cache = !forbids_cache(call.request);
  const Delivery delivery =
      services.image_cache.fetch(from_cache ? wanted.tag : std::nullopt, call.request, make);
  if (delivery.cache == "shared") services.metrics.add("renders_shared_total");
  answer_image(call, delivery, view.parse_ms, wanted);
}

}  // namespace raytracer
