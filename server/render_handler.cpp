// POST and GET /render: the scene in, the image out, while the client waits.
#include "server/handlers.h"
#include "server/image_answer.h"
#include "server/query.h"
#include "server/render_answer.h"
#include "server/scene_request.h"

namespace raytracer {

void post_or_get_render(Services& services, Call& call) {
  require_format(call.request);  // before anything is read
  const SceneView view = read_scene_request(call, read_query(call.request.params), services);
  const ImageFormat format = require_format(call.request, channel_count(view.scene));
  const Representation wanted = represent(view.picture_digest(), format, services.renderer_id);
  if (answer_without_image(call, wanted)) return;
  answer_render(services, call, view, call.request.params, wanted);
}

}  // namespace raytracer
