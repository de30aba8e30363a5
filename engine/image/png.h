// PNG by stb_image_write, which stays in this pair of files, with a faster compression than its
// own.
#pragma once

#include <span>
#include <string>

#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// An 8-bit PNG of width x height pixels from the top row down, of three bytes each, RGB, or four,
/// RGBA, made on the pool's threads; the same file however many there are.
/// Throws std::bad_alloc, or std::runtime_error if the compressor fails.
std::string encode_png(int width, int height, int channels, std::span<const unsigned char> bytes,
                       WorkerPool& pool);

}  // namespace raytracer
