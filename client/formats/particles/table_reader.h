// Tables of points: a header, and a line for each. Fields are separated by commas (or by
// semicolons, if the header has no comma) or by tabs; lines that begin with # are comments. One of
// these may be the header, as numpy.savetxt writes it; then white space may separate fields, too.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/formats/lines.h"
#include "client/formats/particles/particle_reader.h"

namespace raytracer::client {

class TableReader : public ParticleReader {
 public:
  TableReader(std::unique_ptr<TextSource> source, char separator, const ImportOptions& options);
  std::optional<Particles> next_frame() override;
  bool has_more() const override { return false; }

 private:
  struct Header {
    std::vector<std::string> names;
    int line;
    bool is_comment;  ///< so that the line which has been split is a point's
  };

  void skip_comments();
  void find_separator();
  void split();
  Header read_header();

  std::unique_ptr<TextSource> source_;
  Lines lines_;
  char separator_;
  ImportOptions options_;
  std::string comment_;  ///< the last one before the points that names x, y and z
  int comment_line_ = 1;
  std::string record_;  ///< one that goes over several lines
  std::vector<std::string_view> fields_;
  std::vector<std::string> unquoted_;
};

}  // namespace raytracer::client
