// What is shown of a render that is not done.
#include "engine/render/preview.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace raytracer {
namespace {

Image filled(float value) {
  Image image(4, 2);
  std::fill(image.values.begin(), image.values.end(), value);
  return image;
}

const std::vector<Tile> halves{{0, 0, 2, 2}, {2, 0, 4, 2}};

TEST(Preview, is_nothing_before_and_after_a_render) {
  Preview preview;
  EXPECT_FALSE(preview.so_far());
  {
    const Image image = filled(1);
    const Preview::Pass pass(preview, image, halves);
    EXPECT_TRUE(preview.so_far());
  }
  EXPECT_FALSE(preview.so_far());
}

TEST(Preview, shows_finished_tiles_over_black) {
  Preview preview;
  const Image image = filled(1);
  Preview::Pass pass(preview, image, halves);
  pass.finished(1);
  const Image seen = preview.so_far().value();
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(seen.pixel(x, y)[2], x < 2 ? 0.0F : 1.0F) << x;
}

TEST(Preview, has_the_channels_of_its_image) {
  Preview preview;
  Image image(4, 2, 4);
  std::fill(image.values.begin(), image.values.end(), 1.0F);
  Preview::Pass pass(preview, image, halves);
  pass.finished(1);
  const Image seen = preview.so_far().value();
  ASSERT_EQ(seen.channels, 4);
  EXPECT_EQ(seen.pixel(1, 1)[3], 0.0F);
  EXPECT_EQ(seen.pixel(2, 1)[3], 1.0F);
}

TEST(Preview, shows_the_last_whole_image_where_a_pass_has_nothing) {
  Preview preview;
  Image image;
  Preview::Whole whole(preview, image);
  EXPECT_FALSE(preview.so_far());
  whole.change([](Image& shown) { shown = filled(0.5F); });
  EXPECT_EQ(preview.so_far().value().pixel(3, 1)[0], 0.5F);
  const Image finer = filled(1);
  Preview::Pass pass(preview, finer, halves);
  pass.finished(0);
  const Image seen = preview.so_far().value();
  EXPECT_EQ(seen.pixel(1, 1)[0], 1.0F);
  EXPECT_EQ(seen.pixel(2, 1)[0], 0.5F);
}

}  // namespace
}  // namespace raytracer
