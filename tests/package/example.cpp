// A program of somebody else's: a scene from standard input, its picture to standard output.
#include <engine/engine.h>

#include <iostream>
#include <iterator>
#include <string>

int main() {
  const std::string text(std::istreambuf_iterator<char>(std::cin), {});
  const auto scene = raytracer::read_scene(text, raytracer::Limits{});
  if (!scene.ok()) {
    for (const auto& error : scene.errors())
      std::cerr << error.pointer << ": " << error.detail << '\n';
    return 1;
  }
  raytracer::WorkerPool pool(2);
  raytracer::RenderProgress progress;
  const auto rendering = raytracer::render(scene.value(), raytracer::Limits{}, pool, progress);
  std::cout << raytracer::encode(rendering.image, raytracer::ImageFormat::png, pool);
}
