// POV-Ray 3.7 as a peer: its program on a scene file, its own account of the time.
//
// n x n samples are its supersampling (+A0.0 +AM1 +Rn without jitter), which adds one ray to each
// pixel. Its anti-aliasing takes means of colours that are not clamped yet.
#pragma once

#include <string>

#include "tests/measure/peers/program.h"
#include "tests/measure/peers/program_peer.h"

namespace raytracer::peers {

class PovrayPeer : public ProgramPeer {
 public:
  explicit PovrayPeer(std::size_t thread_count) : thread_count_(thread_count) {}

  std::string name() const override { return "POV-Ray"; }
  std::string version() const override;
  std::optional<std::string> refusal(const Scene& scene) const override;
  std::vector<std::string> differences(const Scene& scene) const override;
  void set_scene(const Scene& scene) override;
  Drawing draw() override;
  /// Its anti-aliasing methods 1 and 2, several thresholds, ever more depth: method 1 has a limit
  /// of its own, which more depth does not take away.
  std::vector<Ladder> ladders() override;

 private:
  Drawing run(const std::string& antialiasing) const;

  std::size_t thread_count_;
  ProgramFolder folder_;
  int width_ = 0;
  int height_ = 0;
  int samples_ = 1;
};

}  // namespace raytracer::peers
