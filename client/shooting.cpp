#include "client/shooting.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <exception>
#include <string>

#include "client/failure.h"
#include "client/owned_job.h"

namespace raytracer::client {
namespace {

using std::chrono::seconds;

/// The jobs of a film that are not fetched yet.
class UnderWay {
 public:
  UnderWay(Api& api, Film& film, FilmProgress& progress)
      : api_(api), film_(film), progress_(progress), media_type_(film.media_type()) {}

  bool empty() const { return jobs_.empty(); }
  int added() const { return added_; }

  /// Returns when the server has taken the frame.
  void start(int frame, const FrameRequest& request) {
    const std::size_t bytes = request.scene.text.size();
    // What is done is not left there: a server keeps only so many images.
    while (!jobs_.empty() &&
           (jobs_.size() >= limit_ || bytes_ + bytes > most_bytes || jobs_.front().job.has_ended()))
      take_oldest();
    seconds waited{0};
    while (!try_start(frame, request, waited)) continue;
    bytes_ += bytes;
    // Others may have left room since it was busy.
    if (++started_since_limit_ < limit_) return;
    limit_ = std::min(limit_ + 1, most_jobs);
    started_since_limit_ = 0;
  }

  void take_oldest() {
    FrameJob& oldest = jobs_.front();
    oldest.job.wait("rendering",
                    [&](const Job& now) { progress_.show(oldest.frame, now.progress); });
    film_.add(oldest.frame, api_.job_image(oldest.job.id(), media_type_).bytes);
    ++added_;
    bytes_ -= oldest.bytes;
    jobs_.pop_front();
  }

 private:
  struct FrameJob {
    FrameJob(int number, std::size_t size, Api& api, Job started)
        : frame(number), bytes(size), job(api, std::move(started)) {}
    int frame;
    std::size_t bytes;  ///< of its scene
    OwnedJob job;
  };

  /// False if the server was busy and something has been waited for.
  bool try_start(int frame, const FrameRequest& request, seconds& waited) {
    try {
      jobs_.emplace_back(frame, request.scene.text.size(), api_,
                         api_.start_job(request.scene, request.query, media_type_));
      return true;
    } catch (const ServerBusy& busy) {
      limit_ = std::max<std::size_t>(jobs_.size(), 1);
      started_since_limit_ = 0;
      if (!jobs_.empty()) {
        take_oldest();
        return false;
      }
      if (waited >= patience) throw;
      progress_.show_waiting(frame);
      const seconds pause = std::clamp(busy.retry_after(), seconds(1), patience);
      api_.pause(pause);
      waited += pause;
      return false;
    }
  }

  static constexpr std::size_t most_jobs = 64;           // a server's queue, unless it is told else
  static constexpr std::size_t most_bytes = 512U << 20;  // of scenes, which the server holds
  static constexpr seconds patience{300};                // with others, who have the whole server

  Api& api_;
  Film& film_;
  FilmProgress& progress_;
  std::string media_type_;
  std::deque<FrameJob> jobs_;
  std::size_t bytes_ = 0;
  std::size_t limit_ = most_jobs;  ///< as many as the server took when it was busy last
  std::size_t started_since_limit_ = 0;
  int added_ = 0;
};

}  // namespace

double FilmProgress::share_before(int frame) const {
  return count_ > 0 ? static_cast<double>(frame - first_) / (count_ - first_) : 0;
}

void FilmProgress::show(int frame, double of_frame) {
  const double done =
      count_ > 0 ? share_before(frame) + of_frame / static_cast<double>(count_ - first_) : 0;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
  std::string what = count_ > 0 ? fmt::format("frame {} of {}", frame + 1, count_)
                                : fmt::format("frame {}", frame + 1);
  if (done > 0.02) what += fmt::format(", {:.0f} s left", elapsed.count() * (1 / done - 1));
  bar_.show(what, done);
}

void FilmProgress::show_waiting(int frame) {
  bar_.show("waiting for the server, which is busy", share_before(frame));
}

void FilmProgress::skip_to(int frame) { first_ = std::min(frame, count_ > 0 ? count_ - 1 : frame); }

void shoot(Api& api, const NextRequest& next, Film& film, FilmProgress& progress) {
  UnderWay under_way(api, film, progress);
  std::exception_ptr end;  // what is wrong with a frame; those before it are finished
  for (int frame = 0;; ++frame) {
    std::optional<FrameRequest> request;
    try {
      request = next();
    } catch (const InputError&) {
      end = std::current_exception();
    }
    if (!request) break;
    if (film.has(frame)) {
      if (under_way.empty()) progress.skip_to(frame + 1);
      continue;
    }
    under_way.start(frame, *request);
  }
  while (!under_way.empty()) under_way.take_oldest();
  if (!end) return;
  if (under_way.added() > 0) fmt::print(stderr, "{}\n", film.finish());
  std::rethrow_exception(end);
}

}  // namespace raytracer::client
