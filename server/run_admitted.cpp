#include "server/run_admitted.h"

#include <string>

#include "server/problem.h"

namespace raytracer {

void refuse_stopped(Services& services) {
  services.metrics.add("renders_cancelled_total");
  if (services.admission.is_closed())
    refuse(503, "The server shut down before the work was finished",
           {{"Retry-After", std::to_string(services.admission.retry_after_s())}});
  refuse(499, "The client has left");
}

double run_admitted(Services& services, RenderProgress& progress,
                    const std::function<bool()>& work) {
  Admission::Slot slot(services.admission, progress);
  if (!slot.wait_until_admitted()) refuse_stopped(services);
  services.metrics.observe("queue_duration_seconds", slot.queue_ms() / 1000);
  if (!work()) refuse_stopped(services);
  return slot.queue_ms();
}

}  // namespace raytracer
