#include "server/cluster/collector.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "server/cluster/result.h"

namespace raytracer {

bool Collector::collect(const JobRecord& record) {
  if (record.task_count == 0 || is_complete(record)) return false;
  const std::size_t before = done_.size();
  for (const int task : store_.results(record.id)) {
    if (done_.contains(task)) continue;
    std::optional<StoredMessage> message = store_.result(record.id, task);
    if (!message) continue;
    add(record, std::move(*message));
    done_.insert(task);
  }
  if (record.is_whole() && done_.empty()) whole_progress_ = store_.progress(record.id);
  return done_.size() > before;
}

std::chrono::microseconds Collector::least_period(const JobRecord& record) {
  constexpr std::chrono::microseconds least{5000};
  constexpr std::chrono::microseconds for_each_task{20};
  return std::max(least, record.task_count * for_each_task);
}

bool Collector::is_complete(const JobRecord& record) const {
  return record.task_count > 0 && (std::holds_alternative<Rendering>(made_) ||
                                   static_cast<int>(done_.size()) >= record.task_count);
}

double Collector::progress(const JobRecord& record) const {
  if (record.task_count == 0) return 0;
  if (record.is_whole() && done_.empty()) return whole_progress_;
  return static_cast<double>(done_.size()) / record.task_count;
}

void Collector::add(const JobRecord& record, StoredMessage message) {
  // A front that was thought dead may have rendered the whole while others had it in regions.
  if (std::holds_alternative<Rendering>(made_)) return;
  TaskResult result = read_result(message.data);
  workers_.insert(result.worker);
  last_ms_ = std::max(last_ms_, message.time_ms);
  const auto add_region = [&]<typename Channel>(const RegionRendering<Channel>& part) {
    using Whole = ImageOfRegions<Channel>;
    if (!std::holds_alternative<Whole>(made_))
      made_.emplace<Whole>(record.width, record.height, record.samples, record.channels);
    try {
      std::get<Whole>(made_).add(part);
    } catch (const std::invalid_argument& error) {
      throw NatsRefused(std::string("a task's result is not of this job: ") + error.what());
    }
  };
  if (auto* const floats = std::get_if<RegionRendering<float>>(&result.made)) {
    add_region(*floats);
  } else if (auto* const bytes = std::get_if<RegionRendering<unsigned char>>(&result.made)) {
    add_region(*bytes);
  } else if (auto* const whole = std::get_if<Rendering>(&result.made)) {
    made_ = std::move(*whole);
  } else {
    made_ = std::move(std::get<CurveText>(result.made));
  }
}

std::optional<Image> Collector::image_so_far() const {
  if (const auto* const floats = std::get_if<ImageOfRegions<float>>(&made_))
    return floats->so_far();
  const auto* const bytes = std::get_if<ImageOfRegions<unsigned char>>(&made_);
  if (bytes == nullptr) return {};
  const ByteImage& rounded = bytes->so_far();
  Image image(rounded.width, rounded.height);
  std::transform(rounded.values.begin(), rounded.values.end(), image.values.begin(),
                 [](unsigned char value) { return static_cast<float>(value) / 255; });
  return image;
}

JobResult Collector::take_result(const JobRecord& record) {
  const auto with_times = [&](auto rendering) {
    rendering.plan_ms = record.plan_ms;
    rendering.build_ms = record.build_ms;
    rendering.trace_ms =
        static_cast<double>(std::max(last_ms_ - record.stored_ms, std::int64_t{0}));
    return JobResult(std::move(rendering));
  };
  if (auto* const floats = std::get_if<ImageOfRegions<float>>(&made_))
    return with_times(std::move(*floats).finish());
  if (auto* const bytes = std::get_if<ImageOfRegions<unsigned char>>(&made_))
    return with_times(std::move(*bytes).finish());
  if (auto* const whole = std::get_if<Rendering>(&made_)) return std::move(*whole);
  return std::get<CurveText>(std::move(made_));
}

}  // namespace raytracer
