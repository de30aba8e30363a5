#include "server/negotiate.h"

#include <span>
#include <vector>

#include "server/request_text.h"

namespace raytracer {
namespace {

/// The weight that a media range's parameters give it, 1 if they say none; nothing if it cannot be
/// read.
std::optional<double> weight_of(std::span<const std::string_view> parameters) {
  for (const std::string_view parameter : parameters)
    if (lower_case(parameter.substr(0, 2)) == "q=") {
      const std::optional<double> weight = read_double(parameter.substr(2));
      return weight && *weight >= 0 && *weight <= 1 ? weight : std::nullopt;
    }
  return 1;
}

/// 3 for the type itself, 2 for its family, 1 for anything, 0 if the range is about other types.
int specificity(std::string_view range, std::string_view type) {
  if (range == type) return 3;
  if (range == "image/*") return 2;
  return range == "*/*" ? 1 : 0;
}

/// What the field's most specific range about the type gives it.
double weight_in(std::string_view accept, std::string_view type) {
  double weight = 0;
  int specificity_so_far = 0;
  for (const std::string_view element : parts_of(accept, ',')) {
    const std::vector<std::string_view> parts = parts_of(element, ';');
    const std::optional<double> own = weight_of(std::span(parts).subspan(1));
    const int how_specific = specificity(lower_case(parts[0]), type);
    if (!own || how_specific <= specificity_so_far) continue;
    specificity_so_far = how_specific;
    weight = *own;
  }
  return weight;
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
  std::optional<ImageFormat> best;
  double best_weight = 0;
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::ppm, ImageFormat::pfm}) {
    const double weight = weight_in(accept, media_type(format));
    if (weight <= best_weight) continue;
    best_weight = weight;
    best = format;
  }
  return best;
}

}  // namespace raytracer
