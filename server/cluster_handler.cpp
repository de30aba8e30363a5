// GET /cluster: who works, and on how much.
#include <nlohmann/json.hpp>

#include "server/answer.h"
#include "server/handlers.h"
#include "server/problem.h"

namespace raytracer {

void get_cluster(Services& services, Call& call) {
  if (!services.cluster)
    refuse(404, "This server works alone; --nats (RAYTRACER_NATS) makes it a part of a cluster");
  const ClusterState state = services.cluster->state();
  nlohmann::ordered_json workers = nlohmann::ordered_json::array();
  nlohmann::ordered_json fronts = nlohmann::ordered_json::array();  // that take no tasks
  for (const Member& member : state.members)
    (member.works ? workers : fronts)
        .push_back({{"name", member.name},
                    {"build", member.build},
                    {"instruction_set", member.instruction_set},
                    {"renderer", member.renderer},
                    {"threads", member.threads},
                    {"tasks_done", member.tasks_done},
                    {"last_heard_s", member.silence_s}});
  answer_json(call.response, 200,
              {{"workers", workers},
               {"fronts", fronts},
               {"tasks", {{"waiting", state.waiting}, {"running", state.running}}},
               {"redelivered", state.redelivered}});
}

}  // namespace raytracer
