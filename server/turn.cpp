#include "server/turn.h"

#include "server/problem.h"

namespace raytracer {
namespace {

[[noreturn]] void refuse_stopped(Services& services) {
  services.metrics.cancelled();
  if (services.admission.is_closed())
    throw Refusal({503, "The server shut down before the work was finished"});
  throw Refusal(client_left());
}

}  // namespace

double take_turn(Services& services, RenderProgress& progress, const std::function<bool()>& work) {
  Admission::Place place = services.admission.enter(progress);
  if (!place.wait_for_turn()) refuse_stopped(services);
  const double queue_ms = place.queue_ms();
  services.metrics.waited(queue_ms);
  if (!work()) refuse_stopped(services);
  return queue_ms;
}

void take_turn(Services& services, const Call& call,
               const std::function<bool(RenderProgress&)>& work) {
  RenderProgress progress;
  const Departures::Watch watch(services.departures, ends_of(call.request),
                                [&] { progress.stop = true; });
  take_turn(services, progress, [&] { return work(progress); });
}

}  // namespace raytracer
