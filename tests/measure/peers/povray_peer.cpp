#include "tests/measure/peers/povray_peer.h"

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
#include <type_traits>

#include "engine/measure/stopwatch.h"
#include "tests/measure/peers/povray_scene.h"

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

unsigned char channel_at(const std::string& bytes, std::size_t index, const ByteImage&) {
  return static_cast<unsigned char>(bytes[index]);
}

/// Of 16 bits, the upper eight first.
float channel_at(const std::string& bytes, std::size_t index, const Image&) {
  const auto byte = [&](std::size_t i) { return int{static_cast<unsigned char>(bytes[i])}; };
  return static_cast<float>(256 * byte(2 * index) + byte(2 * index + 1)) / 65535;
}

template <typename Channel>
Raster<Channel> read_ppm(const std::filesystem::path& path) {
  constexpr std::size_t bytes_of_channel = std::is_same_v<Channel, float> ? 2 : 1;
  std::ifstream file(path, std::ios::binary);
  const std::string magic = head_word(file);
  const int width = std::atoi(head_word(file).c_str());
  const int height = std::atoi(head_word(file).c_str());
  const std::string largest = head_word(file);
  if (!file || magic != "P6" || largest != (bytes_of_channel == 2 ? "65535" : "255") ||
      width <= 0 || height <= 0)
    throw std::runtime_error(fmt::format("POV-Ray wrote no PPM of {} bits", 8 * bytes_of_channel));
  file.get();
  Raster<Channel> image(width, height);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.size() != bytes_of_channel * image.values.size())
    throw std::runtime_error("POV-Ray's PPM is cut off");
  for (std::size_t i = 0; i < image.values.size(); ++i)
    image.values[i] = channel_at(bytes, i, image);
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
  width_ = scene.camera.width;
  height_ = scene.camera.height;
  samples_ = scene.render.samples.value_or(1);
}

PovrayRun PovrayPeer::run() const {
  if (samples_ != 1 && samples_ != 16)
    throw std::runtime_error("the POV-Ray peer takes 1 or 16 samples");
  return run_with<unsigned char>(samples_ == 1 ? "+FP -A" : "+FP +A0.0 +AM1 +R4 -J");
}

PovrayFloatRun PovrayPeer::run(const PovrayAntialiasing& antialiasing) const {
  return run_with<float>(fmt::format("+FP16 +A{:.3f} +AM{} +R{} -J", antialiasing.threshold,
                                     antialiasing.method, antialiasing.depth));
}

template <typename Channel>
BasicPovrayRun<Channel> PovrayPeer::run_with(const std::string& options) const {
  const Stopwatch watch;
  const CommandOutcome outcome = run_command(fmt::format(
      "cd '{}' && povray +Iscene.pov +Oscene.ppm File_Gamma=1.0 -D -V -P +W{} +H{} +WT{} {}",
      directory_.string(), width_, height_, thread_count_, options));
  BasicPovrayRun<Channel> run;
  run.times.process_ms = watch.elapsed_ms();
  if (outcome.status != 0) throw std::runtime_error("POV-Ray failed:\n" + outcome.output);
  run.times.parse_ms = time_ms(outcome.output, "Parse");
  run.times.bounding_ms = time_ms(outcome.output, "Bounding");
  run.times.trace_ms = time_ms(outcome.output, "Trace");
  run.image = read_ppm<Channel>(directory_ / "scene.ppm");
  return run;
}

std::string PovrayPeer::version() {
  const std::string output = run_command("povray --version").output;
  std::smatch match;
  return std::regex_search(output, match, std::regex(R"(POV-Ray ([0-9.]*[0-9]))")) ? match[1].str()
                                                                                   : "unknown";
}

}  // namespace raytracer::bench
