#include "server/finished_image.h"

#include <fmt/format.h>

#include <chrono>

namespace raytracer {

namespace {

/// What HTTP's contract has names for: of mixed precision, which a plan explains, what most of it
/// is.
Precision reported_precision(Precision precision) {
  return precision == Precision::mixed ? Precision::single_precision : precision;
}

}  // namespace

template <typename Channel>
FinishedImage finish_image(const BasicRendering<Channel>& rendering, double queue_ms,
                           ImageFormat format, WorkerPool& pool, const Sharing& sharing) {
  FinishedImage image;
  const auto begin = std::chrono::steady_clock::now();
  image.bytes = encode(rendering.image, format, pool);
  const std::chrono::duration<double, std::milli> encoding =
      std::chrono::steady_clock::now() - begin;
  image.stages = {queue_ms, rendering.plan_ms, rendering.build_ms, rendering.trace_ms,
                  encoding.count()};
  const char* const stop = rendering.stop == Stop::target   ? "target"
                           : rendering.stop == Stop::budget ? "budget"
                                                            : "samples";
  image.fields = {{"Render-Samples", fmt::format("{:.6g}", rendering.samples_per_pixel)},
                  {"Render-Precision", name_of(reported_precision(rendering.precision))},
                  {"Render-Stop", stop}};
  if (rendering.light_samples > 0)
    image.fields.emplace_back("Render-Light-Samples", std::to_string(rendering.light_samples));
  if (rendering.estimated_error)
    image.fields.emplace_back("Render-Error", fmt::format("{:.3g}", *rendering.estimated_error));
  if (sharing.tasks > 0) {
    image.fields.emplace_back("Render-Tasks", std::to_string(sharing.tasks));
    image.fields.emplace_back("Render-Workers", std::to_string(sharing.workers));
  }
  return image;
}

template FinishedImage finish_image(const Rendering&, double, ImageFormat, WorkerPool&,
                                    const Sharing&);
template FinishedImage finish_image(const ByteRendering&, double, ImageFormat, WorkerPool&,
                                    const Sharing&);

}  // namespace raytracer
