// Where a rendered image goes: a file, the terminal, or standard output.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "client/api.h"
#include "client/output_file.h"

namespace raytracer::client {

class Delivery {
 public:
  /// Into the file, whose ending names an image format; without one into the terminal, in the best
  /// way that it has, or as it is to a standard output that is none. Throws InputError if the file
  /// cannot be written.
  explicit Delivery(const std::optional<OutputFile>& file);

  /// What the image has to be asked for as, in terms of Accept. A terminal takes the cheapest
  /// that can be had.
  std::string media_type() const;

  /// Delivers it, and says on standard error in one line what became of the scene called `label`.
  void operator()(const RenderedImage& image, const std::string& label) const;

 private:
  std::optional<OutputFile> file_;
  bool into_terminal_;
};

}  // namespace raytracer::client
