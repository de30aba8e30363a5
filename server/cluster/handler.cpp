// GET /cluster: who works, and on how much.
#include <nlohmann/json.hpp>

#include "server/answer.h"
#include "server/handlers.h"
#include "server/problem.h"

namespace raytracer {

void get_cluster(Services& services, Call& call) {
  if (!services.cluster)
    refuse(404, "This server works alone; --nats (RAYTRACER_NATS) makes it a part of a cluster");
  answer_json(call.response, 200, services.cluster->describe());
}

}  // namespace raytracer
