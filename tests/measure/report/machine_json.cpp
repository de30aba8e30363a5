#include "tests/measure/report/machine_json.h"

#include <nlohmann/json.hpp>

namespace raytracer::bench {

nlohmann::ordered_json json_of(const Machine& machine) {
  return {{"processor", machine.processor},
          {"cores", machine.cores},
          {"vectors", machine.vectors},
          {"system", machine.system},
          {"compiler", machine.compiler}};
}

}  // namespace raytracer::bench
