// A plan as people read it: what is needed, what is chosen and why, what it will take.
#pragma once

#include <string>

namespace raytracer::client {

/// Lines of at most `width` where words allow. `json` is the server's answer; what it does not
/// say is left out.
std::string plan_text(const std::string& json, int width);

}  // namespace raytracer::client
