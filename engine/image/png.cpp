#include "engine/image/png.h"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <utility>

#include "engine/image/isal.h"

namespace raytracer {
namespace {

/// What stb_image_write's hooks, which have no parameter for it, need and leave. A small picture's
/// buffers are on the stack: renders queue for malloc's arenas, which sort what was freed whenever
/// they are asked for more than a thousand bytes.
class PngArena {
 public:
  explicit PngArena(WorkerPool& own_pool) : pool(own_pool) {}

  /// Null if there is none.
  void* allocate(std::size_t size) {
    constexpr std::size_t alignment = alignof(std::max_align_t);
    const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
    if (rounded > room_.size() - taken_) return std::malloc(size);
    return room_.data() + std::exchange(taken_, taken_ + rounded);
  }

  void deallocate(void* memory) {
    const std::less<void*> is_before;
    if (is_before(memory, room_.data()) || !is_before(memory, room_.data() + room_.size()))
      std::free(memory);
  }

  WorkerPool& pool;
  std::exception_ptr failure;
  unsigned char* stream = nullptr;  ///< which stb loses if there is no memory for the file

 private:
  std::size_t taken_ = 0;
  alignas(std::max_align_t) std::array<unsigned char, std::size_t{1} << 16> room_;
};
thread_local PngArena* arena = nullptr;

/// As stb_image_write wants it: memory of its allocator's, or null after a failure.
unsigned char* compress(unsigned char* bytes, int size, int* compressed_size) {
  const std::span<const unsigned char> rows(bytes, static_cast<std::size_t>(size));
  auto* const stream = static_cast<unsigned char*>(arena->allocate(largest_stream(rows.size())));
  if (stream == nullptr) return nullptr;
  try {
    *compressed_size = static_cast<int>(compress_zlib(rows, stream, arena->pool));
    arena->stream = stream;
    return stream;
  } catch (...) {
    arena->deallocate(stream);
    arena->failure = std::current_exception();
    return nullptr;
  }
}

}  // namespace
}  // namespace raytracer

#define STBIW_ZLIB_COMPRESS(bytes, size, compressed_size, level) \
  raytracer::compress(bytes, size, compressed_size)
#define STBIW_CRC32(bytes, size) raytracer::crc32({bytes, static_cast<std::size_t>(size)})
#define STBIW_MALLOC(size) raytracer::arena->allocate(size)
#define STBIW_REALLOC(memory, size) std::realloc(memory, size)  // asked for, and never used
#define STBIW_FREE(memory) raytracer::arena->deallocate(memory)
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

std::string encode_png(int width, int height, int channels, std::span<const unsigned char> bytes,
                       WorkerPool& pool) {
  constexpr int no_gap_between_rows = 0;
  PngArena own(pool);
  arena = &own;
  int size = 0;
  const auto deallocate = [&own](unsigned char* memory) { own.deallocate(memory); };
  const std::unique_ptr<unsigned char, decltype(deallocate)> file(
      stbi_write_png_to_mem(bytes.data(), no_gap_between_rows, width, height, channels, &size),
      deallocate);
  arena = nullptr;
  if (own.failure) std::rethrow_exception(own.failure);
  if (!file) {
    own.deallocate(own.stream);
    throw std::bad_alloc();
  }
  return {reinterpret_cast<const char*>(file.get()), static_cast<std::size_t>(size)};
}

}  // namespace raytracer
