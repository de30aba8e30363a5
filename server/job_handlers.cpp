// /jobs: renders that are asked for now and fetched later.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "server/answer.h"
#include "server/handlers.h"
#include "server/image_answer.h"
#include "server/problem.h"
#include "server/query.h"
#include "server/scene_request.h"

namespace raytracer {
namespace {

/// A number that is not known yet is null.
nlohmann::ordered_json to_json(const Job& job) {
  const JobState state = job.state();
  const Rendering* const rendering = job.rendering();
  nlohmann::ordered_json json{{"id", job.id},
                              {"task", "render"},
                              {"status", name_of(state.status)},
                              {"progress", state.progress},
                              {"samples", nullptr},
                              {"error", nullptr},
                              {"elapsed_ms", state.elapsed_ms}};
  if (rendering) json["samples"] = rendering->samples_per_pixel;
  if (!state.detail.empty()) json["detail"] = state.detail;
  return json;
}

[[noreturn]] void refuse_without_image(const Job& job) {
  const JobState state = job.state();
  if (state.status == JobStatus::queued || state.status == JobStatus::running)
    throw Refusal({409,
                   fmt::format("The job is {}; its image can be fetched when it is done",
                               name_of(state.status)),
                   {},
                   {{"Retry-After", "1"}}});
  throw Refusal({409, fmt::format("The job has no image: it {} ({})",
                                  state.status == JobStatus::failed ? "failed" : "was cancelled",
                                  state.detail)});
}

}  // namespace

void post_job(Services& services, Call& call) {
  const RenderQuery query = read_query(call.request.target, QueryOf::job);
  if (query.task != "render")
    throw Refusal({400, fmt::format("The query parameter \"task\" is \"{}\", but this build "
                                    "offers \"render\" only",
                                    query.task)});
  const auto job = services.jobs.accept(read_scene_request(call, query, services));
  answer_json(call.response, 202, to_json(*job));
  call.response.set_header("Location", "/jobs/" + job->id);
  call.response.set_header("Cache-Control", "no-store");
}

void get_job(Services& services, Call& call) {
  answer_json(call.response, 200, to_json(*services.jobs.at(call.captured)));
  call.response.set_header("Cache-Control", "no-store");
}

void get_job_image(Services& services, Call& call) {
  const ImageFormat format = demand_format(call.request);
  const auto job = services.jobs.at(call.captured);
  const Rendering* const rendering = job->rendering();
  if (!rendering) refuse_without_image(*job);
  if (answer_not_modified(call, job->digest, format)) return;
  if (call.is_head()) return answer_image_head(call, job->digest, format);
  services.metrics.took(Stage::encode,
                        answer_image(call, *rendering, job->preparation(), job->digest, format));
}

void get_job_events(Services& services, Call& call) {
  answer_events(call, services.event_streams, services.jobs.at(call.captured),
                [](const Job& job) { return to_json(job).dump(); });
}

void delete_job(Services& services, Call& call) {
  services.jobs.remove(call.captured);
  call.response.status = 204;
}

}  // namespace raytracer
