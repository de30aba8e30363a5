#include "client/formats/particles/elements.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <gemmi/elem.hpp>

#include "client/formats/screen_color.h"

namespace raytracer::client {
namespace {

/// From hydrogen to meitnerium, the last one that Jmol gives a colour.
constexpr std::array<std::uint32_t, 109> jmol_colors{
    0xFFFFFF, 0xD9FFFF, 0xCC80FF, 0xC2FF00, 0xFFB5B5, 0x909090, 0x3050F8, 0xFF0D0D, 0x90E050,
    0xB3E3F5, 0xAB5CF2, 0x8AFF00, 0xBFA6A6, 0xF0C8A0, 0xFF8000, 0xFFFF30, 0x1FF01F, 0x80D1E3,
    0x8F40D4, 0x3DFF00, 0xE6E6E6, 0xBFC2C7, 0xA6A6AB, 0x8A99C7, 0x9C7AC7, 0xE06633, 0xF090A0,
    0x50D050, 0xC88033, 0x7D80B0, 0xC28F8F, 0x668F8F, 0xBD80E3, 0xFFA100, 0xA62929, 0x5CB8D1,
    0x702EB0, 0x00FF00, 0x94FFFF, 0x94E0E0, 0x73C2C9, 0x54B5B5, 0x3B9E9E, 0x248F8F, 0x0A7D8C,
    0x006985, 0xC0C0C0, 0xFFD98F, 0xA67573, 0x668080, 0x9E63B5, 0xD47A00, 0x940094, 0x429EB0,
    0x57178F, 0x00C900, 0x70D4FF, 0xFFFFC7, 0xD9FFC7, 0xC7FFC7, 0xA3FFC7, 0x8FFFC7, 0x61FFC7,
    0x45FFC7, 0x30FFC7, 0x1FFFC7, 0x00FF9C, 0x00E675, 0x00D452, 0x00BF38, 0x00AB24, 0x4DC2FF,
    0x4DA6FF, 0x2194D6, 0x267DAB, 0x266696, 0x175487, 0xD0D0E0, 0xFFD123, 0xB8B8D0, 0xA6544D,
    0x575961, 0x9E4FB5, 0xAB5C00, 0x754F45, 0x428296, 0x420066, 0x007D00, 0x70ABFA, 0x00BAFF,
    0x00A1FF, 0x008FFF, 0x0080FF, 0x006BFF, 0x545CF2, 0x785CE3, 0x8A4FE3, 0xA136D4, 0xB31FD4,
    0xB31FBA, 0xB30DA6, 0xBD0D87, 0xC70066, 0xCC0059, 0xD1004F, 0xD90045, 0xE00038, 0xE6002E,
    0xEB0026,
};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::uint8_t number_of(gemmi::El element) {
  if (element == gemmi::El::D) element = gemmi::El::H;
  const auto number = static_cast<std::size_t>(element);
  return number < static_cast<std::size_t>(gemmi::El::D) ? static_cast<std::uint8_t>(number) : 0;
}

/// The tables' decimals, which floats have not.
double hundredths(float radius) { return std::round(100 * static_cast<double>(radius)) / 100; }

gemmi::El gemmi_element(std::uint8_t element) { return static_cast<gemmi::El>(element); }

}  // namespace

std::uint8_t element_of(std::string_view word) {
  const auto letters = static_cast<std::size_t>(
      std::find_if_not(word.begin(), word.end(), is_letter) - word.begin());
  if (letters == 0) {
    unsigned number = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, number);
    const bool is_known = error == std::errc() && stop == end && number <= 118;
    return is_known ? static_cast<std::uint8_t>(number) : 0;
  }
  if (letters > 2) return 0;
  const std::string symbol(word.substr(0, letters));
  return number_of(gemmi::find_element(symbol.c_str()));
}

std::uint8_t element_of_label(std::string_view label) {
  const std::uint8_t element = element_of(label);
  constexpr std::string_view common = "HCNOPS";
  if (element != 0 || label.empty() || common.find(label[0]) == common.npos) return element;
  return element_of(label.substr(0, 1));
}

std::string_view symbol_of(std::uint8_t element) {
  return gemmi::element_name(gemmi_element(element));
}

double van_der_waals_radius(std::uint8_t element) {
  return hundredths(gemmi::vdw_radius(gemmi_element(element)));
}

double covalent_radius(std::uint8_t element) {
  return hundredths(gemmi::covalent_radius(gemmi_element(element)));
}

model::Rgb color_of(std::uint8_t element) {
  constexpr std::uint32_t unknown = 0xFF1493;  // Jmol's deep pink
  const bool is_known = element > 0 && element <= jmol_colors.size();
  return screen_color(is_known ? jmol_colors[element - 1U] : unknown);
}

}  // namespace raytracer::client
