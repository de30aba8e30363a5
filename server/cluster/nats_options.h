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

/// Throws as NatsConnection's constructor does.
OptionsPointer nats_options(const std::string& url);

}  // namespace raytracer
