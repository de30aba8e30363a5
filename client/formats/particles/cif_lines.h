// Where in a CIF a value stands: gemmi keeps the lines of tables, not those of their rows. Read
// again only where something is wrong, so that what is right costs nothing.
#pragma once

#include <cstddef>
#include <string_view>

#include "client/formats/particles/cif_contents.h"

namespace raytracer::client {

/// The line of the table's value of that index, of the text from which gemmi has read it.
int line_of_value(std::string_view text, const CifTable& table, std::size_t index);

}  // namespace raytracer::client
