#include "client/formats/reading.h"

#include <algorithm>

namespace raytracer::client {

void add_omission(std::vector<Omission>& omissions, int line, std::string_view one,
                  std::string_view many) {
  auto kind = std::find_if(omissions.begin(), omissions.end(),
                           [&](const Omission& known) { return known.one == one; });
  if (kind == omissions.end())
    kind = omissions.insert(kind, {std::string(one), std::string(many), 0, line});
  ++kind->count;
}

}  // namespace raytracer::client
