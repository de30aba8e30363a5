// The machine as the raw figures of a run carry it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tests/measure/report/machine.h"

namespace raytracer::bench {

nlohmann::ordered_json json_of(const Machine& machine);

}  // namespace raytracer::bench
