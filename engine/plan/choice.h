// A decision, and why it was made in words and numbers.
#pragma once

#include <string>

namespace raytracer {

template <typename T>
struct Choice {
  T value;
  std::string reason;
};

}  // namespace raytracer
