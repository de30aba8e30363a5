// The one file with libpng.
#include "client/png.h"

#include <png.h>

namespace raytracer::client {

std::optional<PngPixels> decode_png(std::string_view bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) return {};
  image.format = PNG_FORMAT_RGBA;
  PngPixels pixels{{static_cast<int>(image.width), static_cast<int>(image.height)},
                   std::vector<unsigned char>(PNG_IMAGE_SIZE(image))};
  if (png_image_finish_read(&image, nullptr, pixels.rgba.data(), 0, nullptr) == 0) return {};
  return pixels;
}

}  // namespace raytracer::client
