#include "client/formats/meshes/check_mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "client/formats/meshes/line_words.h"
#include "client/formats/printable.h"

namespace raytracer::client {
namespace {

/// A statement of numbers, of which there is one or as many as `most` says.
struct NumberStatement {
  std::string_view keyword;
  std::string_view usage;
  int most;  ///< numbers
};

constexpr std::array<NumberStatement, 15> statements{{
    {"Ka", "Ka R G B", 3},
    {"Kd", "Kd R G B", 3},
    {"Ks", "Ks R G B", 3},
    {"Ke", "Ke R G B", 3},
    {"Tf", "Tf R G B", 3},
    {"Ns", "Ns EXPONENT", 1},
    {"Ni", "Ni INDEX", 1},
    {"d", "d OPACITY", 1},
    {"Tr", "Tr TRANSPARENCY", 1},
    {"Pr", "Pr ROUGHNESS", 1},
    {"Pm", "Pm METALLIC", 1},
    {"Ps", "Ps SHEEN", 1},
    {"Pc", "Pc CLEARCOAT", 1},
    {"Pcr", "Pcr ROUGHNESS", 1},
    {"aniso", "aniso ANISOTROPY", 1},
}};

/// Empty: nothing.
std::string wrong_with(const NumberStatement& statement, LineWords& words) {
  for (int i = 0; i < statement.most; ++i) {
    const std::string_view word = words.next();
    if (word.empty())
      return i == 1 ? ""
                    : fmt::format("{} has {} numbers; write {}", statement.keyword, i,
                                  statement.usage);
    if (!reads_as_number(word))
      return fmt::format("{} stands where a number is to be; write {}", quoted(word),
                         statement.usage);
  }
  return "";
}

}  // namespace

std::string material_name(std::string_view rest) {
  const std::size_t end = rest.find_last_not_of(" \t\r\n");
  return std::string(rest.substr(0, end + 1));
}

MaterialLibrary check_mtl(std::string_view text, std::string_view name) {
  MaterialLibrary library;
  for (LineWords words(text, true); !words.at_end(); words.next_line()) {
    const std::string_view keyword = words.next();
    if (keyword == "newmtl") library.names.insert(material_name(words.rest()));
    const auto* const statement =
        std::find_if(statements.begin(), statements.end(),
                     [&](const NumberStatement& each) { return each.keyword == keyword; });
    if (statement == statements.end()) continue;
    const int line = words.line();
    if (const std::string wrong = wrong_with(*statement, words); !wrong.empty())
      library.errors.push_back(fmt::format("{}:{}: {}", printable(name), line, wrong));
  }
  return library;
}

}  // namespace raytracer::client
