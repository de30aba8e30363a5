// Errors as they are found, bounded: a hostile document can hold millions of them.
#pragma once

#include <concepts>
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

  /// The same with what describe() returns, which is not asked for errors that are only counted.
  template <std::invocable Describe>
  void add(ErrorKind kind, const Path& path, const Describe& describe) {
    if (is_full())
      ++count_;
    else
      add(kind, path, describe());
  }

  /// An error of kind `invalid` that is about the name at the path's end.
  template <std::invocable Describe>
  void add_about_key(const Path& path, const Describe& describe) {
    const std::size_t listed = errors_.size();
    add(ErrorKind::invalid, path, describe);
    if (errors_.size() > listed) errors_.back().is_about_key = true;
  }

  bool empty() const { return count_ == 0; }

  /// The errors in the order found; a last one says how many more there were.
  std::vector<Error> take() &&;

 private:
  bool is_full() const { return errors_.size() == most_errors; }

  std::vector<Error> errors_;
  std::size_t count_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace raytracer
