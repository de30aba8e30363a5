#include "server/routes.h"

#include <utility>

#include "server/embedded.h"
#include "server/handlers.h"

namespace raytracer {

RouteTable make_routes(Services& services) {
  const auto with = [&services](void (*handler)(Services&, Call&)) -> Handler {
    return [&services, handler](Call& call) { handler(services, call); };
  };
  constexpr bool is_public = true;
  constexpr bool on_workers = true;
  constexpr auto none = RequestBody::none;
  constexpr auto scene = RequestBody::scene;
  std::vector<Route> routes{
      {"POST", "/render", scene, with(post_or_get_render)},
      {"GET", "/render", none, with(post_or_get_render)},
      {"POST", "/plan", scene, with(post_plan)},
      {"POST", "/jobs", scene, with(post_job)},
      {"GET", "/jobs/{id}", none, with(get_job)},
      {"GET", "/jobs/{id}/image", none, with(get_job_image)},
      {"GET", "/jobs/{id}/result", none, with(get_job_result)},
      {"GET", "/jobs/{id}/events", none, with(get_job_events)},
      {"DELETE", "/jobs/{id}", none, with(delete_job)},
      {"GET", "/scenes", none, with(get_scenes)},
      {"POST", "/scenes", scene, with(post_scene)},
      {"GET", "/scenes/{name}", none, with(get_scene)},
      {"GET", "/cluster", none, with(get_cluster)},
      {"GET", "/healthz", none, with(get_health), is_public, on_workers},
      {"GET", "/readyz", none, with(get_readiness), is_public, on_workers},
      {"GET", "/metrics", none, with(get_metrics), !is_public, on_workers},
      {"GET", "/version", none, with(get_version), !is_public, on_workers},
      {"GET", "/schema/scene.json", none, with(get_scene_schema)},
      {"GET", "/openapi.json", none, with(get_openapi)},
  };
  if (services.config.cluster.is_worker) {
    std::erase_if(routes, [](const Route& route) { return !route.on_workers; });
    return RouteTable(std::move(routes));
  }
  // The page is no secret: it asks for the token and sends it with what it asks of the service.
  for (const EmbeddedFile& file : embedded_files()) {
    if (!file.path.starts_with(page_folder)) continue;
    const Handler handler = [&file](Call& call) { get_file(file, call); };
    const std::string path(file.path.substr(page_folder.size()));
    routes.push_back({"GET", path, none, handler, is_public});
    if (path == "/index.html") routes.push_back({"GET", "/", none, handler, is_public});
  }
  return RouteTable(std::move(routes));
}

}  // namespace raytracer
