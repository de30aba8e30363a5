// The chemical elements: their names, sizes and colours.
#pragma once

#include <cstdint>
#include <string_view>

#include "client/formats/scene_model.h"

namespace raytracer::client {

/// The atomic number of "C", "c", "CL", "6", or of what begins so and goes on with something else
/// than a letter ("C12", "Fe3+"); 0 if it is none. D is hydrogen.
std::uint8_t element_of(std::string_view word);

/// Also of a label in which the symbol of a common element of one letter is followed by other
/// letters, as simulations of molecules have them: "OW" and "HW1" of water, "CAL", "NZ".
std::uint8_t element_of_label(std::string_view label);

/// "C", "Cl"; "X" of unknown ones.
std::string_view symbol_of(std::uint8_t element);

/// In ångström: Bondi, J. Phys. Chem. 68, 441 (1964) and Mantina et al., J. Phys. Chem. A 113, 5806
/// (2009), as gemmi has them; 1 of unknown ones.
double van_der_waals_radius(std::uint8_t element);

/// In ångström: Cordero et al., Dalton Trans. 2832 (2008), as gemmi has them.
double covalent_radius(std::uint8_t element);

/// As screens show it: Jmol's colours (jmol.sourceforge.net/jscolors).
model::Rgb color_of(std::uint8_t element);

}  // namespace raytracer::client
