// What accuracy costs on a scene, as a server measured it: settings with their times and errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace raytracer::client {

/// What a picture was made with, over the scene's own; what is not named is the scene's.
struct CurveSettings {
  std::optional<int> samples;
  std::optional<double> target_rmse;
  std::string precision;  ///< "single", "double"; empty: the server's choice
  std::string shadows;    ///< "off" or empty
  std::optional<int> max_depth;
};

struct CurvePoint {
  CurveSettings settings;
  double trace_ms = 0;
  double rmse = 0;
  double max_error = 0;
  double off_share = 0;          ///< of pixels off by more than 1/255
  bool changes_picture = false;  ///< something of the scene was left out
  bool pareto = false;           ///< no other is as fast and as accurate
};

struct Curve {
  int width_px = 0;
  int height_px = 0;
  int thread_count = 0;
  int reference_samples = 0;
  double reference_error = 0;  ///< estimated, of what the points were compared with
  std::vector<CurvePoint> points;
};

/// One value of each point, in their order.
inline std::vector<double> values_of(const std::vector<CurvePoint>& points,
                                     double CurvePoint::*value) {
  std::vector<double> values;
  for (const CurvePoint& point : points) values.push_back(point.*value);
  return values;
}

/// Reads GET /jobs/ID/result. Throws ServerError if it is no curve.
Curve read_curve(const std::string& json);

/// "4 samples, single", "target 0.01", "1 sample, no shadows"
std::string in_words(const CurveSettings& settings);

/// "--samples 4 --precision single": what makes this picture with `raytracer render`.
std::string as_options(const CurveSettings& settings);

/// The fastest point that keeps the picture and has at most this rmse; null if there is none.
const CurvePoint* cheapest(const Curve& curve, double rmse);

}  // namespace raytracer::client
