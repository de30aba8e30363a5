#include "engine/fields/field_rules.h"

#include <fmt/format.h>

#include <cmath>

namespace raytracer {
namespace {

bool is_field_of_view(double angle) {
  if (angle > 0 && angle < 1) return true;  // however small
  const double sine = std::sin(angle / 2);
  const double cosine = std::cos(angle / 2);
  const double spacing = std::nextafter(std::abs(angle), infinity) - std::abs(angle);
  return sine * cosine > 0 && 2 * std::abs(sine) > spacing && 2 * std::abs(cosine) > spacing;
}

std::string complaint_about_integer(double value, const ValueRange& range) {
  if (value != std::floor(value)) return fmt::format("{} must be an integer", value);
  return range.contains(value) ? "" : out_of_range(value, "an integer " + range.describe());
}

}  // namespace

std::string ValueRange::describe() const {
  if (std::isinf(least)) return fmt::format("at most {}", most);
  if (std::isinf(most)) return fmt::format("{} {}", least_excluded ? "above" : "at least", least);
  return fmt::format("{} {} to {}{}", least_excluded ? "above" : "from", least,
                     most_excluded ? "below " : "", most);
}

std::string out_of_range(double value, std::string_view wanted) {
  return fmt::format("{} is out of range: must be {}", value, wanted);
}

std::string NotBothZeroRule::complaint(double value, double other_value) const {
  if (value == 0 && other_value == 0)
    return fmt::format("must not be 0 where {} is: nothing is left", other);
  return NumberRule{not_negative}.complaint(value);
}

std::string IntegerRule::complaint(double value) const {
  return complaint_about_integer(
      value, {.least = static_cast<double>(least), .most = static_cast<double>(most)});
}

std::string CountRule::complaint(double value) const {
  return complaint_about_integer(value, {.least = static_cast<double>(least)});
}

std::string FieldOfViewRule::complaint(double angle) {
  if (is_field_of_view(angle)) return "";
  return fmt::format(
      "{} is out of range: the field of view, taken modulo 2 pi, must lie strictly between 0 and "
      "pi",
      angle);
}

std::string PointRule::complaint(const Vec3& point) {
  const bool is_finite = std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
  return is_finite ? "" : "must be three finite numbers";
}

std::string OtherPointRule::complaint(const Vec3& point, const Vec3& other_point) const {
  return point == other_point ? fmt::format("must differ from {}: {}", other, reason)
                              : PointRule::complaint(point);
}

std::string DirectionRule::complaint(const Vec3& direction) {
  return direction == Vec3{} ? "the zero vector has no direction" : PointRule::complaint(direction);
}

}  // namespace raytracer
