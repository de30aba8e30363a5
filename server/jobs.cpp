#include "server/jobs.h"

#include <fmt/format.h>

#include <random>

#include "server/problem.h"

namespace raytracer {

std::string random_id() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

void refuse_unknown_job(const std::string& id) {
  refuse(404, fmt::format("There is no job \"{}\": it never was, was deleted, or ended so long ago "
                          "that it was forgotten",
                          id));
}

}  // namespace raytracer
