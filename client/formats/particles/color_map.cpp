#include "client/formats/particles/color_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "client/formats/screen_color.h"

namespace raytracer::client {
namespace {

/// At equal distances from 0 to 1, the colours between them in proportion.
using Stops = std::array<std::uint32_t, 33>;

constexpr Stops viridis{
    0x440154, 0x470d60, 0x48186a, 0x482374, 0x472d7b, 0x453781, 0x424086, 0x3e4989, 0x3b528b,
    0x375b8d, 0x33638d, 0x2f6b8e, 0x2c728e, 0x297a8e, 0x26828e, 0x23898e, 0x21918c, 0x1f988b,
    0x1fa088, 0x22a785, 0x28ae80, 0x32b67a, 0x3fbc73, 0x4ec36b, 0x5ec962, 0x70cf57, 0x84d44b,
    0x98d83e, 0xaddc30, 0xc2df23, 0xd8e219, 0xece51b, 0xfde725,
};

constexpr Stops magma{
    0x000004, 0x030312, 0x0a0822, 0x130d34, 0x1d1147, 0x29115a, 0x36106b, 0x440f76, 0x51127c,
    0x5d177f, 0x6a1c81, 0x762181, 0x832681, 0x902a81, 0x9c2e7f, 0xaa337d, 0xb73779, 0xc43c75,
    0xd0416f, 0xdc4869, 0xe75263, 0xef5d5e, 0xf56b5c, 0xf9795d, 0xfc8961, 0xfd9869, 0xfea772,
    0xfeb67c, 0xfec488, 0xfed395, 0xfde2a3, 0xfcf0b2, 0xfcfdbf,
};

constexpr Stops coolwarm{
    0x3b4cc0, 0x445acc, 0x4e68d8, 0x5875e1, 0x6282ea, 0x6c8ff1, 0x779af7, 0x82a6fb, 0x8db0fe,
    0x98b9ff, 0xa3c2fe, 0xaec9fc, 0xb9d0f9, 0xc3d5f4, 0xccd9ed, 0xd5dbe5, 0xdddcdc, 0xe5d8d1,
    0xecd3c5, 0xf1ccb8, 0xf5c4ac, 0xf7ba9f, 0xf7b093, 0xf6a586, 0xf4987a, 0xf08b6e, 0xeb7d62,
    0xe46e56, 0xdd5f4b, 0xd44e41, 0xca3b37, 0xbe242e, 0xb40426,
};

}  // namespace

model::Rgb color_on_map(std::string_view map, float share) {
  const Stops& stops = map == "magma" ? magma : map == "coolwarm" ? coolwarm : viridis;
  const float place = std::clamp(share, 0.0F, 1.0F) * static_cast<float>(stops.size() - 1);
  const auto before = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const float after_share = place - static_cast<float>(before);
  const model::Rgb a = screen_color(stops[before]);
  const model::Rgb b = screen_color(stops[before + 1]);
  model::Rgb color{};
  for (std::size_t i = 0; i < 3; ++i) color[i] = std::lerp(a[i], b[i], after_share);
  return color;
}

}  // namespace raytracer::client
