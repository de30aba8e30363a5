// What a camera must satisfy, whether its values come from a document or from a query.
#pragma once

#include <string_view>

namespace raytracer {

/// Whether the angle modulo 2 pi is strictly between 0 and pi. The double nearest to pi (or to a
/// multiple of it) stands for that multiple, although it is a hair off.
bool is_field_of_view(double angle);

inline constexpr std::string_view fov_rule =
    "the field of view, taken modulo 2 pi, must lie strictly between 0 and pi";

inline constexpr std::string_view look_at_rule =
    "must differ from origin: the camera has no direction";

}  // namespace raytracer
