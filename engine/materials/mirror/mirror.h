// A surface that mirrors: a ray follows, and what it sees counts as much as `reflectivity`.
//
//   { "reflectivity": 0.5 }
#pragma once

#include <tuple>

#include "engine/fields/field_table.h"

namespace raytracer {

struct Mirror {
  double reflectivity = 0;

  static constexpr auto fields =
      std::tuple(optional("reflectivity", &Mirror::reflectivity, NumberRule{unit_interval},
                          "How much of what it mirrors a surface shows."));

  friend auto operator<=>(const Mirror&, const Mirror&) = default;
};

}  // namespace raytracer
