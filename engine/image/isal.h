// What PNG takes from ISA-L, which stays in this pair of files: a zlib stream (RFC 1950),
// compressed in strips on all threads, and CRC-32.
//
// ISA-L deflates a picture's rows some twenty times as fast as stb_image_write does. A strip is
// compressed by itself and ends at a whole byte (RFC 1951's full flush), so that strips stand one
// behind the other; their checksums are combined. Where strips begin is a matter of bytes, not of
// threads, so the stream is the same however many there are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// Bytes that the stream of `size` bytes, at least one, has at most: a little more than these.
std::size_t largest_stream(std::size_t size);

/// Writes the stream of `bytes`, at least one, to `out`, which has room for largest_stream() of
/// them, and returns its size. What is behind it is left as it may be. Throws std::runtime_error if
/// ISA-L fails, and std::bad_alloc.
std::size_t compress_zlib(std::span<const unsigned char> bytes, unsigned char* out,
                          WorkerPool& pool);

/// CRC-32 as PNG has it (ISO 3309).
std::uint32_t crc32(std::span<const unsigned char> bytes);

}  // namespace raytracer
