// So much of something for all requests together, and 429 for who finds nothing left: the memory
// for bodies, event streams.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace raytracer {

/// Every member function may be called from any thread.
class Quota {
 public:
  /// When somebody who is refused may try again, in seconds.
  using RetryAfter = std::function<long()>;

  /// `refusal` is what those are told who find too little left.
  Quota(std::int64_t most, std::string refusal, RetryAfter retry_after_s)
      : most_(most), refusal_(std::move(refusal)), retry_after_s_(std::move(retry_after_s)) {}

  /// What one request has taken so far, given back at the end. It must not outlive the quota.
  class Portion {
   public:
    explicit Portion(Quota& quota) : quota_(quota) {}
    ~Portion() { quota_.taken_ -= amount_; }
    Portion(const Portion&) = delete;
    Portion& operator=(const Portion&) = delete;

    /// Takes so much more. Throws HttpError 429 if there is not so much left.
    void add(std::int64_t amount);

   private:
    Quota& quota_;
    std::int64_t amount_ = 0;
  };

  /// A portion that ends when nobody holds it any more.
  using Share = std::shared_ptr<Portion>;

  /// Throws HttpError 429 if there is not so much left.
  Share take(std::int64_t amount);

  std::int64_t taken() const { return taken_; }

 private:
  const std::int64_t most_;
  const std::string refusal_;
  const RetryAfter retry_after_s_;
  std::atomic<std::int64_t> taken_{0};
};

}  // namespace raytracer
