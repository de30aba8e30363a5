#include "client/shooting.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "client/failure.h"
#include "client/notice.h"
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

  /// Returns when the server has taken the frame, or what is wrong with it.
  std::exception_ptr start(int frame, FrameRequest request) {
    const std::size_t bytes = request.scene.text.size();
    // What is done is not left there: a server keeps only so many images.
    while (!jobs_.empty() && (jobs_.size() >= limit_ || bytes_ + bytes > most_bytes ||
                              jobs_.front().job->has_ended()))
      take_oldest();
    seconds waited{0};
    std::unique_ptr<OwnedJob> job;
    while (!job) {
      try {
        job = started(request);
      } catch (const ServerBusy& busy) {
        make_room(busy, frame, waited);
      } catch (const InputError&) {
        return std::current_exception();
      }
    }
    jobs_.push_back({frame, std::move(request), std::move(job)});
    bytes_ += bytes;
    // Others may have left room since it was busy.
    if (++started_since_limit_ < limit_) return nullptr;
    limit_ = std::min(limit_ + 1, most_jobs);
    started_since_limit_ = 0;
    return nullptr;
  }

  void take_oldest() {
    FrameJob& oldest = jobs_.front();
    film_.add(oldest.frame, image_of(oldest));
    ++added_;
    bytes_ -= oldest.request.scene.text.size();
    jobs_.pop_front();
  }

 private:
  struct FrameJob {
    int frame;
    FrameRequest request;  ///< a server may forget its image
    std::unique_ptr<OwnedJob> job;
  };

  std::unique_ptr<OwnedJob> started(const FrameRequest& request) {
    return std::make_unique<OwnedJob>(api_,
                                      api_.start_job(request.scene, request.query, media_type_));
  }

  std::string image_of(FrameJob& job) {
    constexpr int most_losses = 3;
    seconds waited{0};
    for (int losses = 0;;) {
      try {
        if (!job.job) job.job = started(job.request);
        job.job->wait("rendering",
                      [&](const Job& now) { progress_.show(job.frame, now.progress); });
        return api_.job_image(job.job->id(), media_type_).bytes;
      } catch (const NotFound&) {
        // Done frames were more than it keeps: it was given too many at a time.
        if (++losses > most_losses) throw;
        job.job.reset();
        lower_limit(jobs_.size() / 2);
      } catch (const ServerBusy& busy) {
        wait_for_others(busy, job.frame, waited);
      }
    }
  }

  void lower_limit(std::size_t jobs) {
    limit_ = std::max<std::size_t>(jobs, 1);
    started_since_limit_ = 0;
  }

  /// The server is busy with our frames or with those of others.
  void make_room(const ServerBusy& busy, int frame, seconds& waited) {
    lower_limit(jobs_.size());
    if (jobs_.empty())
      wait_for_others(busy, frame, waited);
    else
      take_oldest();
  }

  void wait_for_others(const ServerBusy& busy, int frame, seconds& waited) {
    if (waited >= patience) throw busy;
    progress_.show_waiting(frame);
    const seconds pause = std::clamp(busy.retry_after(), seconds(1), patience);
    api_.pause(pause);
    waited += pause;
  }

  static constexpr std::size_t most_jobs = 64;           // a server's queue, unless it is told else
  static constexpr std::size_t most_bytes = 256U << 20;  // of scenes, held here and there
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
    end = under_way.start(frame, *std::move(request));
    if (end) break;
  }
  while (!under_way.empty()) under_way.take_oldest();
  if (!end) return;
  if (under_way.added() > 0) notice(film.finish(/*is_whole=*/false));
  std::rethrow_exception(end);
}

}  // namespace raytracer::client
