#include "engine/image/isal.h"

#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

#ifdef __x86_64__
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "engine/memory/page_allocator.h"

namespace raytracer {
namespace {

// Of the demo's picture, 1 MB, strips of 64, 128 and 256 KiB take 1.87, 1.78 and 1.75 ms on one
// thread and give 294.6, 293.4 and 293.7 kB; smaller ones are shared out better.
constexpr std::size_t strip_size = std::size_t{128} << 10;

// Up to here a strip is deflated in static codes. Pictures of 32 x 32 to 96 x 72 take 5 to 30 us
// so, and 14 to 41 in codes of their own; their files have a quarter more bytes.
constexpr std::size_t small_strip = std::size_t{32} << 10;

std::size_t strip_count(std::size_t size) { return (size + strip_size - 1) / strip_size; }
std::size_t strip_size_of(std::size_t size) { return std::min(strip_size, size); }

constexpr std::array<unsigned char, 2> header{0x78, 0x01};  // deflate, 32 KiB back, fastest
constexpr std::size_t checksum_size = 4;

/// Incompressible bytes are stored, in some blocks of 5 bytes more: 28 were the most that any of
/// thousands of strips grew by. One that does not fit is an error.
constexpr std::size_t largest_compressed(std::size_t size) { return size + 128; }

/// To be called behind every function of ISA-L's: 2.30 returns with the upper halves of registers
/// in use, and then all SSE code of the thread, most of this program, is several times as slow: the
/// next picture's rounding took 0.95 ms instead of 0.26.
#ifdef __x86_64__
__attribute__((target("avx"))) void clear_upper_halves_of_avx() { _mm256_zeroupper(); }
void clear_upper_halves() {
  if (__builtin_cpu_supports("avx") != 0) clear_upper_halves_of_avx();
}
#else
void clear_upper_halves() {}
#endif

/// Adler-32 (RFC 1950) as its two sums, for a piece of a text.
struct Checksum {
  static constexpr std::uint32_t modulus = 65521;
  std::uint32_t bytes = 1;
  std::uint32_t sums = 0;

  Checksum() = default;
  explicit Checksum(std::uint32_t adler) : bytes(adler & 0xffff), sums(adler >> 16) {}

  /// For the text with `next`, of `size` bytes, behind it.
  void append(const Checksum& next, std::size_t size) {
    // Each of next's sums began with 1 where it ought to have begun with this one's.
    const std::uint64_t missing = bytes + modulus - 1;
    sums = static_cast<std::uint32_t>((sums + next.sums + size % modulus * missing) % modulus);
    bytes = static_cast<std::uint32_t>((next.bytes + missing) % modulus);
  }

  std::uint32_t value() const { return sums << 16 | bytes; }
};

Checksum checksum_of(std::span<const unsigned char> bytes) {
  const std::uint32_t adler = isal_adler32(1, bytes.data(), bytes.size());
  clear_upper_halves();
  return Checksum(adler);
}

/// How a part of a stream ends: the last one, one behind which matches may go on, or one that what
/// follows does not look back at.
enum class Ending { last, joined, apart };

/// Has `deflate` put `bytes` into the stream, which must have room for all of it.
void put(isal_zstream& stream, std::span<const unsigned char> bytes, Ending ending,
         int (*deflate)(isal_zstream*)) {
  stream.end_of_stream = ending == Ending::last ? 1 : 0;
  stream.flush = ending == Ending::last     ? NO_FLUSH
                 : ending == Ending::joined ? SYNC_FLUSH
                                            : FULL_FLUSH;
  // ISA-L's input is not const, but it only reads it.
  stream.next_in = const_cast<unsigned char*>(bytes.data());
  stream.avail_in = static_cast<std::uint32_t>(bytes.size());
  const int result = deflate(&stream);
  clear_upper_halves();
  if (result != COMP_OK || stream.avail_in != 0)
    throw std::runtime_error("ISA-L does not compress a picture");
}

/// In DEFLATE's static codes, which takes a third of the time that it takes to find those that fit.
void put_small_strip(isal_zstream& stream, std::span<const unsigned char> bytes, Ending ending) {
  isal_deflate_stateless_init(&stream);
  stream.hist_bits = 0;  // as far back as DEFLATE can; the function above leaves it as it was
  isal_deflate_set_hufftables(&stream, nullptr, IGZIP_HUFFTABLE_STATIC);
  put(stream, bytes, ending, isal_deflate_stateless);
}

/// In codes of its own.
///
/// Where a stream begins, the fast loop of ISA-L 2.30 enters a string into its table at a place
/// made from the stream's address, so that a file was not the same in one process of some hundred.
/// Few bytes do not get into that loop, and behind them it is not the beginning.
void put_strip(isal_zstream& stream, std::span<const unsigned char> bytes, Ending ending) {
  constexpr std::size_t few = 16;
  LargeArray<std::uint8_t> work_area(ISAL_DEF_LVL1_DEFAULT);
  isal_deflate_init(&stream);
  stream.level = 1;
  stream.level_buf = work_area.data();
  stream.level_buf_size = static_cast<std::uint32_t>(work_area.size());
  put(stream, bytes.first(few), Ending::joined, isal_deflate);
  put(stream, bytes.subspan(few), ending, isal_deflate);
}

/// Deflates a strip to `out`, which has room for largest_compressed() of it. Returns the size.
std::size_t deflate_strip(std::span<const unsigned char> bytes, bool is_last, unsigned char* out) {
  const Ending ending = is_last ? Ending::last : Ending::apart;
  isal_zstream stream;
  stream.next_out = out;
  stream.avail_out = static_cast<std::uint32_t>(largest_compressed(bytes.size()));
  if (bytes.size() <= small_strip)
    put_small_strip(stream, bytes, ending);
  else
    put_strip(stream, bytes, ending);
  return stream.total_out;
}

}  // namespace

std::size_t largest_stream(std::size_t size) {
  const std::size_t strips = strip_count(size);
  return header.size() + strips * largest_compressed(strip_size_of(size)) + checksum_size;
}

std::size_t compress_zlib(std::span<const unsigned char> bytes, unsigned char* out,
                          WorkerPool& pool) {
  const std::size_t count = strip_count(bytes.size());
  const std::size_t size = strip_size_of(bytes.size());
  const auto strip = [&](std::size_t i) {
    return bytes.subspan(i * size, std::min(size, bytes.size() - i * size));
  };
  unsigned char* end = std::copy(header.begin(), header.end(), out);
  Checksum checksum;
  if (count == 1) {
    end += deflate_strip(bytes, true, end);
    checksum = checksum_of(bytes);
  } else {
    // Each where it would be if all before it were incompressible, then moved up to the last.
    struct Piece {
      std::size_t size;
      Checksum checksum;
    };
    std::vector<Piece> pieces(count);
    const auto place = [&, begin = end](std::size_t i) {
      return begin + i * largest_compressed(size);
    };
    pool.run(count, [&](std::size_t i) {
      pieces[i] = {deflate_strip(strip(i), i == count - 1, place(i)), checksum_of(strip(i))};
    });
    for (std::size_t i = 0; i < count; ++i) {
      std::memmove(end, place(i), pieces[i].size);
      end += pieces[i].size;
      checksum.append(pieces[i].checksum, strip(i).size());
    }
  }
  for (int shift = 24; shift >= 0; shift -= 8)
    *end++ = static_cast<unsigned char>(checksum.value() >> shift);
  return static_cast<std::size_t>(end - out);
}

std::uint32_t crc32(std::span<const unsigned char> bytes) {
  const std::uint32_t crc = crc32_gzip_refl(0, bytes.data(), bytes.size());
  clear_upper_halves();
  return crc;
}

}  // namespace raytracer
