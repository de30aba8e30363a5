#include "tests/measure/peers/program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

#include "engine/measure/stopwatch.h"

namespace raytracer::peers {
namespace {

struct CommandOutcome {
  int status;
  std::string output;
};

CommandOutcome run_command(const std::string& command) {
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("no shell to run " + command);
  std::string output;
  std::array<char, 4096> buffer{};
  while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), pipe))
    output.append(buffer.data(), size);
  return {pclose(pipe), output};
}

/// The next word of a PPM's head; comments reach from # to the end of the line.
std::string head_word(std::istream& file) {
  std::string word;
  while (file >> word && word[0] == '#') std::getline(file, word);
  return word;
}

std::filesystem::path make_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "peer-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary directory");
  return pattern;
}

}  // namespace

ProgramFolder::ProgramFolder() : path_(make_folder()) {}

ProgramFolder::~ProgramFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

ProgramRun ProgramFolder::run(const std::string& command) const {
  const Stopwatch watch;
  const CommandOutcome outcome = run_command(fmt::format("cd '{}' && {}", path_.string(), command));
  const double whole_ms = watch.elapsed_ms();
  if (outcome.status != 0)
    throw std::runtime_error(fmt::format("{} failed:\n{}", command, outcome.output));
  return {outcome.output, whole_ms};
}

Image ProgramFolder::read_ppm(const std::string& name) const {
  std::ifstream file(path_ / name, std::ios::binary);
  const std::string magic = head_word(file);
  const int width = std::atoi(head_word(file).c_str());
  const int height = std::atoi(head_word(file).c_str());
  const std::string largest = head_word(file);
  if (!file || magic != "P6" || largest != "65535" || width <= 0 || height <= 0)
    throw std::runtime_error("no PPM of 16 bits was written");
  file.get();
  Image image(width, height);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.size() != 2 * image.values.size()) throw std::runtime_error("the PPM is cut off");
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const auto byte = [&](std::size_t at) { return int{static_cast<unsigned char>(bytes[at])}; };
    image.values[i] = static_cast<float>(256 * byte(2 * i) + byte(2 * i + 1)) / 65535;
  }
  return image;
}

double stated_ms(const std::string& output, const std::string& pattern) {
  std::smatch match;
  return std::regex_search(output, match, std::regex(pattern)) ? 1000 * std::stod(match[1]) : 0;
}

std::string stated_version(const std::string& command, const std::string& pattern) {
  const std::string output = run_command(command).output;
  std::smatch match;
  return std::regex_search(output, match, std::regex(pattern)) ? match[1].str() : "unknown";
}

}  // namespace raytracer::peers
