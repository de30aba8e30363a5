#include "client/formats/particles/particles.h"

#include <fmt/format.h>

#include <algorithm>

#include "client/formats/printable.h"

namespace raytracer::client {

std::string no_such_column(const std::string& wanted, const std::vector<std::string>& known) {
  std::vector<std::string> printed;
  printed.reserve(known.size());
  for (const std::string& name : known) printed.push_back(printable(name));
  return fmt::format("nothing here is called {}, which is to give the colours; there {}: {}",
                     client::quoted(wanted), known.size() == 1 ? "is" : "are",
                     fmt::join(printed, ", "));
}

std::uint32_t GroupNames::number_of(std::string_view name) {
  if (last_ < names_.size() && names_[last_] == name) return last_;  // neighbours are often alike
  const auto place = std::lower_bound(
      by_name_.begin(), by_name_.end(), name,
      [&](std::uint32_t number, std::string_view sought) { return names_[number] < sought; });
  if (place != by_name_.end() && names_[*place] == name) return last_ = *place;
  last_ = static_cast<std::uint32_t>(names_.size());
  names_.emplace_back(name);
  by_name_.insert(place, last_);
  return last_;
}

}  // namespace raytracer::client
