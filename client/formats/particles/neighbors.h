// Which particles are near each other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "client/formats/scene_model.h"

namespace raytracer::client {

/// Pairs of atoms that are bonded by their distance: at most 0.45 ångström more than their covalent
/// radii (E. Meng and R. Lewis, J. Comput. Chem. 12, 891, 1991), and at least 0.4 in all. Not two
/// hydrogens. Of more than 64 atoms in a cube of a bond's length the rest has none.
std::vector<std::array<std::uint32_t, 2>> bonds_by_distance(
    const std::vector<model::Triple>& places, const std::vector<std::uint8_t>& elements);

/// How far a particle is from its nearest neighbour, as the median of some; 1 if there is none.
/// It is found by at most so many threads, at least one.
double typical_spacing(const std::vector<model::Triple>& places, std::size_t most_threads);

}  // namespace raytracer::client
