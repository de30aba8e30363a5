// A decision, and why it was made in words and numbers.
#pragma once

#include <fmt/format.h>

#include <functional>
#include <string>

namespace raytracer {

/// A sentence that is put together when somebody asks for it: most plans are made to be carried
/// out, and nobody does.
using Reason = std::function<std::string()>;

template <typename T>
struct Choice {
  T value;
  Reason reason;
};

/// fmt::format(text, values...), later; `text` is a literal.
template <typename... Values>
Reason because(fmt::format_string<const Values&...> text, const Values&... values) {
  return [text, values...] { return fmt::format(text, values...); };
}

}  // namespace raytracer
