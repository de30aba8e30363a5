// Writes both programs' man pages and completions from the tables that their --help prints:
//   raytracer-manual FOLDER
// puts them into FOLDER/man1, FOLDER/bash and FOLDER/zsh under the names that they are installed
// with. Part of the build; not installed.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "client/arguments.h"
#include "client/manual/completion.h"
#include "client/manual/man_page.h"
#include "client/manual/program.h"
#include "server/catalog.h"
#include "server/config.h"

namespace {

using namespace raytracer::manual;

void write(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::create_directories(path.parent_path());
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

void write_all(const std::filesystem::path& folder) {
  std::vector<std::string> scenes;
  const raytracer::Catalog catalog;
  for (const raytracer::ShippedScene& scene : catalog.scenes()) scenes.push_back(scene.name);
  const auto write_one = [&](const Program& program, const std::string& other) {
    write(folder / "man1" / (program.name + ".1"), man_page(program, RAYTRACER_VERSION, {other}));
    write(folder / "bash" / program.name, bash_completion(program, scenes));
    write(folder / "zsh" / ("_" + program.name), zsh_completion(program, scenes));
  };
  raytracer::client::show_command_line([&](const CLI::App& table) {
    write_one(read_program("raytracer", table), "raytracer-server");
  });
  raytracer::show_flags([&](const CLI::App& table) {
    write_one(read_program("raytracer-server", table), "raytracer");
  });
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: raytracer-manual FOLDER");
  write_all(argv[1]);
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::fprintf(stderr, "raytracer-manual: %s\n", error.what());
  return EXIT_FAILURE;
}
