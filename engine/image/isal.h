// What PNG takes from ISA-L, which stays in this pair of files: a zlib stream (RFC 1950),
// compressed in strips on all threads, and CRC-32.
//
// ISA-L deflates a picture's rows some twenty times as fast as stb_image_write does. A strip is
// compressed by itself and ends at a whole byte (RFC 1951's full flush), so that strips stand one
// behind the other; their checksums are combined. Where strips begin is a matter of bytes, not of
// threads, so the stream is the same however many there are.
#pragma once

#include <cstdint>
#include <span>

#include "engine/memory/page_allocator.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// The stream of `bytes`, at least one. Throws std::runtime_error if ISA-L fails, and
/// std::bad_alloc.
LargeArray<unsigned char> compress_zlib(std::span<const unsigned char> bytes, WorkerPool& pool);

/// CRC-32 as PNG has it (ISO 3309).
std::uint32_t crc32(std::span<const unsigned char> bytes);

}  // namespace raytracer
