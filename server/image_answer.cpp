#include "server/image_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "server/answer.h"
#include "server/etag.h"
#include "server/problem.h"
#include "server/request_text.h"

namespace raytracer {
namespace {

constexpr const char* if_none_match = "If-None-Match";

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

void set_caching(httplib::Response& response, const Representation& wanted) {
  response.set_header("Vary", "Accept");
  if (!wanted.tag) return;
  response.set_header("ETag", *wanted.tag);
  // May be stored, but is to be asked for again: another build draws another picture.
  response.set_header("Cache-Control", "no-cache");
}

std::string server_timing(const Delivery& delivery, double parse_ms) {
  const Stages& stages = delivery.stages;
  std::string text = fmt::format(
      "queue;dur={:.3f}, parse;dur={:.3f}, plan;dur={:.3f}, build;dur={:.3f}, trace;dur={:.3f}, "
      "encode;dur={:.3f}",
      stages.queue_ms, parse_ms, stages.plan_ms, stages.build_ms, stages.trace_ms,
      stages.encode_ms);
  if (!delivery.cache.empty()) text.append(", cache;desc=").append(delivery.cache);
  return text;
}

}  // namespace

std::string_view media_type(ImageFormat format) {
  if (format == ImageFormat::ppm) return "image/x-portable-pixmap";
  return format == ImageFormat::pfm ? "image/x-portable-floatmap" : "image/png";
}

Representation represent(const std::optional<std::string>& picture_digest, ImageFormat format,
                         std::string_view renderer_id) {
  Representation wanted{format, {}};
  if (picture_digest) wanted.tag = entity_tag(*picture_digest, media_type(format), renderer_id);
  return wanted;
}

bool forbids_cache(const httplib::Request& request) {
  const std::string directives = lower_case(header_list(request, "Cache-Control"));
  const std::vector<std::string_view> parts = parts_of(directives, ',');
  return std::find(parts.begin(), parts.end(), "no-cache") != parts.end();
}

ImageFormat require_format(const httplib::Request& request, int channels) {
  const std::string accept = header_list(request, "Accept");
  if (trimmed(accept).empty()) return ImageFormat::png;
  std::optional<ImageFormat> best;
  double best_weight = 0;
  std::vector<std::string_view> offered;
  for (const ImageFormat format : {ImageFormat::png, ImageFormat::ppm, ImageFormat::pfm}) {
    if (!holds_channels(format, channels)) continue;
    offered.push_back(media_type(format));
    const double weight = weight_in(accept, media_type(format));
    if (weight <= best_weight) continue;
    best_weight = weight;
    best = format;
  }
  if (best) return *best;
  const char* const of = channels == 3 ? "A picture" : "A picture with a transparent background";
  refuse(406, fmt::format("{} can be had as {}: none of that is accepted", of,
                          fmt::join(offered, ", ")));
}

bool prefers_floats(const httplib::Request& request) {
  const std::string accept = header_list(request, "Accept");
  return weight_in(accept, media_type(ImageFormat::pfm)) >
         std::max(weight_in(accept, media_type(ImageFormat::png)),
                  weight_in(accept, media_type(ImageFormat::ppm)));
}

bool answer_without_image(Call& call, const Representation& wanted) {
  const std::string named = header_list(call.request, if_none_match);
  // Any image at all has a client who names "*", be it one that has no tag.
  const bool is_known = named == "*" || (wanted.tag && matches_tag(named, *wanted.tag));
  const bool is_not_modified = is_known && !forbids_cache(call.request);
  if (!is_not_modified && !call.is_head()) return false;
  call.response.status = is_not_modified ? 304 : 200;
  if (!is_not_modified)
    call.response.set_header("Content-Type", std::string(media_type(wanted.format)));
  set_caching(call.response, wanted);
  return true;
}

void answer_image(Call& call, const Delivery& delivery, double parse_ms,
                  const Representation& wanted) {
  httplib::Response& response = call.response;
  if (!wanted.tag) {
    // Nobody could know it before; it is not to be stored, since the next render gives another.
    const std::string tag = entity_tag_of_bytes(delivery.image->bytes);
    response.set_header("ETag", tag);
    if (matches_tag(header_list(call.request, if_none_match), tag) &&
        !forbids_cache(call.request)) {
      response.status = 304;
      return set_caching(response, wanted);
    }
  }
  answer_shared_bytes(response, {delivery.image, &delivery.image->bytes},
                      media_type(wanted.format));
  set_caching(response, wanted);
  response.set_header("Server-Timing", server_timing(delivery, parse_ms));
  for (const auto& [name, value] : delivery.image->fields) response.set_header(name, value);
}

}  // namespace raytracer
