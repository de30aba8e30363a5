#include "server/image_answer.h"

#include <fmt/format.h>

#include <chrono>

#include "server/answer.h"
#include "server/etag.h"
#include "server/header_text.h"
#include "server/negotiate.h"
#include "server/problem.h"

namespace raytracer {
namespace {

std::string_view name_of(Stop stop) {
  switch (stop) {
    case Stop::target:
      return "target";
    case Stop::budget:
      return "budget";
    case Stop::samples:
    case Stop::cancelled:
      break;
  }
  return "samples";
}

std::string tag_of(const std::string& digest, ImageFormat format) {
  return entity_tag(digest, media_type(format));
}

void set_caching(httplib::Response& response, const Reproducible& digest, ImageFormat format) {
  response.set_header("Vary", "Accept");
  if (!digest) {
    response.set_header("Cache-Control", "no-store");
    return;
  }
  response.set_header("ETag", tag_of(*digest, format));
  // May be stored, but is to be asked for again: another build draws another picture.
  response.set_header("Cache-Control", "no-cache");
}

bool insists(const httplib::Request& request) {
  bool found = false;
  const std::string directives = header_list(request, "Cache-Control");
  for_each_part(directives, ',', [&](std::string_view directive) {
    found = found || lower_case(directive) == "no-cache";
  });
  return found;
}

}  // namespace

Reproducible reproducible_digest(const Scene& scene) {
  if (scene.render.budget_ms) return {};
  return scene_digest(scene);
}

ImageFormat demand_format(const httplib::Request& request) {
  const std::optional<ImageFormat> format = choose_format(header_list(request, "Accept"));
  if (format) return *format;
  throw Refusal({406, fmt::format("None of the accepted types is offered: {}, {}, {}",
                                  media_type(ImageFormat::png), media_type(ImageFormat::ppm),
                                  media_type(ImageFormat::pfm))});
}

bool answer_not_modified(Call& call, const Reproducible& digest, ImageFormat format) {
  if (!digest || insists(call.request)) return false;
  const std::string known = header_list(call.request, "If-None-Match");
  if (!names_tag(known, tag_of(*digest, format))) return false;
  call.response.status = 304;
  set_caching(call.response, digest, format);
  return true;
}

double answer_image(Call& call, const Rendering& rendering, const Preparation& before,
                    const Reproducible& digest, ImageFormat format, WorkerPool& pool) {
  const auto begin = std::chrono::steady_clock::now();
  std::string bytes = encode(rendering.image, format, pool);
  const std::chrono::duration<double, std::milli> encoding =
      std::chrono::steady_clock::now() - begin;

  httplib::Response& response = call.response;
  answer_bytes(response, std::move(bytes), media_type(format));
  set_caching(response, digest, format);
  response.set_header(
      "Server-Timing",
      fmt::format("queue;dur={:.3f}, parse;dur={:.3f}, plan;dur={:.3f}, build;dur={:.3f}, "
                  "trace;dur={:.3f}, encode;dur={:.3f}",
                  before.queue_ms, before.parse_ms, rendering.plan_ms, rendering.build_ms,
                  rendering.trace_ms, encoding.count()));
  response.set_header("Render-Samples", fmt::format("{:.6g}", rendering.samples_per_pixel));
  response.set_header("Render-Precision",
                      rendering.precision == Precision::single_precision ? "single" : "double");
  response.set_header("Render-Stop", std::string(name_of(rendering.stop)));
  return encoding.count();
}

void answer_image_head(Call& call, const Reproducible& digest, ImageFormat format) {
  call.response.status = 200;
  call.response.set_header("Content-Type", std::string(media_type(format)));
  set_caching(call.response, digest, format);
}

}  // namespace raytracer
