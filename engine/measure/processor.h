// Which processor this is.
#pragma once

#include <string>

namespace raytracer {

/// Its maker, family and model as x86's CPUID gives them, "GenuineIntel 06-55". Empty elsewhere.
/// What single precision's estimates of 1/x and 1/sqrt(x) round to is theirs to choose.
std::string processor_model();

}  // namespace raytracer
