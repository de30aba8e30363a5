// Colours for what has names and no order: chains, types, residues.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "client/formats/scene_model.h"

namespace raytracer::client {

/// As screens show it; they repeat after twelve. The first seven are told apart by colour-blind
/// people too: M. Okabe and K. Ito, "Color Universal Design", 2008. The others are from
/// ColorBrewer's Paired (C. Brewer).
model::Rgb palette_color(std::size_t index);

/// The amino acids' colours of RasMol ("amino") and the nucleotides' of R. Fletterick's models
/// ("shapely"); none of another residue.
std::optional<model::Rgb> residue_color(std::string_view name);

}  // namespace raytracer::client
