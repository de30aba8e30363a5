#include "server/turn.h"

#include "server/problem.h"

namespace raytracer {
namespace {

[[noreturn]] void refuse_stopped(Services& services) {
  services.metrics.cancelled();
  if (services.admission.is_closed())
    throw Refusal({503, "The server shut down before the work was finished"});
  // Nobody reads this: 499 is what the log then shows.
  throw Refusal({499, "The client has left"});
}

}  // namespace

double take_turn(Services& services, const Call& call,
                 const std::function<bool(RenderProgress&)>& work) {
  RenderProgress progress;
  const Departures::Watch watch(services.departures, find_socket(ends_of(call.request)),
                                progress.stop);
  Admission::Place place = services.admission.enter(progress);
  if (!place.wait_for_turn()) refuse_stopped(services);
  const double queue_ms = place.queue_ms();
  services.metrics.waited(queue_ms);
  if (!work(progress)) refuse_stopped(services);
  return queue_ms;
}

}  // namespace raytracer
