#include "server/negotiate.h"

#include <array>
#include <string>

#include "server/header_text.h"

namespace raytracer {
namespace {

constexpr std::array formats{ImageFormat::png, ImageFormat::ppm, ImageFormat::pfm};

/// A weight in thousandths (RFC 9110: "0" or "1" with up to three decimals); nothing if malformed.
std::optional<int> read_weight(std::string_view text) {
  if (text.empty() || text.size() > 5 || (text[0] != '0' && text[0] != '1')) return {};
  if (text.size() > 1 && text[1] != '.') return {};
  int weight = text[0] == '1' ? 1000 : 0;
  int place = 100;
  for (const char digit : text.substr(text.size() > 1 ? 2 : 1)) {
    if (digit < '0' || digit > '9') return {};
    weight += place * (digit - '0');
    place /= 10;
  }
  if (weight > 1000) return {};
  return weight;
}

/// One element of the field, such as "image/*;q=0.8".
struct MediaRange {
  std::string type;  ///< in lower case
  int weight = 1000;
};

std::optional<MediaRange> read_range(std::string_view element) {
  MediaRange range;
  bool is_first = true;
  bool is_readable = true;
  for_each_part(element, ';', [&](std::string_view part) {
    if (is_first) {
      range.type = lower_case(part);
    } else if (lower_case(part.substr(0, 2)) == "q=") {
      const std::optional<int> weight = read_weight(part.substr(2));
      is_readable = is_readable && weight.has_value();
      range.weight = weight.value_or(0);
    }
    is_first = false;
  });
  if (!is_readable) return {};
  return range;
}

/// 3 for the type itself, 2 for its family, 1 for anything, 0 if the range is about other types.
int specificity(std::string_view range, ImageFormat format) {
  if (range == media_type(format)) return 3;
  if (range == "image/*") return 2;
  return range == "*/*" ? 1 : 0;
}

}  // namespace

std::string_view media_type(ImageFormat format) {
  switch (format) {
    case ImageFormat::ppm:
      return "image/x-portable-pixmap";
    case ImageFormat::pfm:
      return "image/x-portable-floatmap";
    case ImageFormat::png:
      break;
  }
  return "image/png";
}

std::optional<ImageFormat> choose_format(std::string_view accept) {
  if (trimmed(accept).empty()) return ImageFormat::png;
  std::array<int, formats.size()> weights{};
  std::array<int, formats.size()> specificities{};
  for_each_part(accept, ',', [&](std::string_view element) {
    const std::optional<MediaRange> range = read_range(element);
    if (!range) return;
    for (std::size_t i = 0; i < formats.size(); ++i) {
      const int how_specific = specificity(range->type, formats[i]);
      if (how_specific <= specificities[i]) continue;
      specificities[i] = how_specific;
      weights[i] = range->weight;
    }
  });
  std::optional<ImageFormat> best;
  int best_weight = 0;
  for (std::size_t i = 0; i < formats.size(); ++i) {
    if (weights[i] <= best_weight) continue;
    best_weight = weights[i];
    best = formats[i];
  }
  return best;
}

}  // namespace raytracer
