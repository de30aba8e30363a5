// Images as bytes: the transfer, the rounding, and each format's header and content.

#include "engine/image/encode.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "engine/math/transfer.h"

namespace raytracer::test {
namespace {

TEST(Transfer, linear_changes_nothing) {
  for (const double value : {0.0, 1e-9, 0.18, 0.5, 1.0})
    EXPECT_EQ(encode_channel(value, Transfer::linear), value);
}

TEST(Transfer, srgb_has_its_known_values) {
  const auto srgb = [](double linear) { return encode_channel(linear, Transfer::srgb); };
  EXPECT_EQ(srgb(0), 0);
  EXPECT_NEAR(srgb(1), 1, 1e-15);
  EXPECT_NEAR(srgb(0.001), 0.01292, 1e-15);
  EXPECT_NEAR(srgb(0.0031308), 0.0404499, 1e-6);
  EXPECT_NEAR(srgb(0.5), 0.7353569830524495, 1e-12);
  EXPECT_NEAR(srgb(0.18), 0.46135612950044164, 1e-12);
  EXPECT_NEAR(srgb(0.21404114048223255), 0.5, 1e-12);
  EXPECT_NEAR(srgb(0.2158605), 128 / 255.0, 1e-6);
}

TEST(Transfer, srgb_rises_and_stays_in_range) {
  double last = -1;
  for (int i = 0; i <= 10'000; ++i) {
    const double value = encode_channel(i / 10'000.0, Transfer::srgb);
    EXPECT_GT(value, last);
    EXPECT_LE(value, 1);
    last = value;
  }
}

TEST(ToByte, is_the_floor_of_255c_plus_a_half) {
  EXPECT_EQ(to_byte(0), 0);
  EXPECT_EQ(to_byte(1), 255);
  EXPECT_EQ(to_byte(0.5F), 128);
  EXPECT_EQ(to_byte(std::nextafter(0.5F, 0.0F)), 127);
  EXPECT_EQ(to_byte(1e-30F), 0);
  EXPECT_EQ(to_byte(std::nextafter(1.0F, 0.0F)), 255);
  for (int value = 0; value <= 255; ++value) {
    EXPECT_EQ(to_byte(static_cast<float>(value / 255.0)), value);
    EXPECT_EQ(
        to_byte(static_cast<float>((value + 0.499) / 255.0 > 1 ? 1 : (value + 0.499) / 255.0)),
        value);
    EXPECT_EQ(to_byte(static_cast<float>(std::max(0.0, (value - 0.499) / 255.0))), value);
  }
}

/// Of the decimal fractions these are the ties, and none is a float.
TEST(ToByte, rounds_ties_of_decimals_up) {
  const std::array<int, 5> raised{26, 77, 128, 179, 230};
  for (std::size_t i = 0; i < raised.size(); ++i)
    EXPECT_EQ(to_byte(static_cast<float>(static_cast<double>(2 * i + 1) / 10)), raised[i]);
}

std::string encoded(const Image& image, ImageFormat format) {
  WorkerPool pool(1);
  return encode(image, format, pool);
}

/// 3 x 2 pixels of 18 different bytes: channel k is k / 255, in reading order from the top.
Image sample() {
  Image image(3, 2);
  for (std::size_t i = 0; i < image.values.size(); ++i)
    image.values[i] = static_cast<float>(static_cast<double>(i * 14) / 255);
  return image;
}

TEST(Image, has_its_first_row_on_top) {
  Image image(3, 2);
  std::fill(image.values.begin(), image.values.end(), 0.0F);
  image.pixel(2, 1)[0] = 1;
  EXPECT_EQ(image.values[15], 1);
}

TEST(Ppm, has_its_header_and_the_rows_from_the_top) {
  const std::string file = encoded(sample(), ImageFormat::ppm);
  const std::string header = "P6\n3 2\n255\n";
  ASSERT_EQ(file.size(), header.size() + 18);
  EXPECT_EQ(file.substr(0, header.size()), header);
  for (std::size_t i = 0; i < 18; ++i)
    EXPECT_EQ(static_cast<unsigned char>(file[header.size() + i]), i * 14);
}

TEST(Pfm, has_its_header_and_little_endian_rows_from_the_bottom) {
  const Image image = sample();
  const std::string file = encoded(image, ImageFormat::pfm);
  const std::string header = "PF\n3 2\n-1.0\n";
  ASSERT_EQ(file.size(), header.size() + std::size_t{4} * 18);
  EXPECT_EQ(file.substr(0, header.size()), header);
  for (std::size_t i = 0; i < 18; ++i) {
    std::uint32_t bits = 0;
    for (std::size_t byte = 0; byte < 4; ++byte)
      bits |= std::uint32_t{static_cast<unsigned char>(file[header.size() + 4 * i + byte])}
              << (8 * byte);
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    const std::size_t row_from_top = 1 - i / 9;
    EXPECT_EQ(value, image.values[row_from_top * 9 + i % 9]) << i;
  }
}

/// Two pixels: one half covered by a colour, one by nothing.
Image covered() {
  Image image(2, 1, 4);
  const float values[] = {0.4F, 0.2F, 0.5F, 0.5F, 0, 0, 0, 0};
  std::copy(std::begin(values), std::end(values), image.values.begin());
  return image;
}

TEST(CoveredImage, has_in_a_file_the_colours_without_their_cover) {
  WorkerPool pool(1);
  const ByteImage bytes = to_bytes(covered(), pool);
  EXPECT_EQ(bytes.channels, 4);
  EXPECT_EQ(std::vector<int>(bytes.values.begin(), bytes.values.end()),
            (std::vector{204, 102, 255, 128, 0, 0, 0, 0}));
}

/// A sum's rounding may leave a colour a hair more than its cover.
TEST(CoveredImage, has_no_colour_beyond_white) {
  Image image = covered();
  image.values[0] = std::nextafter(0.5F, 1.0F);
  WorkerPool pool(1);
  EXPECT_EQ(to_bytes(image, pool).values[0], 255);
}

TEST(CoveredImage, is_the_same_on_any_number_of_threads) {
  Image image(641, 479, 4);
  for (std::size_t i = 0; i < image.values.size(); ++i)
    image.values[i] = static_cast<float>(static_cast<double>(i * i % 1009) / 1008);
  WorkerPool one(1);
  const ByteImage expected = to_bytes(image, one);
  for (const std::size_t threads : {2U, 3U, 7U}) {
    WorkerPool pool(threads);
    EXPECT_EQ(to_bytes(image, pool).values, expected.values);
  }
}

TEST(CoveredImage, is_no_file_of_three_channels) {
  WorkerPool pool(1);
  for (const ImageFormat format : {ImageFormat::ppm, ImageFormat::pfm}) {
    EXPECT_FALSE(holds_channels(format, 4));
    EXPECT_THROW(encode(covered(), format, pool), std::logic_error);
  }
  EXPECT_TRUE(holds_channels(ImageFormat::png, 4));
  EXPECT_NO_THROW(encode(covered(), ImageFormat::png, pool));
}

}  // namespace
}  // namespace raytracer::test
