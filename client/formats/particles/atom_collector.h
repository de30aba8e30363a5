// The atoms of a molecule's model: which of them are shown, and what gives them their colours.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "client/formats/import_options.h"
#include "client/formats/particles/particles.h"

namespace raytracer::client {

struct Atom {
  model::Triple place;
  std::uint8_t element;
  std::string_view chain;
  std::string_view residue;       ///< its name: "GLY", "HOH"
  std::string_view number;        ///< of the residue, with an insertion code
  std::string_view name;          ///< of the atom within the residue: "CA"
  std::string_view alternate;     ///< empty, or which of several places this is
  std::string_view color_word{};  ///< what it has in the column that gives the colours
};

class AtomCollector {
 public:
  explicit AtomCollector(const ImportOptions& options);

  /// What is to give the colours by its numbers; nothing if that is element, chain or residue.
  const std::optional<std::string>& color_column() const { return color_column_; }

  /// That column has words, each of which has a colour.
  void color_by_words() { is_colored_by_words_ = true; }
  bool is_colored_by_words() const { return is_colored_by_words_; }

  /// Its place among the particles; nothing if it is left out, as water is beside anything else.
  /// `color_value`: its number in the column that gives the colours; NaN: none.
  std::optional<std::uint32_t> add(int line, const Atom& atom, float color_value);

  /// Ends the model, which is its water if there is nothing else. Throws LineError if it has no
  /// atoms.
  Particles take(int line);

 private:
  void omit(int line, std::string_view one, std::string_view many);
  bool is_second_place(const Atom& atom);

  ImportOptions options_;
  std::optional<std::string> color_column_;
  bool is_colored_by_words_ = false;
  Particles particles_;
  Particles water_;                           ///< until there is something else
  GroupNames groups_;                         ///< of all models
  std::string residue_;                       ///< the last one's chain and number
  std::string name_;                          ///< which residue is shown at that number
  std::set<std::string, std::less<>> shown_;  ///< its atoms
};

}  // namespace raytracer::client
