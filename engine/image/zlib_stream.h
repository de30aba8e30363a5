// A zlib stream (RFC 1950), compressed by ISA-L in strips on all threads.
//
// ISA-L deflates a picture's rows some twenty times as fast as stb_image_write does. A strip is
// compressed by itself and ends at a whole byte (RFC 1951's full flush), so that strips stand one
// behind the other; their checksums are combined. Where strips begin is a matter of bytes, not of
// threads, so the stream is the same however many there are.
#pragma once

#include <cstddef>
#include <span>

#include "engine/memory/page_allocator.h"
#include "engine/parallel/worker_pool.h"

namespace raytracer {

/// The stream of `bytes`, at least one. Throws std::runtime_error if ISA-L fails, and
/// std::bad_alloc.
LargeArray<unsigned char> compress_zlib(std::span<const unsigned char> bytes, WorkerPool& pool);

}  // namespace raytracer
