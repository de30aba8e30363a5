// Renders a scene several times on one thread and drops the pictures, for programs that count
// what that takes.

#include <charconv>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>

#include "engine/engine.h"

int main(int argc, char** argv) {
  using namespace raytracer;
  int times = 0;
  if (argc == 3) std::from_chars(argv[2], argv[2] + std::strlen(argv[2]), times);
  if (times < 1) {
    std::cerr << "usage: render_repeatedly SCENE TIMES\n";
    return 1;
  }
  std::ifstream file(argv[1], std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  Overrides overrides;
  overrides.width = 175;
  overrides.height = 125;
  overrides.samples = 1;
  const Result<Scene> scene = read_scene(text, Limits{}, overrides);
  if (!scene.ok()) {
    std::cerr << argv[1] << ": " << scene.errors()[0].pointer << ": " << scene.errors()[0].detail
              << '\n';
    return 1;
  }
  WorkerPool pool(1);
  for (int i = 0; i < times; ++i) {
    RenderProgress progress;
    render(scene.value(), Limits{}, pool, progress);
  }
  return 0;
}
