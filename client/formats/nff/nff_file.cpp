#include "client/formats/nff/nff_file.h"

#include <utility>

#include "client/formats/nff/read_nff.h"
#include "client/formats/words.h"

namespace raytracer::client {
namespace {

class NffFile : public SceneFile {
 public:
  NffFile(std::unique_ptr<TextSource> source, const ImportOptions& options)
      : source_(std::move(source)), options_(options) {}

  std::optional<Reading> next_frame() override {
    if (!source_) return std::nullopt;
    const auto source = std::exchange(source_, nullptr);
    return read_nff(without_byte_order_mark(read_all(*source)), options_);
  }

  bool has_more() const override { return source_ != nullptr; }

 private:
  std::unique_ptr<TextSource> source_;
  ImportOptions options_;
};

}  // namespace

std::unique_ptr<SceneFile> open_nff(FileInput input, const ImportOptions& options) {
  return std::make_unique<NffFile>(std::move(input.source), options);
}

}  // namespace raytracer::client
