#include "server/image_answer.h"

#include <fmt/format.h>

#include "server/answer.h"
#include "server/etag.h"
#include "server/header_text.h"
#include "server/negotiate.h"
#include "server/problem.h"

namespace raytracer {
namespace {

void set_caching(httplib::Response& response, const Representation& wanted) {
  response.set_header("Vary", "Accept");
  if (!wanted.tag) {
    response.set_header("Cache-Control", "no-store");
    return;
  }
  response.set_header("ETag", *wanted.tag);
  // May be stored, but is to be asked for again: another build draws another picture.
  response.set_header("Cache-Control", "no-cache");
}

bool forbids_cache(const httplib::Request& request) {
  bool found = false;
  const std::string directives = header_list(request, "Cache-Control");
  for_each_part(directives, ',', [&](std::string_view directive) {
    found = found || lower_case(directive) == "no-cache";
  });
  return found;
}

/// What of the making this request waited for, and that it was no more.
std::string server_timing(const Delivery& delivery, double parse_ms) {
  Stages stages;
  const char* origin = "";
  switch (delivery.origin) {
    case Origin::rendered:
      stages = delivery.image->stages;
      break;
    case Origin::shared:
      stages.queue_ms = delivery.waited_ms;
      origin = ", cache;desc=shared";
      break;
    case Origin::cached:
      origin = ", cache;desc=hit";
      break;
  }
  return fmt::format(
      "queue;dur={:.3f}, parse;dur={:.3f}, plan;dur={:.3f}, build;dur={:.3f}, trace;dur={:.3f}, "
      "encode;dur={:.3f}{}",
      stages.queue_ms, parse_ms, stages.plan_ms, stages.build_ms, stages.trace_ms, stages.encode_ms,
      origin);
}

}  // namespace

Reproducible reproducible_digest(const SceneRequest& request) {
  if (request.scene.render.budget_ms) return {};
  return picture_digest(request.known->content_digest, request.scene);
}

Representation represent(const Reproducible& digest, ImageFormat format,
                         std::string_view renderer_id) {
  Representation wanted{format, {}};
  if (digest) wanted.tag = entity_tag(*digest, media_type(format), renderer_id);
  return wanted;
}

ImageRequest image_request(const Call& call, const Representation& wanted) {
  return {wanted.tag, forbids_cache(call.request), endpoints_of(call.request)};
}

ImageFormat require_format(const httplib::Request& request) {
  const std::optional<ImageFormat> format = choose_format(header_list(request, "Accept"));
  if (format) return *format;
  throw HttpError({406, fmt::format("None of the accepted types is offered: {}, {}, {}",
                                    media_type(ImageFormat::png), media_type(ImageFormat::ppm),
                                    media_type(ImageFormat::pfm))});
}

bool answer_not_modified(Call& call, const Representation& wanted) {
  if (!call.request.has_header("If-None-Match") || forbids_cache(call.request)) return false;
  const std::string named = header_list(call.request, "If-None-Match");
  // Any image at all has a client who names "*", be it one that has no tag.
  if (named != "*" && !(wanted.tag && matches_tag(named, *wanted.tag))) return false;
  call.response.status = 304;
  set_caching(call.response, wanted);
  return true;
}

void answer_image(Call& call, const Delivery& delivery, double parse_ms,
                  const Representation& wanted) {
  httplib::Response& response = call.response;
  answer_shared_bytes(response, {delivery.image, &delivery.image->bytes},
                      media_type(wanted.format));
  set_caching(response, wanted);
  response.set_header("Server-Timing", server_timing(delivery, parse_ms));
  response.set_header("Render-Samples", delivery.image->samples);
  response.set_header("Render-Precision", std::string(delivery.image->precision));
  response.set_header("Render-Stop", std::string(delivery.image->stop));
  if (delivery.image->error) response.set_header("Render-Error", *delivery.image->error);
}

void answer_image_head(Call& call, const Representation& wanted) {
  call.response.status = 200;
  call.response.set_header("Content-Type", std::string(media_type(wanted.format)));
  set_caching(call.response, wanted);
}

}  // namespace raytracer
