// Where the frames of an animation go: numbered files, one animated PNG, or a pipe.
#pragma once

#include <memory>
#include <string>

#include "client/apng.h"

namespace raytracer::client {

/// What -o and --format say.
struct FilmTarget {
  static constexpr const char* numbered_files = "frame-%04d.png";

  /// "FRAMES-%04d.png", "MOTION.apng", or "-" for raw video; if empty that if `is_y4m`, else
  /// numbered_files.
  std::string output;
  bool is_y4m = false;
  FrameRate rate;
  bool resumes = false;
};

class Film {
 public:
  Film() = default;
  virtual ~Film() = default;
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  /// What the frames have to be asked for as.
  virtual std::string media_type() const = 0;
  /// Whether the frame is there from an earlier time. They count from 0.
  virtual bool has(int) { return false; }
  /// In their order. Throws InputError if it cannot be written.
  virtual void add(int frame, const std::string& image) = 0;
  /// After the last one. Says what was made, for people. `is_whole`: no frame is missing; else what
  /// is needed to go on is kept. Throws InputError if it cannot be written.
  virtual std::string finish(bool is_whole) = 0;
};

/// Throws InputError if the target is none, or cannot be written to.
std::unique_ptr<Film> open_film(const FilmTarget& target);

}  // namespace raytracer::client
