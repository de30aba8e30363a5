// What the checks of several formats tell: the errors of one reading, as many as a person mends at
// a time, and faces that are none.
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

/// A face that assimp drops without a word.
inline void omit_face_of_few_corners(Reading& reading, int line) {
  reading.omit(line, "face with fewer than three corners left out",
               "faces with fewer than three corners left out");
}

}  // namespace raytracer::client
