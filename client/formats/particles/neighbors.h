// Which atoms are bonded, by how near they are.
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

}  // namespace raytracer::client
