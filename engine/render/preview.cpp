#include "engine/render/preview.h"

#include <algorithm>

namespace raytracer {
std::optional<Image> Preview::so_far() const {
  const std::scoped_lock lock(mutex_);
  const bool has_whole = whole_ != nullptr && whole_->width > 0;
  if (pass_ == nullptr) return has_whole ? std::optional(*whole_) : std::nullopt;
  Image image(pass_->image_.width, pass_->image_.height, pass_->image_.channels);
  if (has_whole)
    image = *whole_;
  else
    std::fill(image.values.begin(), image.values.end(), 0.0F);
  for (std::size_t i = 0; i < pass_->tiles_.size(); ++i)
    if (pass_->done_[i].load(std::memory_order_acquire))
      copy_tile(pass_->image_, pass_->tiles_[i], image);
  return image;
}

Preview::Pass::Pass(Preview& preview, const Image& image, const std::vector<Tile>& tiles)
    : preview_(preview),
      image_(image),
      tiles_(tiles),
      done_(std::make_unique<std::atomic<bool>[]>(tiles.size())) {
  const std::scoped_lock lock(preview_.mutex_);
  preview_.pass_ = this;
}

Preview::Pass::~Pass() {
  const std::scoped_lock lock(preview_.mutex_);
  preview_.pass_ = nullptr;
}

Preview::Whole::Whole(Preview& preview, Image& image) : preview_(preview), image_(image) {
  const std::scoped_lock lock(preview_.mutex_);
  preview_.whole_ = &image_;
}

Preview::Whole::~Whole() {
  const std::scoped_lock lock(preview_.mutex_);
  preview_.whole_ = nullptr;
}

}  // namespace raytracer
