// What accuracy costs on a scene, as a server measured it: settings with their times and errors.
#pragma once

#include <string>
#include <vector>

namespace raytracer::client {

/// A picture that was made with some settings over the scene's own.
struct CurvePoint {
  std::string name;     ///< "4 samples, single", "target 0.01", "1 sample, no shadows"
  std::string options;  ///< "--samples 4 --precision single": makes it with `raytracer render`
  bool has_target = false;
  bool is_double = false;
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
  double reference_error = 0;      ///< estimated, of what the points were compared with
  std::vector<CurvePoint> points;  ///< the fastest first
};

/// Reads GET /jobs/ID/result. Throws ServerError if it is no curve.
Curve read_curve(const std::string& json);

/// The same as a table: a line of names, then a line for each point, empty where the scene's own
/// value stands.
std::string curve_csv(const std::string& json);

/// The fastest point that keeps the picture and has at most this rmse; null if there is none.
const CurvePoint* cheapest(const Curve& curve, double rmse);

/// Lines of plain ASCII, at most 80 wide but for a long `label`.
std::string curve_text(const Curve& curve, const std::string& label);

/// A complete SVG document. `label` names the scene.
std::string curve_svg(const Curve& curve, const std::string& label);

}  // namespace raytracer::client
