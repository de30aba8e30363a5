// Errors as they are found, bounded: a hostile document can hold millions of them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "engine/scene/path.h"
#include "engine/scene/result.h"

namespace raytracer {

/// The errors found so far; beyond `most_errors`, or `most_bytes` of their text, it only counts.
class ErrorList {
 public:
  static constexpr std::size_t most_errors = 1000;
  static constexpr std::size_t most_bytes = 1 << 20;

  void add(ErrorKind kind, const Path& path, std::string detail);

  bool empty() const { return count_ == 0; }

  /// Whether the list is closed: what is added only counts, and may as well be added in short.
  bool is_full() const { return errors_.size() == most_errors; }
  void add_unlisted() { ++count_; }

  /// The errors in the order found; a last one says how many more there were.
  std::vector<Error> take() &&;

 private:
  std::vector<Error> errors_;
  std::size_t count_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace raytracer
