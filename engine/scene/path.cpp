#include "engine/scene/path.h"

namespace raytracer {

std::string Path::pointer() const {
  if (parent == nullptr) return "";
  std::string pointer = parent->pointer() + '/';
  if (is_index) return pointer + std::to_string(index);
  for (const char c : key) {
    if (c == '~')
      pointer += "~0";
    else if (c == '/')
      pointer += "~1";
    else
      pointer += c;
  }
  return pointer;
}

}  // namespace raytracer
