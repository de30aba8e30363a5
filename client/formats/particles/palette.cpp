#include "client/formats/particles/palette.h"

#include <algorithm>
#include <array>

#include "client/formats/screen_color.h"

namespace raytracer::client {
namespace {

constexpr std::array<std::uint32_t, 12> palette{0x0072B2, 0xE69F00, 0x009E73, 0xCC79A7,
                                                0x56B4E9, 0xD55E00, 0xF0E442, 0x6A3D9A,
                                                0xB2DF8A, 0xFB9A99, 0xB15928, 0xA6CEE3};

struct ResidueColor {
  std::string_view name;
  std::uint32_t color;
};

constexpr std::array<ResidueColor, 29> residues{{
    {"ASP", 0xE60A0A}, {"GLU", 0xE60A0A}, {"CYS", 0xE6E600}, {"MET", 0xE6E600}, {"LYS", 0x145AFF},
    {"ARG", 0x145AFF}, {"SER", 0xFA9600}, {"THR", 0xFA9600}, {"PHE", 0x3232AA}, {"TYR", 0x3232AA},
    {"ASN", 0x00DCDC}, {"GLN", 0x00DCDC}, {"GLY", 0xEBEBEB}, {"LEU", 0x0F820F}, {"VAL", 0x0F820F},
    {"ILE", 0x0F820F}, {"ALA", 0xC8C8C8}, {"TRP", 0xB45AB4}, {"HIS", 0x8282D2}, {"PRO", 0xDC9682},
    {"A", 0xA0A0FF},   {"DA", 0xA0A0FF},  {"C", 0xFF8C4B},   {"DC", 0xFF8C4B},  {"G", 0xFF7070},
    {"DG", 0xFF7070},  {"T", 0xA0FFA0},   {"DT", 0xA0FFA0},  {"U", 0xFF8080},
}};

}  // namespace

model::Rgb palette_color(std::size_t index) {
  return screen_color(palette[index % palette.size()]);
}

std::optional<model::Rgb> residue_color(std::string_view name) {
  const auto* const known =
      std::find_if(residues.begin(), residues.end(),
                   [&](const ResidueColor& residue) { return residue.name == name; });
  if (known == residues.end()) return std::nullopt;
  return screen_color(known->color);
}

}  // namespace raytracer::client
