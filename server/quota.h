// So much of something for all requests together, and 429 for who finds nothing left: the memory
// for bodies, event streams.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

namespace raytracer {

/// Every member function may be called from any thread.
class Quota {
 public:
  /// `refusal` is what those are told who find too little left.
  Quota(std::int64_t most, std::string refusal) : most_(most), refusal_(std::move(refusal)) {}

  /// What was taken, given back when nobody holds it any more.
  using Share = std::shared_ptr<const void>;

  /// Throws HttpError 429 if there is not so much left. The share must not outlive this.
  Share take(std::int64_t amount);

  std::int64_t taken() const { return taken_; }

 private:
  const std::int64_t most_;
  const std::string refusal_;
  std::atomic<std::int64_t> taken_{0};
};

}  // namespace raytracer
