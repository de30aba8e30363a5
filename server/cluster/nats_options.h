// How a connection to NATS is had and kept.
#pragma once

#include <nats/nats.h>

#include <memory>
#include <string>

namespace raytracer {

struct DestroyOptions {
  void operator()(natsOptions* options) const { natsOptions_Destroy(options); }
};
using OptionsPointer = std::unique_ptr<natsOptions, DestroyOptions>;

/// What libnats says of the calling thread's last call that failed; may be empty.
std::string nats_last_error();

/// The hosts and ports of a URL, as messages show them: without user and password, which logs must
/// not have.
std::string nats_place(const std::string& url);

/// For a connection that ends once it is lost. Throws as NatsConnection's constructor does.
OptionsPointer nats_options(const std::string& url);

}  // namespace raytracer
