#include "client/formats/nff/read_nff.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "client/failure.h"
#include "client/formats/arrange.h"
#include "client/formats/lighting.h"
#include "client/formats/nff/contents.h"
#include "client/formats/nff/element_reader.h"
#include "client/formats/printable.h"

namespace raytracer::client {
namespace {

using model::Triple;

/// The horizontal field of view, in radians, of one that is vertical and in degrees.
double horizontal(double angle, int width_px, int height_px) {
  const double vertical = angle / 180 * std::numbers::pi;
  if (width_px == height_px) return vertical;
  return 2 * std::atan(std::tan(vertical / 2) * width_px / height_px);
}

class NffReader {
 public:
  NffReader(std::string_view text, const ImportOptions& options)
      : words_(text), options_(options) {}

  Reading read() {
    std::vector<LineError> errors;
    constexpr std::size_t most_errors = 20;
    while (!words_.at_end() && errors.size() < most_errors) {
      try {
        read_element();
      } catch (const LineError& error) {
        errors.push_back(error);
        while (!words_.at_end() && !element_of(words_.next())) words_.skip();
      }
    }
    Reading reading = std::move(contents_).take();
    if (errors.empty() && !has_view_ && reading.scene.objects.empty()) {
      words_.begin(elements.front().usage);
      errors.push_back(words_.wrong("the file has no viewpoint and nothing to look at"));
    }
    // Where an eye is to be found that sees it all.
    if (errors.empty() && !has_view_ && words_.immoderate()) errors.push_back(*words_.immoderate());
    reading.errors = std::move(errors);
    if (reading.errors.empty()) add_what_is_missing(reading.scene);
    return reading;
  }

 private:
  struct Element {
    std::string_view name;
    void (NffReader::*read)();
    std::string_view usage;
  };
  static const std::array<Element, 8> elements;

  static const Element* element_of(std::string_view word) {
    for (const Element& element : elements)
      if (element.name == word) return &element;
    return nullptr;
  }

  void read_element() {
    const Element* const element = element_of(words_.next());
    if (!element) refuse_word();
    words_.begin(element->usage);
    (this->*element->read)();
    if (words_.is_number_next())
      throw words_.wrong_word(fmt::format("{} is one number too many", quoted(words_.next())));
  }

  void add_what_is_missing(model::Scene& scene) const {
    if (!has_view_)
      scene.view = view_of_all(scene, options_, Upright::z);
    else if (options_.view || options_.zoom != 1)
      throw InputError(
          "says itself from where it is seen; --view and --zoom are for what does not");
    if (scene.lights.empty()) light_studio(scene);
  }

  [[noreturn]] void refuse_word() {
    if (words_.next() == "nff")
      throw LineError{
          words_.next_line(),
          "this is the NFF of Sense8's WorldToolKit; write Haines' Neutral File Format"};
    throw LineError{words_.next_line(),
                    fmt::format("{} is no element of NFF; write v, b, l, f, c, s, p or pp",
                                quoted(words_.next()))};
  }

  void read_view();
  void read_background();
  void read_light();
  void read_fill();
  void read_sphere();
  void read_cone();
  void read_polygon() { read_corners(false); }
  void read_patch() { read_corners(true); }
  void read_corners(bool have_normals);

  NffBall ball() {
    const Triple center = words_.triple();
    return {center, words_.number()};
  }

  ElementReader words_;
  const ImportOptions& options_;
  NffContents contents_;
  bool has_view_ = false;
  bool has_background_ = false;
};

const std::array<NffReader::Element, 8> NffReader::elements{{
    {"v", &NffReader::read_view,
     "v from X Y Z at X Y Z up X Y Z angle DEGREES hither DISTANCE resolution WIDTH HEIGHT"},
    {"b", &NffReader::read_background, "b R G B"},
    {"l", &NffReader::read_light, "l X Y Z or l X Y Z R G B"},
    {"f", &NffReader::read_fill, "f R G B Kd Ks Shine T INDEX"},
    {"s", &NffReader::read_sphere, "s X Y Z RADIUS"},
    {"c", &NffReader::read_cone, "c X Y Z RADIUS X Y Z RADIUS"},
    {"p", &NffReader::read_polygon, "p N and then X Y Z of N corners"},
    {"pp", &NffReader::read_patch, "pp N and then X Y Z NX NY NZ of N corners"},
}};

void NffReader::read_view() {
  std::optional<Triple> from;
  std::optional<Triple> at;
  std::optional<Triple> up;
  std::optional<double> angle;
  std::optional<std::pair<int, int>> resolution;
  for (bool is_inside = true; is_inside;) {
    const std::string_view key = words_.next();
    const auto take = [&](std::string_view name) {
      if (key == name) words_.skip();
      return key == name;
    };
    if (take("from")) {
      from = words_.triple();
    } else if (take("at")) {
      at = words_.triple();
    } else if (take("up")) {
      up = words_.triple();
    } else if (take("angle")) {
      angle = words_.number();
    } else if (take("hither")) {
      if (words_.number() > 0)
        contents_.omit(words_.line(), "hither plane left out", "hither planes left out");
    } else if (take("resolution")) {
      const int width_px = words_.integer_from(1, "the width");
      resolution = {width_px, words_.integer_from(1, "the height")};
    } else {
      is_inside = false;
    }
  }
  if (has_view_) throw words_.wrong("this is a second viewpoint; leave one");
  has_view_ = true;
  if (!from || !at || !up || !angle || !resolution)
    throw words_.wrong("the viewpoint lacks a part");
  if (*from == *at) throw words_.wrong("the viewpoint looks at itself");
  if (*up == Triple{0, 0, 0}) throw words_.wrong("no direction is up");
  const auto [width_px, height_px] = *resolution;
  const double fov = horizontal(*angle, width_px, height_px);
  if (!(*angle > 0 && *angle < 180 && fov > 0 && fov < std::numbers::pi))
    throw words_.wrong(fmt::format("the angle is {}, and lies between 0 and 180", *angle));
  contents_.set_view({*from, *at, *up, fov, width_px, height_px});
}

void NffReader::read_background() {
  const Triple color = words_.shares("the background");
  if (has_background_) throw words_.wrong("this is a second background; leave one");
  has_background_ = true;
  contents_.set_background(color);
}

void NffReader::read_light() {
  const Triple position = words_.triple();
  std::optional<Triple> color;
  if (words_.is_number_next()) {
    color.emplace();
    for (double& channel : *color) channel = words_.number_from_0("the light's colour");
  }
  contents_.add_light(position, color);
}

void NffReader::read_fill() {
  model::Material fill{};
  const auto share = [&](std::string_view name) {
    const double value = words_.number_from_0(name);
    if (value > 1)
      contents_.omit(words_.line(), "Kd, Ks or T above 1, taken as 1",
                     "Kd, Ks or T above 1, taken as 1");
    return std::min(value, 1.0);
  };
  fill.color = words_.shares("the fill's colour");
  fill.kd = share("Kd");
  fill.ks = share("Ks");
  fill.reflectivity = fill.ks;
  // Of Phong: cos^n of an angle that is twice the one between Blinn's normal and halfway vector.
  constexpr double blinn_from_phong = 4;
  fill.shininess = std::min(blinn_from_phong * words_.number_from_0("Shine"),
                            std::numeric_limits<double>::max());
  fill.transparency = share("T");
  fill.ior = words_.number_from_0("the index of refraction");
  if (fill.transparency > 0 && fill.ior < 1)
    contents_.omit(words_.line(), "index of refraction below 1, taken as 1",
                   "indices of refraction below 1, taken as 1");
  // Also where nothing passes: SPD writes 0 there.
  fill.ior = fill.transparency > 0 ? std::max(fill.ior, 1.0) : 1;
  contents_.set_fill(fill);
}

void NffReader::read_sphere() { contents_.add_sphere(words_.line(), ball()); }

void NffReader::read_cone() {
  const NffBall base = ball();
  const NffBall apex = ball();
  if (std::min(base.radius, apex.radius) < 0 && std::max(base.radius, apex.radius) > 0)
    throw words_.wrong("one radius is negative and the other is not");
  contents_.add_cone(words_.line(), base, apex);
}

void NffReader::read_corners(bool have_normals) {
  const int count = words_.integer_from(3, "the number of corners");
  std::vector<Triple> corners;
  std::vector<Triple> normals;
  for (int i = 0; i < count; ++i) {
    corners.push_back(words_.triple());
    if (have_normals) normals.push_back(words_.triple());
  }
  contents_.add_polygon(words_.line(), corners, std::move(normals));
}

}  // namespace

Reading read_nff(std::string_view text, const ImportOptions& options) {
  return NffReader(text, options).read();
}

}  // namespace raytracer::client
