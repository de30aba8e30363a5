#include "tests/variants/random_documents.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "engine/math/vec.h"

namespace raytracer::test {

std::string random_spheres(int count, double radius, const std::string& material) {
  std::mt19937_64 random(static_cast<std::uint64_t>(count));
  std::uniform_real_distribution<double> place(-4, 4);
  std::string centers;
  for (int i = 0; i < count; ++i)
    centers += fmt::format("{}[{}, {}, {}]", i == 0 ? "" : ",", place(random), place(random),
                           place(random));
  return fmt::format(R"({{"type": "spheres", "centers": [{}], "radius": {}, "material": {}}})",
                     centers, radius, material);
}

std::string random_cylinders(int count, const std::string& material) {
  std::mt19937_64 random(static_cast<std::uint64_t>(count));
  const auto within = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double size = 8 / std::cbrt(count);
  std::string sets;
  for (const bool caps : {true, false}) {
    std::string from;
    std::string to;
    std::string radii;
    std::string colors;
    for (int i = 0; i < count; ++i) {
      const Vec3 a{within(-4, 4), within(-3.5, 4), within(-4, 4)};
      const Vec3 b = a + size * Vec3{within(-1, 1), within(-1, 1), within(-1, 1)};
      const double radius = size * within(0.02, 0.3);
      const Rgb color{within(0.2, 1), within(0.2, 1), within(0.2, 1)};
      if ((i % 3 == 0) == caps) continue;
      const char* const comma = radii.empty() ? "" : ",";
      from += fmt::format("{}[{}, {}, {}]", comma, a.x, a.y, a.z);
      to += fmt::format("{}[{}, {}, {}]", comma, b.x, b.y, b.z);
      colors += fmt::format("{}[{}, {}, {}]", comma, color.x, color.y, color.z);
      radii += fmt::format("{}{}", comma, radius);
    }
    sets += fmt::format(
        R"({}{{"type": "cylinders", "from": [{}], "to": [{}], "radius": [{}], "colors": [{}],
            "caps": {}, "material": {}}})",
        sets.empty() ? "" : ",", from, to, radii, colors, caps, material);
  }
  return sets;
}

std::string random_cones(int count, const std::string& material) {
  std::mt19937_64 random(static_cast<std::uint64_t>(count));
  const auto within = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double size = 8 / std::cbrt(count);
  std::string sets;
  for (const bool caps : {true, false}) {
    std::string columns[5];
    const auto add = [&](std::string& column, const std::string& item) {
      column += (column.empty() ? "" : ",") + item;
    };
    for (int i = 0; i < count; ++i) {
      const Vec3 a{within(-4, 4), within(-3.5, 4), within(-4, 4)};
      const Vec3 b =
          a + size * (i % 5 == 0 ? 0.1 : 1.0) * Vec3{within(-1, 1), within(-1, 1), within(-1, 1)};
      const double radius_from = i % 4 == 0 ? 0 : size * within(0.02, 0.4);
      const double radius_to = i % 4 == 1 ? 0 : i % 7 == 3 ? radius_from : size * within(0.02, 0.4);
      const Rgb color{within(0.2, 1), within(0.2, 1), within(0.2, 1)};
      if ((i % 3 == 0) == caps || radius_from + radius_to == 0) continue;
      add(columns[0], fmt::format("[{}, {}, {}]", a.x, a.y, a.z));
      add(columns[1], fmt::format("[{}, {}, {}]", b.x, b.y, b.z));
      add(columns[2], fmt::format("{}", radius_from));
      add(columns[3], fmt::format("{}", radius_to));
      add(columns[4], fmt::format("[{}, {}, {}]", color.x, color.y, color.z));
    }
    sets += fmt::format(
        R"({}{{"type": "cones", "from": [{}], "to": [{}], "radius_from": [{}], "radius_to": [{}],
            "colors": [{}], "caps": {}, "material": {}}})",
        sets.empty() ? "" : ",", columns[0], columns[1], columns[2], columns[3], columns[4], caps,
        material);
  }
  return sets;
}

std::string rough_sheet(int side, const std::string& material) {
  std::mt19937_64 random(static_cast<std::uint64_t>(side));
  std::uniform_real_distribution<double> shift(-0.35, 0.35);
  std::string vertices;
  std::string triangles;
  for (int i = 0; i <= side; ++i) {
    for (int k = 0; k <= side; ++k) {
      const double x = 8 * (i + shift(random)) / side - 4;
      const double z = 8 * (k + shift(random)) / side - 4;
      const double y = std::sin(1.3 * x) * std::cos(1.7 * z) + 8 * shift(random) / side;
      vertices +=
          fmt::format("{}[{}, {}, {}]", vertices.empty() ? "" : ",", x + 0.8 * y, y, z - 0.5 * y);
    }
  }
  for (int i = 0; i < side; ++i) {
    for (int k = 0; k < side; ++k) {
      const int a = i * (side + 1) + k;
      const int b = a + side + 1;
      triangles += fmt::format("{}[{},{},{}],[{},{},{}]", triangles.empty() ? "" : ",", a, b, b + 1,
                               b + 1, a + 1, a);
    }
  }
  return fmt::format(R"({{"type": "mesh", "vertices": [{}], "triangles": [{}], "material": {}}})",
                     vertices, triangles, material);
}

std::string smooth_sheet(int side, const std::string& material) {
  std::string sheet = rough_sheet(side, material);
  std::mt19937_64 random(static_cast<std::uint64_t>(side));
  std::uniform_real_distribution<double> turn(-0.8, 0.8);
  std::uniform_real_distribution<double> channel(0, 1);
  std::string normals;
  std::string colors;
  for (int i = 0; i < (side + 1) * (side + 1); ++i) {
    const char* const comma = i == 0 ? "" : ",";
    normals += fmt::format("{}[{}, {}, {}]", comma, turn(random), -1, turn(random));
    colors +=
        fmt::format("{}[{}, {}, {}]", comma, channel(random), channel(random), channel(random));
  }
  sheet.pop_back();
  const bool is_colored = side % 2 == 0;
  return sheet + fmt::format(R"(, "normals": [{}]{}}})", normals,
                             is_colored ? fmt::format(R"(, "colors": [{}])", colors) : "");
}

std::string random_triangles(int count, const std::string& material) {
  std::mt19937_64 random(static_cast<std::uint64_t>(count));
  std::uniform_real_distribution<double> place(-16, 16);
  std::string vertices;
  std::string triangles;
  for (int i = 0; i < count; ++i) {
    const double level = -7 + 0.05 * i;
    for (int corner = 0; corner < 3; ++corner)
      vertices += fmt::format("{}[{}, {}, {}]", vertices.empty() ? "" : ",", place(random),
                              level + 0.02 * place(random), place(random));
    triangles += fmt::format("{}[{}, {}, {}]", i == 0 ? "" : ",", 3 * i, 3 * i + 1, 3 * i + 2);
  }
  return fmt::format(R"({{"type": "mesh", "vertices": [{}], "triangles": [{}], "material": {}}})",
                     vertices, triangles, material);
}

}  // namespace raytracer::test
