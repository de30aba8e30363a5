// Numbers of things as people write them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace raytracer {

/// 1234567 as "1,234,567".
std::string grouped(std::uint64_t number);

/// "1 sphere", "1,000 spheres".
std::string pluralised(std::uint64_t number, std::string_view thing);

}  // namespace raytracer
