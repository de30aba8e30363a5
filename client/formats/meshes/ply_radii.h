// The radii of a PLY's points, of which assimp knows nothing.
#pragma once

#include <string_view>
#include <vector>

#include "client/formats/reading.h"

namespace raytracer::client {

/// Of a PLY without errors: one for each of its vertices, or none if they have no property
/// `radius`. Radii that are none are added to the reading's errors.
std::vector<double> read_ply_radii(std::string_view ply, Reading& reading);

}  // namespace raytracer::client
