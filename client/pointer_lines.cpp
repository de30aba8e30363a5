#include "client/pointer_lines.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <tuple>

namespace raytracer::client {
namespace {

using nlohmann::json;

/// nlohmann-json 3.11 does not keep where a value stood; so this follows its parser, and asks the
/// stream how far that has read when it meets a value that is wanted.
class Follower {
 public:
  Follower(const std::vector<std::string>& pointers, const std::string& text)
      : text_(text), stream_(text) {
    for (std::string pointer : pointers)
      for (; pointer.starts_with('/'); pointer.erase(pointer.rfind('/'))) wanted_.insert(pointer);
    wanted_.insert("");
  }

  std::map<std::string, int> lines() {
    const auto follow = [this](int, json::parse_event_t event, const json& parsed) {
      return meet(event, parsed);
    };
    std::ignore = json::parse(stream_, follow, false);
    return lines_;
  }

 private:
  struct Container {
    std::string pointer;
    bool is_array = false;
    int count = 0;         ///< of an array: its values so far
    std::string key = {};  ///< of an object: that of its next value, as "/key"
  };

  /// Says what the parser is to keep: keys, or it would not tell of the ends of what they name.
  bool meet(json::parse_event_t event, const json& parsed) {
    switch (event) {
      case json::parse_event_t::key:
        open_.back().key = (json::json_pointer() / parsed.get<std::string>()).to_string();
        return true;
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        open_.pop_back();
        return false;
      case json::parse_event_t::value:
        note(next_pointer());
        return false;
      case json::parse_event_t::object_start:
      case json::parse_event_t::array_start:
        open_.push_back({next_pointer(), event == json::parse_event_t::array_start});
        note(open_.back().pointer);
        return true;
    }
    return false;
  }

  std::string next_pointer() {
    if (open_.empty()) return "";
    Container& container = open_.back();
    return container.pointer +
           (container.is_array ? "/" + std::to_string(container.count++) : container.key);
  }

  void note(const std::string& pointer) {
    if (!wanted_.contains(pointer)) return;
    // Less one: after a number the parser has read what ends it, which may be the line's end.
    const std::ptrdiff_t read =
        static_cast<std::ptrdiff_t>(stream_.rdbuf()->pubseekoff(0, std::ios::cur, std::ios::in)) -
        1;
    line_ +=
        static_cast<int>(std::count(text_.begin() + line_counted_, text_.begin() + read, '\n'));
    line_counted_ = read;
    lines_[pointer] = line_;
  }

  const std::string& text_;
  std::istringstream stream_;
  std::set<std::string> wanted_;
  std::vector<Container> open_;  ///< innermost last
  int line_ = 1;
  std::ptrdiff_t line_counted_ = 0;  ///< bytes
  std::map<std::string, int> lines_;
};

}  // namespace

std::map<std::string, int> lines_of(const std::vector<std::string>& pointers,
                                    const std::string& text) {
  return Follower(pointers, text).lines();
}

}  // namespace raytracer::client
