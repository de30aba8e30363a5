// Under which names a cluster's data is in JetStream.
//
//   stream                  subjects                            what they hold
//   raytracer_scenes        raytracer.scene.text.DIGEST         a job's scene: in how many chunks
//                           raytracer.scene.chunk.DIGEST.K      each chunk
//   raytracer_kept          raytracer.kept.text.ID, .chunk.ID.K a posted scene, oldest out first
//   raytracer_jobs          raytracer.job.record.ID             its JobRecord
//                           raytracer.job.progress.ID           how far a job of one task is
//                           raytracer.job.failure.ID.TASK.K     why a task failed the K-th time
//                           raytracer.job.back.ID.TASK.K        its K-th delivery was handed back
//   raytracer_tasks         raytracer.task.ID.TASK              the queue, a consumer for each job
//   raytracer_results       raytracer.result.of.ID.TASK         a TaskResult, or its parts' number
//                           raytracer.result.part.ID.TOKEN.K    such a part
//   raytracer_workers       raytracer.worker.NAME               a heartbeat
//   raytracer_redelivered   raytracer.redelivered.ID.TASK       counts what was handed out again
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace raytracer {

namespace stream {

inline constexpr const char* scenes = "raytracer_scenes";
inline constexpr const char* kept = "raytracer_kept";
inline constexpr const char* jobs = "raytracer_jobs";
inline constexpr const char* tasks = "raytracer_tasks";
inline constexpr const char* results = "raytracer_results";
inline constexpr const char* workers = "raytracer_workers";
inline constexpr const char* redelivered = "raytracer_redelivered";

}  // namespace stream

/// Subjects. A part may be `any`: then they are all that match.
namespace subject {

inline constexpr std::string_view any = "*";

/// Where texts in chunks are, see StoredText.
inline constexpr const char* scene = "raytracer.scene";
inline constexpr const char* kept = "raytracer.kept";

inline std::string record(std::string_view id) {
  return fmt::format("raytracer.job.record.{}", id);
}
inline std::string progress(std::string_view id) {
  return fmt::format("raytracer.job.progress.{}", id);
}
template <class Number>
std::string failure(std::string_view id, int task, const Number& number) {
  return fmt::format("raytracer.job.failure.{}.{}.{}", id, task, number);
}
template <class Delivery>
std::string hand_back(std::string_view id, int task, const Delivery& delivery) {
  return fmt::format("raytracer.job.back.{}.{}.{}", id, task, delivery);
}
/// All failures and deliveries that were handed back, of any task.
inline std::string about_tasks(std::string_view id) {
  return fmt::format("raytracer.job.*.{}.>", id);
}

inline constexpr std::string_view of_tasks = "raytracer.task.";
template <class Task>
std::string task(std::string_view id, const Task& task) {
  return fmt::format("{}{}.{}", of_tasks, id, task);
}

template <class Task>
std::string result(std::string_view id, const Task& task) {
  return fmt::format("raytracer.result.of.{}.{}", id, task);
}
template <class Number>
std::string result_part(std::string_view id, std::string_view token, const Number& number) {
  return fmt::format("raytracer.result.part.{}.{}.{}", id, token, number);
}
/// Results and their parts.
inline std::string results(std::string_view id) {
  return fmt::format("raytracer.result.*.{}.>", id);
}

inline std::string worker(std::string_view name) {
  return fmt::format("raytracer.worker.{}", name);
}
inline std::string redelivered(std::string_view id, int task) {
  return fmt::format("raytracer.redelivered.{}.{}", id, task);
}

// Signals, which nobody stores. Of results workers hear nothing: with many of them that would cost
// more than the results.
inline constexpr const char* news = "raytracer.news.*";
inline constexpr const char* news_of_tasks = "raytracer.news.tasks";
inline constexpr const char* news_of_results = "raytracer.news.results";
inline constexpr const char* removals = "raytracer.removed";

}  // namespace subject
}  // namespace raytracer
