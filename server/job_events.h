// Server-sent events about a job (the WHATWG's text/event-stream).
//
// httplib gives each connection a thread, and a stream holds it until the job has ended: there may
// be a few, and further ones are refused, because polling serves as well. A step of a stream waits
// a tenth of a second at most, so that a client that left and a server that ends are seen soon;
// only a client that reads nothing can hold it longer, in a write, and httplib ends those.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "server/call.h"
#include "server/job.h"
#include "server/quota.h"

namespace raytracer {

inline constexpr std::int64_t most_event_streams = 32;

/// Answers with `progress` events while the job changes, some ten a second at most, and a comment
/// when it has not for seconds; then one `done`, `failed` or `cancelled`. The data of each is what
/// `describe` says of the job on one line. Throws HttpError 429 if there are too many streams.
void answer_events(Call& call, Quota& streams, std::shared_ptr<const Job> job,
                   std::function<std::string(const Job&)> describe);

}  // namespace raytracer
