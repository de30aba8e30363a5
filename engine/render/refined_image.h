// An image that is refined pixel by pixel, pass by pass.
//
// Each pixel shows the best that was made of it: the image is always whole, and a pass that was
// begun is not lost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "engine/image/image.h"
#include "engine/image/sampled_pixel.h"
#include "engine/render/first_picture.h"
#include "engine/render/preview.h"
#include "engine/render/tracing.h"
#include "engine/sample/pixel_errors.h"
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
  double error2() const { return errors_.error2(); }

  /// The mean over the pixels.
  double mean_samples() const;

  /// Which pixels get how many samples for a goal in terms of error2(), within the time that is
  /// left; as next_samples().
  std::vector<PixelSamples> next_samples(double error2, int most_samples) const;

  /// Gives the pixels their samples. False if not all were done: time was over, or it was stopped.
  bool refine(std::vector<PixelSamples> pixels);
  /// Gives all pixels these samples.
  bool refine_all(const SamplePattern& pattern);

 private:
  /// What a thread does at once.
  struct Task {
    std::size_t block;
    double samples;           ///< in all
    double error2 = 0;        ///< of its pixels, as expected
    std::size_t begin = 0;    ///< of its pixels
    std::size_t end = 0;      ///< of them
    int samples_per_pixel{};  ///< of each
  };

  /// Has run(i) do each of the tasks, in an order that suits them, while there is time. Says which
  /// were done.
  template <typename Run>
  std::vector<char> run_tasks(const std::vector<Task>& tasks, const Run& run);
  bool is_all_done(const std::vector<char>& is_done) const;
  /// Pixels of a block that get as many samples, side by side.
  void sort_into_tasks(std::vector<PixelSamples>& pixels) const;
  /// Those for pixels that are sorted so.
  std::vector<Task> tasks_for(std::span<const PixelSamples> pixels) const;
  /// The pixels of a block.
  Tile tile_of(std::size_t block) const;
  std::size_t block_count() const;
  std::size_t block_of(std::size_t pixel) const;
  /// Of pixels with one sample each, in blocks that were traced, or one part for all.
  void guess_errors(const std::vector<char>& is_traced);
  void guess_errors(std::size_t block, bool is_traced);
  /// Has the errors be expected, and notes how long it took to look at the last pass.
  void expect_errors();
  /// What a sample takes, from a first pass that has just ended.
  void note_first_pass(int samples);

  Tracing& tracing_;
  int width_;
  int height_;
  int columns_;  ///< of blocks
  PixelErrors errors_;
  std::int64_t stand_ins_ =
      0;  ///< pixels that were not traced, but one part of their block for all
  Preview::Whole shown_;
  Image& image_;
  std::map<int, SamplePattern> patterns_{};  ///< by their samples
  double sample_ms_ = 0;                     ///< that one takes all threads together
  double last_sample_ms_ = 0;                ///< when the last pass ended
  double after_ms_ = 0;                      ///< that it took to look at it
};

}  // namespace raytracer
