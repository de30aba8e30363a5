// What a reader makes of a file that is no scene document: a scene, and what could not be kept.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "client/formats/scene_model.h"

namespace raytracer::client {

/// Something is wrong with a line of a file. `what` says what is, and what to write.
struct LineError {
  int line;  ///< from 1; 0: the file has no lines
  std::string what;
};

/// A kind of thing that the file has and a scene cannot say, or says otherwise.
struct Omission {
  std::string one;   ///< "polygon without area left out"
  std::string many;  ///< "polygons without area left out"
  int count = 0;
  int first_line = 0;
};

/// One more of a kind, by its `one`.
void add_omission(std::vector<Omission>& omissions, int line, std::string_view one,
                  std::string_view many);

struct Reading {
  model::Scene scene;  ///< means something only without errors
  std::vector<Omission> omissions;
  std::vector<LineError> errors;

  void omit(int line, std::string_view one, std::string_view many) {
    add_omission(omissions, line, one, many);
  }
};

}  // namespace raytracer::client
