// A program's page for man, in roff with the macros of man(7).
#pragma once

#include <string>
#include <vector>

#include "client/manual/program.h"

namespace raytracer::manual {

/// Section 1. `version` stands in its foot; `others` are the pages to see also.
std::string man_page(const Program& program, const std::string& version,
                     const std::vector<std::string>& others);

}  // namespace raytracer::manual
