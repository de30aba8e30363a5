#include "tests/bench/povray_peer.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <stdexcept>

#include "engine/measure/stopwatch.h"
#include "tests/bench/povray_scene.h"

namespace raytracer::bench {
namespace {

struct CommandOutcome {
  int status;
  std::string output;  ///< both streams
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

/// From a line such as "  Trace Time:  0 hours  0 minutes  0 seconds (0.088 seconds)"; 0 where
/// POV-Ray says nothing, because there was nothing to do.
double time_ms(const std::string& output, const std::string& stage) {
  const std::regex line(stage + R"( Time:.*\(([0-9.]+) seconds\))");
  std::smatch match;
  return std::regex_search(output, match, line) ? 1000 * std::stod(match[1]) : 0;
}

/// The next word of a PPM's head; comments reach from # to the end of the line.
std::string head_word(std::istream& file) {
  std::string word;
  while (file >> word && word[0] == '#') std::getline(file, word);
  return word;
}

ByteImage read_ppm(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string magic = head_word(file);
  const int width = std::atoi(head_word(file).c_str());
  const int height = std::atoi(head_word(file).c_str());
  const std::string largest = head_word(file);
  if (!file || magic != "P6" || largest != "255" || width <= 0 || height <= 0)
    throw std::runtime_error("POV-Ray wrote no PPM of 8 bits");
  file.get();
  ByteImage image(width, height);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.size() != image.values.size()) throw std::runtime_error("POV-Ray's PPM is cut off");
  std::copy(bytes.begin(), bytes.end(), image.values.begin());
  return image;
}

std::filesystem::path make_directory() {
  std::string pattern = (std::filesystem::temp_directory_path() / "bench-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary directory");
  return pattern;
}

}  // namespace

PovrayPeer::PovrayPeer(std::size_t thread_count)
    : thread_count_(thread_count), directory_(make_directory()) {}

PovrayPeer::~PovrayPeer() {
  std::error_code ignored;
  std::filesystem::remove_all(directory_, ignored);
}

void PovrayPeer::set_scene(const Scene& scene) {
  std::ofstream file(directory_ / "scene.pov");
  write_povray_scene(scene, file);
  if (!file.flush()) throw std::runtime_error("POV-Ray's scene could not be written");
  const int samples = scene.render.samples.value_or(1);
  if (samples != 1 && samples != 16)
    throw std::runtime_error("the POV-Ray peer takes 1 or 16 samples");
  options_ = fmt::format("+W{} +H{} +WT{} {}", scene.camera.width, scene.camera.height,
                         thread_count_, samples == 1 ? "-A" : "+A0.0 +AM1 +R4 -J");
}

PovrayRun PovrayPeer::run() const {
  const Stopwatch watch;
  const CommandOutcome outcome = run_command(
      fmt::format("cd '{}' && povray +Iscene.pov +Oscene.ppm +FP File_Gamma=1.0 -D -V -P {}",
                  directory_.string(), options_));
  PovrayRun run;
  run.times.process_ms = watch.elapsed_ms();
  if (outcome.status != 0) throw std::runtime_error("POV-Ray failed:\n" + outcome.output);
  run.times.parse_ms = time_ms(outcome.output, "Parse");
  run.times.bounding_ms = time_ms(outcome.output, "Bounding");
  run.times.trace_ms = time_ms(outcome.output, "Trace");
  run.image = read_ppm(directory_ / "scene.ppm");
  return run;
}

std::string PovrayPeer::version() {
  const std::string output = run_command("povray --version").output;
  std::smatch match;
  return std::regex_search(output, match, std::regex(R"(POV-Ray ([0-9.]*[0-9]))")) ? match[1].str()
                                                                                   : "unknown";
}

}  // namespace raytracer::bench
