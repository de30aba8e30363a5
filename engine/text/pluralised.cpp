#include "engine/text/pluralised.h"

namespace raytracer {

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t place = text.size(); place > 3;) text.insert(place -= 3, ",");
  return text;
}

std::string pluralised(std::uint64_t number, std::string_view thing, std::string_view plural) {
  std::string text = grouped(number) + ' ';
  if (number == 1)
    text += thing;
  else if (!plural.empty())
    text += plural;
  else
    text.append(thing).append("s");
  return text;
}

}  // namespace raytracer
