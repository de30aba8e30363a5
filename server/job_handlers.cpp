// /jobs: images and curves that are asked for now and fetched later.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>

#include "server/answer.h"
#include "server/handlers.h"
#include "server/image_answer.h"
#include "server/job_events.h"
#include "server/problem.h"
#include "server/render_answer.h"
#include "server/scene_request.h"
#include "server/tradeoff.h"

namespace raytracer {
namespace {

/// What is true of the picture, if there is one.
const RenderReport* report_of(const JobResult* result) {
  if (result == nullptr) return nullptr;
  if (const auto* const floats = std::get_if<Rendering>(result)) return floats;
  return std::get_if<ByteRendering>(result);
}

/// A number that is not known yet is null.
nlohmann::ordered_json to_json(const Job& job) {
  const JobState state = job.state();
  const RenderReport* const report = report_of(job.result());
  nlohmann::ordered_json json{{"id", job.request.id},
                              {"task", name_of(job.request.task)},
                              {"status", name_of(state.status)},
                              {"progress", state.progress},
                              {"samples", nullptr},
                              {"error", nullptr},
                              {"elapsed_ms", state.elapsed_ms}};
  if (report) json["samples"] = report->samples_per_pixel;
  if (report && report->estimated_error) json["error"] = *report->estimated_error;
  if (!state.detail.empty()) json["detail"] = state.detail;
  return json;
}

/// Throws HttpError 404 for a job of the other task.
void require_task(const Job& job, JobTask task) {
  if (job.request.task == task) return;
  refuse(404, fmt::format("The job is a {}: what comes of it is at /jobs/{}/{}",
                          name_of(job.request.task), job.request.id,
                          job.request.task == JobTask::render ? "image" : "result"));
}

/// What came of the job. Throws HttpError 409 if nothing has, yet or at all.
const JobResult& require_result(const Job& job) {
  if (const JobResult* const result = job.result()) return *result;
  const JobState state = job.state();
  if (has_ended(state.status))
    refuse(409, fmt::format("Nothing came of the job: it {} ({})",
                            state.status == JobStatus::failed ? "failed" : "was cancelled",
                            state.detail));
  refuse(409, fmt::format("The job is {}; ask again when it is done", name_of(state.status)),
         {{"Retry-After", "1"}});
}

/// The picture as far as it has come, black before anything is traced; nothing once the job has
/// ended.
std::optional<Image> image_so_far(const Job& job) {
  constexpr std::chrono::milliseconds moment{1};  // between passes there is nothing to see for one
  while (true) {
    if (std::optional<Image> image = job.image_so_far()) return image;
    const JobState state = job.state();
    if (has_ended(state.status)) return {};
    if (state.progress == 0) {
      Image black(job.request.width, job.request.height, job.request.channels);
      std::fill(black.values.begin(), black.values.end(), 0.0F);
      return black;
    }
    job.wait_for_end(moment);
  }
}

/// It will never be the same again, so it has no tag and is not to be stored.
void answer_image_so_far(Services& services, Call& call, const Image& image, ImageFormat format) {
  answer_bytes(call.response, encode(image, format, services.pool),
               std::string(media_type(format)));
  call.response.set_header("Vary", "Accept");
}

/// Takes `task` out of the query, which is known to jobs only.
JobTask take_task(httplib::Params& params) {
  require_given_once(params, "task");
  const auto given = params.find("task");
  const std::string name = given == params.end() ? "render" : given->second;
  params.erase("task");
  for (const JobTask task : {JobTask::render, JobTask::tradeoff})
    if (name == name_of(task)) return task;
  refuse(400, fmt::format("The query parameter \"task\" is \"{}\" but must be render or "
                          "tradeoff",
                          name));
}

}  // namespace

void post_job(Services& services, Call& call) {
  httplib::Params params = call.request.params;
  const JobTask task = take_task(params);
  SceneView view = read_scene_request(call, read_job_query(task, params), services);
  if (task == JobTask::tradeoff) {
    require_valid_settings(params, view.scene);
    require_room_for_curve(view.scene, services.config.limits);
  }
  const auto job = services.jobs().accept(task, std::move(view), call.request.params,
                                          prefers_floats(call.request));
  answer_json(call.response, 202, to_json(*job));
  call.response.set_header("Location", "/jobs/" + job->request.id);
}

void get_job(Services& services, Call& call) {
  answer_json(call.response, 200, to_json(*services.jobs().at(call.captured)));
}

void get_job_image(Services& services, Call& call) {
  const auto job = services.jobs().at(call.captured);
  require_task(*job, JobTask::render);
  const ImageFormat format = require_format(call.request, job->request.channels);
  if (const std::optional<Image> image = image_so_far(*job))
    return answer_image_so_far(services, call, *image, format);
  const JobResult& result = require_result(*job);
  const auto* const bytes = std::get_if<ByteRendering>(&result);
  // Nobody had said that the floats would be wanted: only a cluster's jobs leave them out.
  const bool is_rendered_again = bytes && holds_floats(format);
  const Sharing sharing = job->sharing();
  const Representation wanted = represent(
      job->request.digest, format,
      is_rendered_again || sharing.renderer.empty() ? services.renderer_id : sharing.renderer);
  if (!call.is_head()) job->note_fetched();
  if (answer_without_image(call, wanted)) return;
  if (is_rendered_again) {
    const JobScene scene = services.cluster.value().scene_of_job(job->request.id);
    return answer_render(services, call, scene.view, scene.query, wanted);
  }
  const auto finished = [&](const auto& rendering) {
    return finish_image(rendering, job->state().queue_ms, format, services.pool, sharing);
  };
  const auto image = std::make_shared<const FinishedImage>(
      bytes ? finished(*bytes) : finished(std::get<Rendering>(result)));
  services.metrics.took("encode", image->stages.encode_ms);
  answer_image(call, {image, image->stages}, job->request.parse_ms, wanted);
}

void get_job_result(Services& services, Call& call) {
  const auto job = services.jobs().at(call.captured);
  require_task(*job, JobTask::tradeoff);
  answer_bytes(call.response, std::get<CurveText>(require_result(*job)).json, "application/json");
  if (!call.is_head()) job->note_fetched();
}

void get_job_events(Services& services, Call& call) {
  answer_events(call, services.event_streams, services.jobs().at(call.captured),
                [](const Job& job) { return to_json(job).dump(); });
}

void delete_job(Services& services, Call& call) {
  services.jobs().remove(call.captured);
  call.response.status = 204;
}

}  // namespace raytracer
