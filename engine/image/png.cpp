#include "engine/image/png.h"

#include <stdexcept>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace raytracer {

std::string encode_png(int width, int height, const std::vector<unsigned char>& rgb) {
  std::string file;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                               static_cast<std::size_t>(size));
  };
  constexpr int no_gap_between_rows = 0;
  if (stbi_write_png_to_func(append, &file, width, height, 3, rgb.data(), no_gap_between_rows) == 0)
    throw std::runtime_error("no memory to encode the PNG");
  return file;
}

}  // namespace raytracer
