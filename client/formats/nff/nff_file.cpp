#include "client/formats/nff/nff_file.h"

#include <utility>

#include "client/formats/nff/read_nff.h"

namespace raytracer::client {
namespace {

class NffFile : public SceneFile {
 public:
  explicit NffFile(std::unique_ptr<TextSource> source) : source_(std::move(source)) {}

  std::optional<Reading> next_frame() override {
    if (!source_) return std::nullopt;
    const auto source = std::exchange(source_, nullptr);
    return read_nff(read_all(*source));
  }

  bool has_more() const override { return source_ != nullptr; }

 private:
  std::unique_ptr<TextSource> source_;
};

}  // namespace

std::unique_ptr<SceneFile> open_nff(FileInput input, const Wishes&) {
  return std::make_unique<NffFile>(std::move(input.source));
}

}  // namespace raytracer::client
