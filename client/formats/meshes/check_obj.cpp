#include "client/formats/meshes/check_obj.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "client/formats/meshes/check_mtl.h"
#include "client/formats/meshes/line_errors.h"
#include "client/formats/meshes/line_words.h"
#include "client/formats/meshes/obj_statements.h"
#include "client/formats/numbers.h"
#include "client/formats/printable.h"

namespace raytracer::client {
namespace {

/// Of vertices, places of textures and normals, in the order in which a corner names them.
using ObjCounts = std::array<long long, 3>;

void count(ObjStatement statement, ObjCounts& counts) {
  if (statement == ObjStatement::vertex) ++counts[0];
  if (statement == ObjStatement::texture_place) ++counts[1];
  if (statement == ObjStatement::normal) ++counts[2];
}

class ObjCheck {
 public:
  ObjCheck(std::string_view text, const FileBeside& beside, Reading& reading)
      : text_(text), words_(text, true), beside_(beside), reading_(reading), errors_(reading) {}

  void run() {
    for (; !words_.at_end() && !errors_.are_enough(); words_.next_line()) {
      const std::string_view keyword = words_.next();
      if (!keyword.empty()) check(obj_statement(keyword));
    }
    // Without faces they are what there is to show.
    if (has_faces_ && points_.count > 0) reading_.omissions.push_back(points_);
    if (!lacks_library_) omit_materials();
  }

 private:
  void check(ObjStatement statement) {
    const int line = words_.line();
    count(statement, counts_);
    switch (statement) {
      case ObjStatement::vertex:
        return check_vertex();
      case ObjStatement::texture_place:
        return check_texture_place();
      case ObjStatement::normal:
        return check_normal();
      case ObjStatement::face:
        return check_face(line);
      case ObjStatement::line:
        check_corners("l V V");
        return reading_.omit(line, "line left out", "lines left out");
      case ObjStatement::point:
        if (points_.count == 0) points_.first_line = line;
        points_.count += check_corners("p V");
        return;
      case ObjStatement::curve:
        return reading_.omit(line, "curve or surface by equations left out",
                             "curves and surfaces by equations left out");
      case ObjStatement::unknown:
        return reading_.omit(line, "statement left out that is not known",
                             "statements left out that are not known");
      case ObjStatement::material:
        used_materials_.try_emplace(material_name(words_.rest()), line);
        return;
      case ObjStatement::material_library:
        return check_library(line);
      case ObjStatement::name:
      case ObjStatement::curve_part:
      case ObjStatement::display:
        return;
    }
  }

  /// How many there are in the rest of the line; nothing, with an error, if a word is none.
  /// `fourth` becomes the fourth one.
  std::optional<int> numbers(std::string_view usage, std::string_view* fourth = nullptr) {
    int found = 0;
    for (auto word = words_.next(); !word.empty(); word = words_.next()) {
      if (!reads_as_number(word)) {
        errors_.add(words_.line(), fmt::format("{} stands where a number is to be; write {}",
                                               quoted(word), usage));
        return std::nullopt;
      }
      if (++found == 4 && fourth) *fourth = word;
    }
    return found;
  }

  void check_library(int line) {
    const std::string name = material_name(words_.rest());
    const auto text = beside_(name);
    if (!text) {
      lacks_library_ = true;  // which is told, and not what it would have
      return;
    }
    MaterialLibrary library = check_mtl(*text, name);
    materials_.merge(library.names);
    for (std::string& error : library.errors) errors_.add(line, std::move(error));
  }

  void omit_materials() {
    std::vector<int> lines;
    for (const auto& [name, line] : used_materials_)
      if (materials_.count(name) == 0) lines.push_back(line);
    std::sort(lines.begin(), lines.end());
    for (const int line : lines)
      reading_.omit(line, "material left out that no mtllib says",
                    "materials left out that no mtllib says");
  }

  void check_vertex() {
    constexpr std::string_view usage = "v X Y Z, v X Y Z W or v X Y Z R G B";
    std::string_view fourth;
    const auto found = numbers(usage, &fourth);
    if (!found) return;
    if (*found < 3)
      errors_.add(words_.line(), fmt::format("the vertex has {} number{}; write {}", *found,
                                             *found == 1 ? "" : "s", usage));
    else if (*found == 4 && number_of(fourth) == 0)
      errors_.add(words_.line(), fmt::format("the vertex is divided by 0; write {}", usage));
  }

  void check_texture_place() {
    constexpr std::string_view usage = "vt U, vt U V or vt U V W";
    const auto found = numbers(usage);
    if (found && (*found < 1 || *found > 3))
      errors_.add(words_.line(),
                  fmt::format("the place of a texture has {} numbers; write {}", *found, usage));
  }

  void check_normal() {
    constexpr std::string_view usage = "vn X Y Z";
    const auto found = numbers(usage);
    if (found && *found < 3)
      errors_.add(words_.line(), fmt::format("the normal has {} number{}; write {}", *found,
                                             *found == 1 ? "" : "s", usage));
  }

  void check_face(int line) {
    if (check_corners("f V V V, f V/T V/T V/T, f V//N V//N V//N or f V/T/N V/T/N V/T/N") >= 3)
      has_faces_ = true;
    else
      omit_face_of_few_corners(reading_, line);
  }

  /// How many the rest of the line has. One error for each line.
  int check_corners(std::string_view usage) {
    int corners = 0;
    bool is_right = true;
    for (auto word = words_.next(); !word.empty(); word = words_.next(), ++corners) {
      if (!is_right) continue;
      const std::string what = wrong_with_corner(word);
      is_right = what.empty();
      if (!is_right) errors_.add(words_.line(), fmt::format("{}; write {}", what, usage));
    }
    return corners;
  }

  /// Empty: nothing.
  std::string wrong_with_corner(std::string_view word) {
    const char* at = word.data();
    const char* const end = at + word.size();
    for (std::size_t part = 0; part < counts_.size(); ++part) {
      if (at != end && *at == '+') ++at;
      long long index = 0;
      const auto [stop, error] = std::from_chars(at, end, index);
      const bool is_left_out = stop == at && part > 0;
      if (error != std::errc() && !is_left_out) break;
      if (!is_left_out && !exists(index, part)) return no_such(word, index, part);
      at = stop;
      if (at == end || *at == '#') return {};
      if (*at != '/') break;
      ++at;
    }
    if (at == end && word.ends_with('/')) return {};
    return quoted(word) + " is no corner";
  }

  bool exists(long long index, std::size_t part) {
    if (index < 0) return index >= -counts_[part] || is_without(part);
    // Mostly what a face names stands before it, but it may come later.
    return index > 0 && (index <= counts_[part] || index <= totals()[part] || is_without(part));
  }

  /// Files without them name places of textures and normals, and assimp looks for none then.
  bool is_without(std::size_t part) { return part > 0 && totals()[part] == 0; }

  std::string no_such(std::string_view word, long long index, std::size_t part) {
    if (index == 0) return quoted(word) + " is no corner: OBJ counts from 1";
    static constexpr std::array<const char*, 3> kinds{"vertices", "places of textures", "normals"};
    return fmt::format("{} names number {} of the {}, and there are {}{}", quoted(word), index,
                       kinds[part], index < 0 ? counts_[part] : totals()[part],
                       index < 0 ? " so far" : "");
  }

  const ObjCounts& totals() {
    if (totals_) return *totals_;
    totals_.emplace();
    for (LineWords words(text_, true); !words.at_end(); words.next_line())
      count(obj_statement(words.next()), *totals_);
    return *totals_;
  }

  std::string_view text_;
  LineWords words_;
  const FileBeside& beside_;
  Reading& reading_;
  LineErrors errors_;
  bool has_faces_ = false;
  Omission points_{"point beside faces left out", "points beside faces left out", 0, 0};
  bool lacks_library_ = false;
  std::set<std::string> materials_;            ///< of all libraries
  std::map<std::string, int> used_materials_;  ///< by the line of the first use
  ObjCounts counts_{};                         ///< so far
  std::optional<ObjCounts> totals_;            ///< of the file; known once they are asked for
};

}  // namespace

void check_obj(std::string_view text, const FileBeside& beside, Reading& reading) {
  ObjCheck(text, beside, reading).run();
}

}  // namespace raytracer::client
