// XYZ: a number of atoms, a comment, and a line for each atom, "C 0.0 1.2 3.4"; then perhaps the
// next frame. An extended one's comment says the columns:
// Properties=species:S:1:pos:R:3:charge:R:1, of which those with several numbers are called
// force_1, force_2 and so on. Elements may be numbers.
#pragma once

#include <memory>
#include <optional>

#include "client/formats/lines.h"
#include "client/formats/particles/columns.h"
#include "client/formats/particles/particle_reader.h"

namespace raytracer::client {

class XyzReader : public ParticleReader {
 public:
  XyzReader(std::unique_ptr<TextSource> source, const ImportOptions& options);
  std::optional<Particles> next_frame() override;
  bool has_more() const override { return !lines_.at_end(); }

 private:
  std::size_t read_count();
  void read_comment();

  std::unique_ptr<TextSource> source_;
  Lines lines_;
  ImportOptions options_;
  std::optional<Columns> columns_;
  std::vector<std::string_view> fields_;
};

}  // namespace raytracer::client
