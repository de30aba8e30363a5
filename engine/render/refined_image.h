// An image that is refined part by part, pass by pass.
//
// Each part shows the best that was made of it: the image is always whole, and a pass that was
// begun is not lost.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "engine/image/image.h"
#include "engine/render/first_picture.h"
#include "engine/render/preview.h"
#include "engine/render/tracing.h"
#include "engine/sample/missable_spheres.h"
#include "engine/sample/refinement.h"

namespace raytracer {

class RefinedImage {
 public:
  /// Into `image`, which is empty until a first image begins it.
  RefinedImage(Tracing& tracing, Image& image);

  /// With these samples for all pixels. False if it was stopped.
  bool begin(const SamplePattern& pattern);
  /// With a sample per pixel, or what there was time for.
  void begin(FirstPicture first);

  /// Counts spheres that all samples may miss from here on, if there is time to find them.
  void look_for_missable_spheres();

  /// The squared error, the sum over the values, with its uncertainty.
  double error2() const { return conservative_sum(expected_); }

  /// The mean over the pixels.
  double mean_samples() const;

  /// The samples per pixel of each part for a goal in terms of error2(), within the time that is
  /// left; as next_samples().
  std::vector<int> next_samples(double error2, int most_samples) const;

  /// Gives each part so many samples, none where it is 0. False if not all were done: time was
  /// over, or it was stopped.
  bool refine(const std::vector<int>& samples);
  /// Gives all parts these samples.
  bool refine_all(const SamplePattern& pattern);

 private:
  /// Parts of one block that get as many samples as each other.
  struct Task {
    Tile tile;
    int samples;
    std::vector<std::size_t> parts{};
    double error2 = 0;  ///< of the parts, as expected

    double sample_count() const;
  };

  /// False if not all were done.
  bool trace(std::vector<Task> tasks);
  std::vector<Task> tasks_for(const std::vector<int>& samples) const;
  /// Its pixels, those in the image.
  Tile tile_of(std::size_t part) const;
  int pixel_count(std::size_t part) const;
  ImagePart of_one_sample(std::size_t part) const;
  void expect_errors();
  /// What a sample takes, from a first pass that has just ended.
  void note_first_pass(int samples);

  Tracing& tracing_;
  int width_;
  int height_;
  int columns_;  ///< of blocks
  ErrorFall fall_;
  Preview::Whole shown_;
  Image& image_;
  Image finer_{};
  std::optional<MissableSpheres> missable_{};
  std::vector<ImagePart> parts_;  ///< a block's one after another, the blocks row by row
  std::vector<ImagePart> expected_{};
  std::map<int, SamplePattern> patterns_{};  ///< by their samples
  double sample_ms_ = 0;                     ///< that one takes all threads together
  double last_sample_ms_ = 0;                ///< when the last pass ended
  double after_ms_ = 0;                      ///< that it took to look at it
};

}  // namespace raytracer
