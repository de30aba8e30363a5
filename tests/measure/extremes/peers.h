// POV-Ray and Embree against the exact pictures, where they were found when this was configured.
#pragma once

#include <memory>
#include <string>

#include "tests/extremes/comparison.h"

namespace raytracer::extremes {

/// Wrong pixels as text: "-" for a peer that is not there or a scene that is none of its, with the
/// limits of tests/measure/peers.
class Peers {
 public:
  explicit Peers(WorkerPool& pool);
  ~Peers();
  Peers(const Peers&) = delete;
  Peers& operator=(const Peers&) = delete;

  std::string povray(const Scene& scene, const ExactImage& exact);
  std::string embree(const Scene& scene, const ExactImage& exact);

 private:
  struct Programs;

  WorkerPool& pool_;
  std::unique_ptr<Programs> programs_;  ///< empty where they are not there
};

}  // namespace raytracer::extremes
