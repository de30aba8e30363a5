// What is measured: every scene, some in more than one size or with more than one sample.
#pragma once

#include <string>
#include <vector>

namespace raytracer::bench {

struct Case {
  std::string scene;  ///< its name
  std::string (*document)();
  int width = 700;
  int height = 500;
  int samples = 1;
  bool is_quick = false;  ///< a second or so for all peers together

  /// "square-500, 3840 x 2160, 16 samples", the usual size and number left out.
  std::string name() const;
};

std::vector<Case> all_cases();

}  // namespace raytracer::bench
