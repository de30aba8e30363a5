// What a render will take and give, said before it.
#pragma once

#include <cstddef>
#include <string>

namespace raytracer {

struct Prediction {
  double build_ms = 0;  ///< making the structures
  double trace_ms = 0;
  double samples = 1;  ///< per pixel, of the finished image
  double error = 0;    ///< rms over pixels and channels, as the scene format defines it
  std::size_t thread_count = 1;
  std::string basis;        ///< what the times rest on, in words and numbers
  std::string error_basis;  ///< what the error rests on
};

}  // namespace raytracer
