// An image that is refined pixel by pixel, pass by pass.
//
// Each pixel shows the best that was made of it: the image is always whole, and a pass that was
// begun is not lost.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "engine/image/image.h"
#include "engine/render/coarse_picture.h"
#include "engine/render/preview.h"
#include "engine/render/refinement_tasks.h"
#include "engine/render/tracing.h"
#include "engine/sample/pixel_errors.h"
#include "engine/sample/refinement.h"

namespace raytracer {

/// An image under a contract, and what is known of its errors and of the time that samples take.
class RefinedImage {
 public:
  /// Into `image`, which is empty until a first image begins it.
  RefinedImage(Tracing& tracing, Image& image);

  /// With these samples for all pixels. False if it was stopped.
  bool begin(const SamplePattern& pattern);
  /// With a sample per pixel, or what there was time for.
  void begin(CoarsePicture first);

  /// Counts objects that all samples may miss from here on, if there is time to find them. All
  /// pixels have so many samples.
  void look_for_subpixel_objects(int samples);

  /// The squared error, the sum over the values, with its uncertainty: what a contract is held to.
  double error2() const { return errors_.error2(); }
  /// Without: what it probably is.
  double expected_error2() const { return errors_.expected_error2(); }

  /// The mean over the pixels.
  double mean_samples() const;

  /// Which pixels get how many samples for a goal in terms of error2(), within the time that is
  /// left; as choose_samples().
  std::vector<PixelSamples> choose_samples(double goal_error2, int most_samples) const;
  /// What that takes, on one thread, and to look at what came of it. Chosen: a third of what it
  /// takes to take all errors through the transfer was measured, so half.
  double choosing_ms() const {
    return transfer_ms_ * static_cast<double>(tracing_.pool.thread_count()) / 2 + after_ms_;
  }

  /// Gives the pixels their samples. False if not all were done: time was over, or it was stopped.
  bool refine(std::vector<PixelSamples> pixels);
  /// Gives all pixels these samples. False likewise.
  bool refine_all(const SamplePattern& pattern);

 private:
  /// Has run(task) do each of the tasks while there is time, under a budget the most useful first.
  /// Says which were done.
  template <typename Run>
  std::vector<char> run_tasks(const std::vector<RefinementTask>& tasks, const Run& run);
  /// Of pixels with one sample each, or which a subtile stands for, as in a CoarsePicture.
  void guess_errors(const std::vector<std::uint8_t>& coarseness);
  /// Estimates the errors, and notes how long it took to look at the last pass.
  void estimate_errors();
  /// What a sample takes, from a first pass that has just ended.
  void note_first_pass(int samples);

  Tracing& tracing_;
  int width_;
  int height_;
  PixelErrors errors_;
  std::int64_t stand_ins_ = 0;  ///< pixels not traced, but one subtile of their block for all
  Preview::Whole shown_;
  Image& image_;
  std::map<int, SamplePattern> patterns_{};  ///< by their samples
  double sample_ms_ = 0;                     ///< that one takes all threads together
  double last_sample_ms_ = 0;                ///< when the last pass ended
  double after_ms_ = 0;                      ///< that it took to look at it
  double transfer_ms_ = 0;  ///< to take the errors of all pixels through the transfer
};

}  // namespace raytracer
