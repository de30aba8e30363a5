// POST /plan: the scene in, what the engine would do with it out.
#include <optional>

#include "engine/engine.h"
#include "server/answer.h"
#include "server/handlers.h"
#include "server/query.h"
#include "server/run_admitted.h"
#include "server/scene_request.h"

namespace raytracer {

void post_plan(Services& services, Call& call) {
  const SceneView view = read_scene_request(call, read_query(call.request.params), services);
  RenderProgress progress;
  const auto watched =
      services.disconnect_watch.watch(call.request, [&] { services.admission.stop(progress); });
  std::optional<Forecast> made;
  run_admitted(services, progress, [&] {
    made = forecast(view.scene, services.config.limits, services.machine_costs(), services.pool,
                    progress);
    return made.has_value();
  });
  services.metrics.predicted(view.picture_digest(), made->prediction);
  answer_bytes(call.response, explain(view.scene, made->plan, made->prediction),
               "application/json");
}

}  // namespace raytracer
