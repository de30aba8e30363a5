#include "server/run_admitted.h"

#include "server/problem.h"

namespace raytracer {
namespace {

[[noreturn]] void refuse_stopped(Services& services) {
  services.metrics.add("renders_cancelled_total");
  if (services.admission.is_closed())
    throw HttpError({503, "The server shut down before the work was finished"});
  throw HttpError(client_closed_request());
}

}  // namespace

double run_admitted(Services& services, RenderProgress& progress,
                    const std::function<bool()>& work) {
  Admission::Slot slot(services.admission, progress);
  if (!slot.wait_until_admitted()) refuse_stopped(services);
  services.metrics.observe("queue_duration_seconds", slot.queue_ms() / 1000);
  if (!work()) refuse_stopped(services);
  return slot.queue_ms();
}

void run_admitted(Services& services, const Call& call,
                  const std::function<bool(RenderProgress&)>& work) {
  RenderProgress progress;
  const DisconnectWatch::Registration registration(services.disconnect_watch,
                                                   endpoints_of(call.request),
                                                   [&] { services.admission.stop(progress); });
  run_admitted(services, progress, [&] { return work(progress); });
}

}  // namespace raytracer
