#include "client/notice.h"

#include <cstdio>
#include <string>

namespace raytracer::client {

void notice(std::string_view line) {
  const std::string text = std::string(line) + '\n';  // at once: others may write there, too
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace raytracer::client
