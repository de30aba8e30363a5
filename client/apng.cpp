#include "client/apng.h"

#include <zlib.h>

#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>

#include "client/failure.h"

namespace raytracer::client {
namespace {

constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t word = 4;

std::uint32_t number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (const char c : bytes.substr(at, word)) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

void append_number(std::string& bytes, std::uint32_t value, int size = 4) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> shift & 0xFF);
}

void append_chunk(std::string& bytes, std::string_view type, std::string_view data) {
  append_number(bytes, static_cast<std::uint32_t>(data.size()));
  const std::size_t begin = bytes.size();
  bytes.append(type).append(data);
  const uLong checksum =
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data() + begin), bytes.size() - begin);
  append_number(bytes, static_cast<std::uint32_t>(checksum));
}

/// Calls `visit` with the type and data of each chunk.
template <typename Visit>
void each_chunk(std::string_view png, Visit visit) {
  constexpr std::size_t around = 12;  // length, type and checksum
  if (!png.starts_with(signature)) throw ServerError("a frame is no PNG");
  for (png.remove_prefix(signature.size()); !png.empty();) {
    const std::size_t length = png.size() < around ? 0 : number_at(png, 0);
    if (png.size() < around + length) throw ServerError("a frame's PNG is not whole");
    visit(png.substr(word, word), png.substr(2 * word, length));
    png.remove_prefix(around + length);
  }
}

/// How long a frame is shown, in seconds.
struct Delay {
  std::uint16_t numerator = 1;
  std::uint16_t denominator = 1;
};

/// The nearest to the rate's inverse, in lowest terms. All denominators are tried: a millisecond's
/// work.
Delay delay_of(FrameRate rate) {
  constexpr std::int64_t most = std::numeric_limits<std::uint16_t>::max();
  Delay best;
  // Of |numerator / denominator - rate.denominator / rate.numerator|, times rate.numerator.
  const auto error_of = [&](std::int64_t numerator, std::int64_t denominator) {
    return std::abs(numerator * rate.numerator - denominator * rate.denominator);
  };
  for (std::int64_t denominator = 1; denominator <= most; ++denominator) {
    const std::int64_t numerator = (2 * denominator * rate.denominator + rate.numerator) /
                                   (2 * std::int64_t{rate.numerator});  // rounded
    if (numerator < 1 || numerator > most) continue;
    if (error_of(numerator, denominator) * best.denominator <
        error_of(best.numerator, best.denominator) * denominator)
      best = {static_cast<std::uint16_t>(numerator), static_cast<std::uint16_t>(denominator)};
  }
  return best;
}

std::string header_of(std::string_view png) {
  std::string header;
  each_chunk(png, [&](std::string_view type, std::string_view data) {
    if (type == "IHDR") header = data;
  });
  return header;
}

}  // namespace

std::string animated_png(const std::vector<std::string>& frames, FrameRate rate) {
  std::string bytes(signature);
  const std::string header = header_of(frames.at(0));
  append_chunk(bytes, "IHDR", header);
  std::string control;
  append_number(control, static_cast<std::uint32_t>(frames.size()));
  append_number(control, 0);  // for ever
  append_chunk(bytes, "acTL", control);
  const Delay delay = delay_of(rate);
  std::uint32_t sequence = 0;
  for (const std::string& frame : frames) {
    if (header_of(frame) != header) throw ServerError("the frames differ in size or in kind");
    std::string frame_control;
    append_number(frame_control, sequence++);
    frame_control += header.substr(0, 2 * word);  // width and height
    append_number(frame_control, 0);              // at the left
    append_number(frame_control, 0);              // at the top
    append_number(frame_control, delay.numerator, 2);
    append_number(frame_control, delay.denominator, 2);
    frame_control += std::string(2, '\0');  // it stays, and replaces what was there
    append_chunk(bytes, "fcTL", frame_control);
    const bool is_first = sequence == 1;
    each_chunk(frame, [&](std::string_view type, std::string_view data) {
      if (type != "IDAT") return;
      if (is_first) return append_chunk(bytes, type, data);
      std::string numbered;
      append_number(numbered, sequence++);
      append_chunk(bytes, "fdAT", numbered.append(data));
    });
  }
  append_chunk(bytes, "IEND", "");
  return bytes;
}

}  // namespace raytracer::client
