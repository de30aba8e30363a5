// Tachyon 0.99 as a peer: its program on a scene file, its own account of the time.
//
// More than one sample are one in the middle and others at random places in and around it.
#pragma once

#include <string>

#include "tests/measure/peers/program.h"
#include "tests/measure/peers/program_peer.h"

namespace raytracer::peers {

class TachyonPeer : public ProgramPeer {
 public:
  explicit TachyonPeer(std::size_t thread_count) : thread_count_(thread_count) {}

  std::string name() const override { return "Tachyon"; }
  std::string version() const override;
  std::optional<std::string> refusal(const Scene& scene) const override;
  std::vector<std::string> differences(const Scene& scene) const override;
  void set_scene(const Scene& scene) override;
  Drawing draw() override { return run(samples_ - 1); }
  /// Ever more samples at random places.
  std::vector<Ladder> ladders() override;

 private:
  Drawing run(int further_samples) const;

  std::size_t thread_count_;
  ProgramFolder folder_;
  bool has_shadows_ = true;
  int samples_ = 1;
};

}  // namespace raytracer::peers
