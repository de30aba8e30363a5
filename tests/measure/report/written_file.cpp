#include "tests/measure/report/written_file.h"

#include <fstream>
#include <stdexcept>

namespace raytracer::measure {

void write_file(const std::filesystem::path& path, const std::string& content) {
  std::ofstream file(path, std::ios::binary);
  file << content;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace raytracer::measure
