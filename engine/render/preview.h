// The picture of a render that is not done yet, for whoever wants to look at it meanwhile.
//
// Threads say which tiles they have finished, and whoever looks copies those: tracing waits for
// nobody, and nothing is copied if nobody looks. Only a change of a whole image waits for a copy.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/image/image.h"
#include "engine/image/tile.h"

namespace raytracer {

class Preview {
 public:
  /// A copy of the tiles that are done, over the last whole image if there is one, else over black.
  /// Nothing before the first tiles are begun, under a budget before the first picture is whole,
  /// for a moment after the first pass, or after the render has ended. From any thread.
  std::optional<Image> so_far() const;

  /// While one exists, its image is being made, tile by tile, and outlives it.
  class Pass {
   public:
    Pass(Preview& preview, const Image& image, const std::vector<Tile>& tiles);
    ~Pass();
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;

    /// From any thread, after the tile's last pixel was written.
    void finished(std::size_t tile) { done_[tile].store(true, std::memory_order_release); }

   private:
    friend class Preview;
    Preview& preview_;
    const Image& image_;
    const std::vector<Tile>& tiles_;
    std::unique_ptr<std::atomic<bool>[]> done_;
  };

  /// While one exists, its image is shown where a pass has nothing yet.
  class Whole {
   public:
    Whole(Preview& preview, Image& image);
    ~Whole();
    Whole(const Whole&) = delete;
    Whole& operator=(const Whole&) = delete;

    /// Has change(Image&) change it.
    template <typename Change>
    void change(const Change& change) {
      const std::scoped_lock lock(preview_.mutex_);
      change(image_);
    }

   private:
    Preview& preview_;
    Image& image_;
  };

 private:
  mutable std::mutex mutex_;
  const Pass* pass_ = nullptr;
  const Image* whole_ = nullptr;
};

}  // namespace raytracer
