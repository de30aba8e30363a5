// What ended a render, as reports say it.
#pragma once

#include "engine/engine.h"

namespace raytracer::published {

inline const char* stop_text(Stop stop) {
  switch (stop) {
    case Stop::samples:
      return "samples";
    case Stop::target:
      return "target";
    case Stop::budget:
      return "budget";
    case Stop::cancelled:
      return "cancelled";
  }
  return "";
}

}  // namespace raytracer::published
