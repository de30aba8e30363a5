#include "engine/image/png.h"

#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>

#include "engine/image/isal.h"

namespace raytracer {
namespace {

/// What stb_image_write's hook, which has no parameter for it, needs and leaves.
struct Compression {
  WorkerPool& pool;
  std::exception_ptr failure;
};
thread_local Compression* compression = nullptr;

/// As stb_image_write wants it: memory of malloc's, or null after a failure.
unsigned char* compress(unsigned char* bytes, int size, int* compressed_size) {
  try {
    const LargeArray<unsigned char> stream =
        compress_zlib({bytes, static_cast<std::size_t>(size)}, compression->pool);
    auto* const result = static_cast<unsigned char*>(std::malloc(stream.size()));
    if (result == nullptr) throw std::bad_alloc();
    std::memcpy(result, stream.data(), stream.size());
    *compressed_size = static_cast<int>(stream.size());
    return result;
  } catch (...) {
    compression->failure = std::current_exception();
    return nullptr;
  }
}

}  // namespace
}  // namespace raytracer

#define STBIW_ZLIB_COMPRESS(bytes, size, compressed_size, level) \
  raytracer::compress(bytes, size, compressed_size)
#define STBIW_CRC32(bytes, size) raytracer::crc32({bytes, static_cast<std::size_t>(size)})
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

namespace raytracer {

namespace {

// Set once, before any thread runs: "up", byte minus the byte above it, the cheapest that leaves
// little of a rendered picture. The best of all filters for each row takes ten times as long, for
// a file of the same size.
[[maybe_unused]] const int up_filter = stbi_write_force_png_filter = 2;

}  // namespace

std::string encode_png(int width, int height, std::span<const unsigned char> rgb,
                       WorkerPool& pool) {
  constexpr int no_gap_between_rows = 0;
  Compression own{pool, nullptr};
  compression = &own;
  int size = 0;
  const std::unique_ptr<unsigned char, decltype(&std::free)> file(
      stbi_write_png_to_mem(rgb.data(), no_gap_between_rows, width, height, 3, &size), &std::free);
  compression = nullptr;
  if (own.failure) std::rethrow_exception(own.failure);
  if (!file) throw std::bad_alloc();
  return {reinterpret_cast<const char*>(file.get()), static_cast<std::size_t>(size)};
}

}  // namespace raytracer
