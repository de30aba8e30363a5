// What libnats' statuses mean: which of this project's errors.
#pragma once

#include <nats/nats.h>

#include <string>
#include <string_view>

namespace raytracer {

/// What libnats says beside the status.
std::string last_words();

/// NATS cannot be reached.
bool is_away(natsStatus status);

/// It may do later what it has not done.
bool is_passing(natsStatus status, jsErrCode error);

/// Throws what the status means, unless all went well: NatsAway, NatsUnavailable, StreamFull or
/// NatsRefused. `what`: that was to be done.
void require(natsStatus status, std::string_view what, jsErrCode error = jsErrCode{});

}  // namespace raytracer
