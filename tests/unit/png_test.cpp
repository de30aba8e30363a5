// PNG files, read back by libpng: every byte of every kind of picture, whatever strips and threads
// it was compressed in.

#include "engine/image/png.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "engine/image/encode.h"
#include "tests/golden/picture.h"

namespace raytracer::test {
namespace {

using Bytes = std::vector<unsigned char>;

/// Three bytes a pixel, each made by value(x, y, channel).
Bytes picture_of(int width, int height, const std::function<int(int, int, int)>& value) {
  Bytes bytes;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int channel = 0; channel < 3; ++channel)
        bytes.push_back(static_cast<unsigned char>(value(x, y, channel)));
  return bytes;
}

Bytes flat(int width, int height) {
  return picture_of(width, height, [](int, int, int channel) { return 135 + 30 * channel; });
}

Bytes gradient(int width, int height) {
  return picture_of(width, height, [](int x, int y, int channel) { return x + channel * y / 3; });
}

Bytes noise(int width, int height) {
  std::mt19937 generator(1);
  return picture_of(width, height,
                    [&](int, int, int) { return static_cast<int>(generator() & 0xff); });
}

/// Flat in places and noisy in others, so that strips differ in how well they compress.
Bytes mixture(int width, int height) {
  std::mt19937 generator(2);
  return picture_of(width, height, [&](int x, int y, int channel) {
    const auto random = static_cast<int>(generator() & 0xff);
    return (x / 50 + y / 70) % 3 == 0 ? random : 40 * channel + x / 100;
  });
}

void expect_read_back(int width, int height, const Bytes& rgb) {
  SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
  WorkerPool pool(2);
  const std::string file = encode_png(width, height, 3, rgb, pool);
  const Picture picture = decode_png(file);
  EXPECT_EQ(picture.width, width);
  EXPECT_EQ(picture.height, height);
  EXPECT_TRUE(picture.rgb == rgb);
  // What cannot be compressed is stored: a filter a row, and a little for every strip and chunk.
  EXPECT_LE(file.size(), rgb.size() + static_cast<std::size_t>(height) + rgb.size() / 1000 + 200);
}

TEST(Png, has_every_byte_of_a_picture_of_any_size) {
  // The last have exactly one strip's bytes, then two strips', then a byte or so beside them.
  for (const auto& [width, height] :
       {std::pair{1, 1}, {1, 2},      {2, 1},     {1, 300},   {300, 1},   {257, 3},   {3, 257},
        {37, 61},        {64, 48},    {160, 100}, {150, 120}, {146, 149}, {699, 501}, {701, 499},
        {20'011, 7},     {7, 20'011}, {341, 128}, {341, 256}, {341, 129}, {340, 128}, {342, 256}}) {
    expect_read_back(width, height, flat(width, height));
    expect_read_back(width, height, gradient(width, height));
    expect_read_back(width, height, noise(width, height));
    expect_read_back(width, height, mixture(width, height));
  }
}

/// Strips that depended on the threads would not give the same file.
TEST(Png, is_the_same_file_on_any_number_of_threads) {
  const Bytes rgb = mixture(1501, 777);
  WorkerPool one(1);
  const std::string file = encode_png(1501, 777, 3, rgb, one);
  for (const std::size_t thread_count : {2U, 3U, 7U}) {
    WorkerPool pool(thread_count);
    EXPECT_TRUE(encode_png(1501, 777, 3, rgb, pool) == file) << thread_count << " threads";
  }
}

/// Leaves a value in all 16-bit words of the stack that the next function gets.
[[gnu::noinline]] void fill_the_stack(std::uint16_t value) {
  std::array<volatile std::uint16_t, std::size_t{1} << 18> words;
  for (volatile std::uint16_t& word : words) word = value;
}

/// ISA-L 2.30 leaves how far back matches may be to what the memory held.
TEST(Png, is_the_same_file_whatever_the_stack_held) {
  const Bytes rgb = gradient(20, 8);
  WorkerPool pool(1);
  const std::string file = encode_png(20, 8, 3, rgb, pool);
  for (std::uint16_t value = 0; value < 32; ++value) {
    fill_the_stack(value);
    EXPECT_TRUE(encode_png(20, 8, 3, rgb, pool) == file) << value;
  }
}

TEST(Png, of_four_channels_has_colour_type_6_and_every_byte) {
  constexpr int width = 301;
  constexpr int height = 217;
  std::mt19937 generator(3);
  Bytes rgba(std::size_t{4} * width * height);
  for (unsigned char& byte : rgba) byte = static_cast<unsigned char>(generator() & 0xff);
  WorkerPool pool(2);
  const std::string file = encode_png(width, height, 4, rgba, pool);
  EXPECT_EQ(file.at(24), 8) << "bits";
  EXPECT_EQ(file.at(25), 6) << "RGBA";
  const CoveredPicture picture = decode_covered_png(file);
  EXPECT_EQ(picture.width, width);
  EXPECT_EQ(picture.height, height);
  EXPECT_TRUE(picture.rgba == rgba);
}

TEST(Png, of_a_flat_picture_is_small) {
  WorkerPool pool(2);
  EXPECT_LT(encode_png(3840, 2160, 3, flat(3840, 2160), pool).size(), 250'000U);
}

TEST(Png, has_the_bytes_of_the_ppm) {
  Image image(700, 500);
  for (std::size_t i = 0; i < image.values.size(); ++i)
    image.values[i] = static_cast<float>(static_cast<double>(i * i % 1009) / 1008);
  WorkerPool pool(3);
  const std::string ppm = encode(image, ImageFormat::ppm, pool);
  EXPECT_EQ(decode_png(encode(image, ImageFormat::png, pool)), decode_ppm(ppm));
  for (std::size_t i = 0; i < image.values.size(); ++i)
    ASSERT_EQ(static_cast<unsigned char>(ppm[ppm.size() - image.values.size() + i]),
              to_byte(image.values[i]));
}

/// That the reader of these tests looks at the checksums which the writer combines.
TEST(Png, with_a_wrong_checksum_is_refused) {
  WorkerPool pool(2);
  const std::string file = encode_png(700, 500, 3, mixture(700, 500), pool);
  ASSERT_NO_THROW(decode_png(file));
  constexpr std::size_t end_chunk = 12;
  for (const std::size_t from_end : {end_chunk + 1, end_chunk + 4, end_chunk + 5, end_chunk + 8}) {
    std::string broken = file;
    broken[broken.size() - from_end] ^= 1;
    EXPECT_THROW(decode_png(broken), std::runtime_error) << from_end;
  }
}

}  // namespace
}  // namespace raytracer::test
