#include "client/formats/meshes/check_stl.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

#include "client/failure.h"
#include "client/formats/meshes/line_errors.h"
#include "client/formats/meshes/line_words.h"
#include "client/formats/printable.h"

namespace raytracer::client {
namespace {

constexpr std::size_t binary_header = 84;
constexpr std::size_t binary_triangle = 50;

std::size_t binary_count(std::string_view bytes) {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + binary_header - sizeof count, sizeof count);
  return count;
}

/// In a header or a count of less than sixteen million there is a zero, in a text there is none.
bool has_no_text(std::string_view bytes) {
  return bytes.substr(0, binary_header).find('\0') != bytes.npos;
}

/// Facets with three vertices each, in any lines.
class StlTextCheck {
 public:
  StlTextCheck(std::string_view text, Reading& reading)
      : words_(text), reading_(reading), errors_(reading) {}

  void run() {
    for (next(); !word_.empty() && !errors_.are_enough();) {
      if (word_ == "solid")
        begin_solid();
      else if (word_ == "facet")
        begin_facet();
      else if (word_ == "vertex")
        read_vertex();
      else if (word_ == "endfacet")
        end_facet();
      else if (word_ == "endsolid")
        end_solid();
      else if (word_ == "outer" || word_ == "loop" || word_ == "endloop")
        next();
      else
        skip_unknown();
    }
    if (!errors_.are_enough() && is_in_solid_)
      errors_.add(words_.line(), fmt::format("the file ends after {} triangle{}, without endsolid",
                                             triangles_, triangles_ == 1 ? "" : "s"));
  }

 private:
  void next() {
    for (word_ = words_.next(); word_.empty() && !words_.at_end(); word_ = words_.next())
      words_.next_line();
  }

  /// Its name is what else stands in the line, unless all stands in one.
  void begin_solid() {
    is_in_solid_ = true;
    const auto begins_facet = [&] {
      LineWords ahead = words_;
      return word_ == "facet" && ahead.next() == "normal";
    };
    for (word_ = words_.next(); !word_.empty() && !begins_facet(); word_ = words_.next()) {
    }
    if (word_.empty()) next();
  }

  void begin_facet() {
    close_facet();
    is_in_facet_ = true;
    corners_ = 0;
    next();
    if (word_ != "normal") return wrong("normal", "facet normal X Y Z");
    next();
    read_numbers("facet normal X Y Z");
  }

  void read_vertex() {
    ++corners_;
    next();
    read_numbers("vertex X Y Z");
  }

  void close_facet() {
    if (!is_in_facet_) return;
    if (corners_ != 3)
      errors_.add(words_.line(),
                  fmt::format("the facet has {} vert{}; write three times vertex X Y Z", corners_,
                              corners_ == 1 ? "ex" : "ices"));
    is_in_facet_ = false;
    ++triangles_;
  }

  void end_facet() {
    close_facet();
    next();
  }

  void end_solid() {
    is_in_solid_ = false;
    words_.rest();
    next();
  }

  void read_numbers(std::string_view usage) {
    for (int i = 0; i < 3; ++i, next())
      if (!reads_as_number(word_)) return wrong("a number", usage);
  }

  void wrong(std::string_view what, std::string_view usage) {
    if (word_.empty()) return;  // that the file ends is said once
    errors_.add(words_.line(),
                fmt::format("{} stands where {} is to be; write {}", quoted(word_), what, usage));
    if (word_ != "facet" && word_ != "vertex" && word_ != "endfacet" && word_ != "endsolid") next();
  }

  void skip_unknown() {
    reading_.omit(words_.line(), "statement left out that is not known",
                  "statements left out that are not known");
    words_.rest();
    next();
  }

  LineWords words_;
  std::string_view word_;
  Reading& reading_;
  LineErrors errors_;
  bool is_in_solid_ = false;
  bool is_in_facet_ = false;
  int corners_ = 0;  ///< of the facet
  std::size_t triangles_ = 0;
};

}  // namespace

void check_stl(std::string_view bytes, Reading& reading) {
  if (has_no_text(bytes)) {
    if (bytes.size() < binary_header) return;
    const std::size_t there = (bytes.size() - binary_header) / binary_triangle;
    if (there < binary_count(bytes))
      throw InputError(
          fmt::format("the file ends after {} of {} triangles", there, binary_count(bytes)));
    return;
  }
  if (LineWords(bytes).next() == "solid") StlTextCheck(bytes, reading).run();
}

}  // namespace raytracer::client
