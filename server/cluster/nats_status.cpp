#include "server/cluster/nats_status.h"

#include <fmt/format.h>

#include <string>

#include "server/cluster/nats.h"

namespace raytracer {

std::string last_words() {
  const std::string said = nats_last_error();
  return said.empty() ? "no more is said" : said;
}

bool is_away(natsStatus status) {
  switch (status) {
    case NATS_CONNECTION_CLOSED:
    case NATS_CONNECTION_DISCONNECTED:
    case NATS_NO_SERVER:
    case NATS_NOT_YET_CONNECTED:
    case NATS_STALE_CONNECTION:
    case NATS_IO_ERROR:
      return true;
    default:
      return false;
  }
}

bool is_passing(natsStatus status, jsErrCode error) {
  switch (status) {
    case NATS_TIMEOUT:
    case NATS_NO_RESPONDERS:
      return true;
    default:
      return error == JSStreamNotFoundErr || error == JSClusterNotAvailErr;
  }
}

void require(natsStatus status, std::string_view what, jsErrCode error) {
  if (status == NATS_OK) return;
  const std::string text =
      fmt::format("{}: {} ({})", what, natsStatus_GetText(status), last_words());
  if (is_away(status)) throw NatsAway(text);
  if (is_passing(status, error)) throw NatsUnavailable(text);
  if (error == JSStreamStoreFailedErr || error == JSInsufficientResourcesErr ||
      error == JSStorageResourcesExceededErr || error == JSAccountResourcesExceededErr)
    throw StreamFull(
        "the cluster's store is full (--max-stored): delete jobs, or wait until old ones "
        "are forgotten; " +
        text);
  throw NatsRefused(text);
}

}  // namespace raytracer
