// Another renderer, as the programs that measure see it: whether it can draw a scene, what it draws
// differently, and its pictures with the times that it took.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/engine.h"

namespace raytracer::peers {

/// Milliseconds. 0 where a peer has no such stage, or does not tell.
struct PeerTimes {
  double read_ms = 0;   ///< of its scene file
  double build_ms = 0;  ///< of what finds hits
  double trace_ms = 0;
  double whole_ms = 0;  ///< of a program, from its start to its end, with the picture written
};

/// Linear: a scene's transfer is applied by who compares.
struct Drawing {
  PeerTimes times;
  Image image;
  std::string way;  ///< that was the fastest, where the peer has several
};

/// One amount of anti-aliasing.
struct Setting {
  std::string name;
  std::function<Drawing()> draw;
};

/// Settings that cost ever more, and what it takes to go on: an error that is at most this share of
/// the one before.
struct Ladder {
  std::vector<Setting> settings;
  double worth_it;
};

class Peer {
 public:
  Peer() = default;
  virtual ~Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  virtual std::string name() const = 0;
  virtual std::string version() const = 0;

  /// Whether it is a program that is started anew for each picture: that has no warm state, and its
  /// times are as coarse as it prints them.
  virtual bool is_program() const = 0;

  /// Why it cannot draw `scene`; nothing where it can.
  virtual std::optional<std::string> refusal(const Scene& scene) const = 0;

  /// Whether it leaves ambient light out: then its pictures are of the scene without it.
  virtual bool omits_ambient(const Scene& scene) const = 0;

  /// What it is known to draw differently in `scene`, which it can draw.
  virtual std::vector<std::string> differences(const Scene& scene) const = 0;

  /// The scene of all that is drawn from then on, one that it can draw; not timed.
  virtual void set_scene(const Scene& scene) = 0;

  /// With the scene's own number of samples. Throws std::runtime_error if the peer fails.
  virtual Drawing draw() = 0;

  /// What there is to choose from for a given error. Valid until the scene is set again.
  virtual std::vector<Ladder> ladders() = 0;
};

/// The scene that `peer` draws in place of `scene`.
Scene scene_drawn(const Peer& peer, Scene scene);

/// A linear picture as the project stores it.
Image stored(Image linear, Transfer transfer);

}  // namespace raytracer::peers
