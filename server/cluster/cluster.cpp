#include "server/cluster/cluster.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>

#include "server/cluster/answered.h"
#include "server/cluster/shared_job.h"
#include "server/problem.h"

namespace raytracer {
namespace {

/// Whether to share, and how to cut, needs no better forecast; workers wait for it.
constexpr double rehearsal_pass_ms = 6;

/// The host's name and what no other server there has; NATS's subjects have no dots within names.
std::string unique_name() {
  std::array<char, 64> host{};
  gethostname(host.data(), host.size() - 1);
  std::string name(host.data());
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '-');
  return fmt::format("{}-{}-{}", name, getpid(), random_id().substr(0, 4));
}

StoreLimits limits_of(const Config& config) {
  return {
      std::chrono::milliseconds(static_cast<std::int64_t>(1000 * config.cluster.task_timeout_s)),
      std::chrono::seconds(config.cluster.keep_s), config.cluster.max_stored,
      config.cluster.names_keep, config.cluster.names_max_stored};
}

/// A front that answers small renders beside large jobs; a worker does nothing else.
bool works_in_background(const ClusterConfig& config) { return config.works && !config.is_worker; }

}  // namespace

Cluster::Cluster(const Parts& parts)
    : parts_(parts),
      self_{unique_name(), parts.renderer_id},
      note_([&log = parts.log](const std::string& text) { log.note(text); }),
      nats_(parts.config.cluster.nats_url, note_),
      store_(nats_, limits_of(parts.config)),
      news_(store_, !parts.config.cluster.is_worker),
      background_(works_in_background(parts.config.cluster)
                      ? std::make_optional<WorkerPool>(parts.config.threads, Priority::background)
                      : std::nullopt),
      scenes_(store_, parts.scenes, task_pool(), parts.metrics, parts.config.max_kept),
      runner_(parts.config.cluster.works
                  ? std::make_optional<TaskRunner>(TaskRunner::Parts{.self = self_,
                                                                     .store = store_,
                                                                     .news = news_,
                                                                     .scenes = scenes_,
                                                                     .pool = task_pool(),
                                                                     .metrics = parts.metrics,
                                                                     .log = parts.log})
                  : std::nullopt),
      jobs_({.self = self_,
             .store = store_,
             .news = news_,
             .scenes = scenes_,
             .admission = parts.admission,
             .pool = parts.pool,
             .limits = parts.config.limits,
             .most_open = parts.config.max_queue + parts.renders_at_once,
             .is_front = !parts.config.cluster.is_worker,
             .metrics = parts.metrics,
             .log = parts.log,
             .choose_cut =
                 [this](const PreparedScene& scene, bool is_8_bit, const RenderProgress& progress) {
                   return cut_if_long(scene, is_8_bit, progress);
                 }}),
      heartbeat_(
          store_, [this] { return describe_self(); }, note_),
      metrics_([this] { look_up_metrics(); }) {}

Member Cluster::describe_self() const {
  return {.name = self_.name,
          .build = std::string(build_id),
          .instruction_set = this_machine().instruction_set.name,
          .renderer = self_.renderer,
          .threads = parts_.config.threads,
          .tasks_done = runner_ ? runner_->tasks_done() : 0,
          .works = parts_.config.cluster.works};
}

std::optional<TaskCut> Cluster::cut_if_long(const PreparedScene& scene, bool is_8_bit,
                                            const RenderProgress& progress) const {
  const double share_from_ms = parts_.config.cluster.share_from_ms;
  if (is_short(scene, share_from_ms, parts_.config.threads)) return {};
  const std::optional<Prediction> prediction = predict(
      scene, parts_.config.limits, parts_.machine_costs, parts_.pool, progress, rehearsal_pass_ms);
  if (!prediction || prediction->trace_ms < share_from_ms) return {};
  return cut_into_tasks(scene, *prediction, is_8_bit);
}

std::optional<TaskCut> Cluster::choose_cut(const PreparedScene& scene, bool is_8_bit,
                                           const RenderProgress& progress) {
  const bool works = parts_.config.cluster.works;
  if (works && is_degraded()) return {};  // it needs nobody else
  const std::optional<TaskCut> cut = cut_if_long(scene, is_8_bit, progress);
  if (!cut || works) return cut;
  return answered([&] {
    if (!has_worker(store_.members(), self_.renderer, store_.limits()))
      refuse(503,
             fmt::format("The render is predicted to trace for {:.0f} ms, which this front leaves "
                         "to workers of its build ({}), and none has been heard of",
                         cut->predicted_ms, self_.renderer),
             {{"Retry-After", "5"}});
    return cut;
  });
}

template <typename Channel>
BasicRendering<Channel> Cluster::render(const SceneView& view, const httplib::Params& query,
                                        const TaskCut& cut, RenderProgress& progress,
                                        Sharing& sharing) {
  constexpr std::chrono::milliseconds longest_silence{250};
  constexpr int most_attempts = 3;  // where NATS loses what it has stored of it
  const auto waiter = parts_.admission.add_waiter(progress);
  for (int attempt = 1;; ++attempt) {
    const JobRecord record = jobs_.begin_render(view, query, cut, sizeof(Channel) == 1);
    struct AtEnd {
      SharedJobs& jobs;
      const std::string& id;
      ~AtEnd() { jobs.end_render(id); }
    } const at_end{jobs_, record.id};

    SharedJob job(record, store_, news_);
    JobState state = job.state();
    for (; !has_ended(state.status); state = job.state()) {
      if (progress.stop) {
        BasicRendering<Channel> stopped;
        stopped.stop = Stop::cancelled;
        return stopped;
      }
      progress.fraction = state.progress;
      job.wait_for_end(longest_silence);
    }
    if (state.status == JobStatus::cancelled && attempt < most_attempts) continue;
    auto rendering = std::get<BasicRendering<Channel>>(job.take_result());
    sharing = job.sharing();
    return rendering;
  }
}
template Rendering Cluster::render(const SceneView&, const httplib::Params&, const TaskCut&,
                                   RenderProgress&, Sharing&);
template ByteRendering Cluster::render(const SceneView&, const httplib::Params&, const TaskCut&,
                                       RenderProgress&, Sharing&);

void Cluster::keep_scene(const std::string& id, std::string_view document) {
  answered([&] { store_.keep_scene(id, document); });
}

JobScene Cluster::scene_of_job(const std::string& id) {
  return answered([&]() -> JobScene {
    const std::optional<JobRecord> record = store_.job(id);
    if (!record) refuse_unknown_job(id);
    try {
      JobScene scene{scenes_.view_of(*record), {record->query.begin(), record->query.end()}};
      scene.view.document = std::make_shared<const std::string>(store_.document(record->document));
      return scene;
    } catch (const NatsRefused& error) {
      refuse(404, fmt::format("The picture would have to be rendered again, but {}", error.what()));
    }
  });
}

std::optional<std::string> Cluster::kept_scene(const std::string& id) {
  return answered([&] { return store_.kept_scene(id); });
}

ClusterState Cluster::state() {
  return answered([&] {
    ClusterState state{.members = store_.members(), .redelivered = store_.redelivered()};
    for (const OpenJob& job : store_.open_jobs()) {
      state.waiting += job.waiting;
      state.running += job.running;
    }
    return state;
  });
}

void Cluster::set_metrics() {
  constexpr std::chrono::milliseconds longest{500};
  parts_.metrics.set("cluster_connected", is_degraded() ? 0 : 1);
  metrics_.refresh(longest);
}

void Cluster::look_up_metrics() {
  Metrics& metrics = parts_.metrics;
  ClusterState now;
  try {
    now = state();
  } catch (const std::exception&) {
    return;
  }
  std::map<JobStatus, std::size_t> jobs = jobs_.counts();
  for (const JobStatus status : job_statuses)
    metrics.set("jobs", static_cast<double>(jobs[status]), {name_of(status)});
  const auto workers = std::count_if(
      now.members.begin(), now.members.end(),
      [&](const Member& member) { return member.works && is_alive(member, store_.limits()); });
  metrics.set("cluster_workers", static_cast<double>(workers));
  metrics.set("cluster_tasks", static_cast<double>(now.waiting), {"waiting"});
  metrics.set("cluster_tasks", static_cast<double>(now.running), {"running"});
  metrics.set("cluster_redelivered_total", static_cast<double>(now.redelivered));
}

void Cluster::drain(std::chrono::milliseconds longest) {
  if (runner_) runner_->drain(longest);
}

}  // namespace raytracer
