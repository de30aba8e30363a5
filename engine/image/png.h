// PNG by stb_image_write, which stays in this pair of files.
#pragma once

#include <string>
#include <vector>

namespace raytracer {

/// An 8-bit RGB PNG of width x height pixels, three bytes each from the top row down.
/// Throws std::runtime_error if there is no memory for it.
std::string encode_png(int width, int height, const std::vector<unsigned char>& rgb);

}  // namespace raytracer
