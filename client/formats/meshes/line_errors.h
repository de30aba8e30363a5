// The errors that one reading of a file tells: as many as a person mends at a time.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "client/formats/reading.h"

namespace raytracer::client {

class LineErrors {
 public:
  /// Adds to those of `reading`, which outlives it.
  explicit LineErrors(Reading& reading) : errors_(reading.errors) {}

  /// Another one is not wanted.
  bool are_enough() const { return errors_.size() >= most; }
  void add(int line, std::string what) {
    if (!are_enough()) errors_.push_back({line, std::move(what)});
  }

 private:
  static constexpr std::size_t most = 20;
  std::vector<LineError>& errors_;
};

}  // namespace raytracer::client
