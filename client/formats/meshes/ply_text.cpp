// The numbers of a PLY as text.
#include <fmt/format.h>

#include <cmath>

#include "client/formats/meshes/line_errors.h"
#include "client/formats/meshes/ply_bodies.h"
#include "client/formats/numbers.h"
#include "client/formats/printable.h"

namespace raytracer::client {
namespace {

class PlyTextCheck {
 public:
  PlyTextCheck(const PlyHeader& header, LineWords& words, Reading& reading)
      : header_(header),
        vertex_count_(static_cast<double>(header.vertex_count())),
        words_(words),
        reading_(reading),
        errors_(reading) {}

  void run() {
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) return;  // whether it has lines is nowhere said
      for (std::size_t i = 0; i < element.count; ++i) {
        while (!words_.at_end() && words_.has_no_more()) words_.next_line();
        if (words_.at_end())
          return errors_.add(words_.line(), fmt::format("the file ends after {} of {} {}", i,
                                                        element.count, plural_of(element)));
        check_line(element);
        if (errors_.are_enough()) return;
        words_.next_line();
      }
    }
  }

 private:
  /// One error for each line.
  void check_line(const PlyElement& element) {
    for (const PlyProperty& property : element.properties) {
      const bool is_right =
          property.count ? check_list(element, property) : check_number(element, property);
      if (!is_right) return;
    }
  }

  bool wrong(std::string_view what, std::string_view word, const PlyElement& element,
             const PlyProperty& property) {
    const std::string found = word.empty() ? "the line ends" : quoted(word) + " stands";
    errors_.add(words_.line(), fmt::format("{} where {} is to be, in {} of a {}", found, what,
                                           client::quoted(property.name), printable(element.name)));
    return false;
  }

  bool check_number(const PlyElement& element, const PlyProperty& property) {
    const std::string_view word = words_.next();
    return reads_as_number(word) || wrong("a number", word, element, property);
  }

  bool check_list(const PlyElement& element, const PlyProperty& property) {
    const std::string_view word = words_.next();
    const auto count = count_of(word);
    if (!count) return wrong("the number of a list's entries", word, element, property);
    if (!names_vertices(element, property)) {
      for (std::size_t i = 0; i < *count; ++i)
        if (!check_number(element, property)) return false;
      return true;
    }
    for (std::size_t i = 0; i < *count; ++i) {
      const std::string_view corner = words_.next();
      const auto index = number_of(corner);
      if (!index || *index != std::trunc(*index))
        return wrong("the index of a vertex", corner, element, property);
      if (!(*index >= 0 && *index < vertex_count_)) {
        errors_.add(words_.line(), fmt::format("{} is no index of a vertex: there are {}, which "
                                               "are counted from 0",
                                               quoted(corner), vertex_count_));
        return false;
      }
    }
    if (*count == 0) {
      errors_.add(words_.line(), "a face without corners cannot be read: leave it out");
      return false;
    }
    if (*count < 3) omit_face_of_few_corners(reading_, words_.line());
    return true;
  }

  const PlyHeader& header_;
  double vertex_count_;
  LineWords& words_;
  Reading& reading_;
  LineErrors errors_;
};

}  // namespace

void check_ply_text(const PlyHeader& header, LineWords& words, Reading& reading) {
  PlyTextCheck(header, words, reading).run();
}

}  // namespace raytracer::client
