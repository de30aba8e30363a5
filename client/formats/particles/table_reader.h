// Tables of points: a header, and a line for each. Fields are separated by commas (or by
// semicolons, if the header has no comma) or by tabs; lines that begin with # are comments.
#pragma once

#include <memory>
#include <optional>

#include "client/formats/lines.h"
#include "client/formats/particles/columns.h"
#include "client/formats/particles/particle_reader.h"

namespace raytracer::client {

class TableReader : public ParticleReader {
 public:
  TableReader(std::unique_ptr<TextSource> source, char separator, const Wishes& wishes);
  std::optional<Particles> next_frame() override;
  bool has_more() const override { return false; }

 private:
  void split();

  std::unique_ptr<TextSource> source_;
  Lines lines_;
  char separator_;
  std::string color_;
  std::string record_;  ///< one that goes over several lines
  std::vector<std::string_view> fields_;
  std::vector<std::string> unquoted_;
};

}  // namespace raytracer::client
