#include "tests/measure/peers/embree_kernel.h"

#include <immintrin.h>

#include "tests/measure/peers/embree_lanes.h"
#include "tests/measure/peers/embree_rays.h"
#include "tests/measure/peers/embree_shadows.h"

namespace raytracer::peers {
namespace {

// Of the distance from the eye, which is the largest number in the computation of a hit: a little
// above the error of single precision there.
constexpr float leaving_offset = 2e-6F;

/// Embree's advice: subnormal numbers are slow, and nothing here needs them.
class FlushSubnormals {
 public:
  FlushSubnormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | flush_to_zero_and_read_zero); }
  ~FlushSubnormals() { _mm_setcsr(before_); }
  FlushSubnormals(const FlushSubnormals&) = delete;
  FlushSubnormals& operator=(const FlushSubnormals&) = delete;

 private:
  static constexpr unsigned flush_to_zero_and_read_zero = 0x8040;
  unsigned before_;
};

/// A mean of 1, and what is added before a value is cut to whole ones.
template <typename Channel>
struct Scale;
template <>
struct Scale<unsigned char> {
  static constexpr float one = 255;
  static constexpr float rounding = 0.5F;
};
template <>
struct Scale<float> {
  static constexpr float one = 1;
  static constexpr float rounding = 0;
};

template <int width, typename Channel>
class TileTracer : Lanes<width> {
 public:
  TileTracer(const EmbreeFrame& frame, EmbreeMode mode, unsigned seed)
      : frame_(frame), rays_(frame, mode), shadows_(frame, rays_, seed) {}

  /// A packet is a block of pixels, or as many samples of one pixel if there are enough.
  void trace(int x_begin, int y_begin, int x_end, int y_end, Channel* rgb) {
    const bool has_many_samples = frame_.sample_count % width == 0;
    const int columns = has_many_samples ? 1 : Packet<width>::columns;
    const int rows = has_many_samples ? 1 : width / columns;
    for (int y = y_begin; y < y_end; y += rows) {
      for (int x = x_begin; x < x_end; x += columns) {
        if (has_many_samples)
          trace_pixel(x, y, rgb);
        else
          trace_block(x, y, x_end, y_end, rgb);
      }
    }
  }

 private:
  using typename Lanes<width>::F;
  using typename Lanes<width>::M;
  using typename Lanes<width>::Vector;
  using RayHit = typename Packet<width>::RayHit;
  using Lanes<width>::any;
  using Lanes<width>::clamped;
  using Lanes<width>::dot;
  using Lanes<width>::load;
  using Lanes<width>::plus;
  using Lanes<width>::power;
  using Lanes<width>::root;
  using Lanes<width>::splat;
  using Lanes<width>::times;
  using Lanes<width>::total;
  using Lanes<width>::unit;

  struct Surface {
    Vector color;
    F ka, kd, ks, shininess, reflectivity;
  };

  void trace_block(int x_begin, int y_begin, int x_end, int y_end, Channel* rgb) {
    F x;
    F y;
    M inside;
    for (int i = 0; i < width; ++i) {
      const int column = x_begin + i % Packet<width>::columns;
      const int row = y_begin + i / Packet<width>::columns;
      x[i] = static_cast<float>(column);
      y[i] = static_cast<float>(frame_.height - 1 - row);
      inside[i] = column < x_end && row < y_end ? -1 : 0;
    }
    Vector sum{};
    for (int s = 0; s < frame_.sample_count; ++s)
      sum = plus(sum, clamped(radiance(x + frame_.sample_x[s], y + frame_.sample_y[s], inside)));
    const Vector values = in_channels(sum);
    for (int i = 0; i < width; ++i) {
      if (!inside[i]) continue;
      const int column = x_begin + i % Packet<width>::columns;
      const int row = y_begin + i / Packet<width>::columns;
      store(values, i, column, row, rgb);
    }
  }

  void trace_pixel(int column, int row, Channel* rgb) {
    const auto x = static_cast<float>(column);
    const auto y = static_cast<float>(frame_.height - 1 - row);
    Vector sum{};
    for (int s = 0; s < frame_.sample_count; s += width)
      sum = plus(sum, clamped(radiance(load(frame_.sample_x + s) + x, load(frame_.sample_y + s) + y,
                                       M{} - 1)));
    store(in_channels({F{} + total(sum.x), F{} + total(sum.y), F{} + total(sum.z)}), 0, column, row,
          rgb);
  }

  /// The mean of the samples of this sum, to be cut to what a channel holds.
  Vector in_channels(const Vector& sum) const {
    const float scale = Scale<Channel>::one / static_cast<float>(frame_.sample_count);
    constexpr float rounding = Scale<Channel>::rounding;
    return {sum.x * scale + rounding, sum.y * scale + rounding, sum.z * scale + rounding};
  }

  void store(const Vector& values, int lane, int column, int row, Channel* rgb) const {
    Channel* pixel = rgb + 3 * (static_cast<long>(row) * frame_.width + column);
    pixel[0] = static_cast<Channel>(values.x[lane]);
    pixel[1] = static_cast<Channel>(values.y[lane]);
    pixel[2] = static_cast<Channel>(values.z[lane]);
  }

  Vector radiance(F x, F y, M active) {
    const F right = x * (2 / static_cast<float>(frame_.width)) - 1.0F;
    const F up = y * (2 / static_cast<float>(frame_.height)) - 1.0F;
    Vector direction = unit(plus(splat(frame_.forward), plus(times(splat(frame_.right), right),
                                                             times(splat(frame_.up), up))));
    Vector origin{};
    Vector sum{};
    F weight = splat(1);
    F path = F{};  // from the eye, along the reflections
    for (int depth = 0;; ++depth) {
      const RayHit hit = rays_.intersect(origin, direction, active, depth);
      const M met = active & (load(hit.hit.geomID) != -1);

      const M missed = active & ~met;
      const F sky = missed ? weight : F{};
      sum = plus(sum, times(splat(frame_.background), sky));
      active = met;
      if (!any(active)) return sum;

      const F t = load(hit.ray.tfar);
      path += t;
      Vector normal = unit({load(hit.hit.Ng_x), load(hit.hit.Ng_y), load(hit.hit.Ng_z)});
      const F facing = dot(normal, direction);
      normal = times(normal, facing > 0.0F ? splat(-1) : splat(1));
      const Vector point =
          plus(plus(origin, times(direction, t)), times(normal, path * leaving_offset));

      const Surface surface = surface_of(hit, active);
      const Vector seen = shade(point, normal, direction, surface, active, depth);
      const F counted = active ? weight : F{};
      sum = plus(sum, times(seen, counted));

      weight *= surface.reflectivity;
      active &= weight > 0.0F;
      if (depth == frame_.max_depth || !any(active)) return sum;
      direction = unit(plus(direction, times(normal, -2 * dot(direction, normal))));
      origin = point;
    }
  }

  /// Scenes mostly have one material in a packet: then nothing is gathered.
  Surface surface_of(const RayHit& hit, M active) const {
    int first = 0;
    while (!active[first]) ++first;
    const unsigned id = hit.hit.geomID[first];
    const M others = active & (load(hit.hit.geomID) != static_cast<int>(id));
    const EmbreeMaterial& material = frame_.materials[id];
    Surface surface{splat(material.color), splat(material.ka),        splat(material.kd),
                    splat(material.ks),    splat(material.shininess), splat(material.reflectivity)};
    if (!any(others)) return surface;
    for (int i = 0; i < width; ++i) {
      if (!others[i]) continue;
      const EmbreeMaterial& own = frame_.materials[hit.hit.geomID[i]];
      surface.color.x[i] = own.color[0];
      surface.color.y[i] = own.color[1];
      surface.color.z[i] = own.color[2];
      surface.ka[i] = own.ka;
      surface.kd[i] = own.kd;
      surface.ks[i] = own.ks;
      surface.shininess[i] = own.shininess;
      surface.reflectivity[i] = own.reflectivity;
    }
    return surface;
  }

  Vector shade(const Vector& point, const Vector& normal, const Vector& direction,
               const Surface& surface, M active, int depth) {
    const F ambient = surface.ka * frame_.ambient;
    const F everywhere = frame_.is_ambient_everywhere ? ambient : F{};
    const F where_lit = frame_.is_ambient_everywhere ? F{} : ambient;
    Vector sum{everywhere, everywhere, everywhere};
    for (int i = 0; i < frame_.light_count; ++i) {
      const EmbreeLight& light = frame_.lights[i];
      F share;
      F direct;
      if (light.kind == EmbreeLightKind::sky) {
        share = shadows_.share_of_sky(point, normal, active, depth);
        direct = share * surface.kd;
      } else {
        const auto arriving = shadows_.arriving_from(light, point);
        const F cosine = dot(normal, arriving.towards);
        const M visible = active & (cosine > 0.0F);
        if (!any(visible)) continue;
        share = shadows_.share_of(light, arriving, point, normal, visible, depth);
        const Vector half = unit(plus(arriving.towards, times(direction, splat(-1))));
        F aligned = dot(half, normal);
        aligned = aligned > 1e-20F ? aligned : splat(1e-20F);
        direct = share * arriving.weakened *
                 (surface.kd * cosine + surface.ks * power(aligned, surface.shininess));
      }
      const M lit = share > 0.0F;
      if (!any(lit)) continue;
      sum.x += lit ? where_lit + direct * light.intensity[0] : F{};
      sum.y += lit ? where_lit + direct * light.intensity[1] : F{};
      sum.z += lit ? where_lit + direct * light.intensity[2] : F{};
    }
    return {sum.x * surface.color.x, sum.y * surface.color.y, sum.z * surface.color.z};
  }

  const EmbreeFrame& frame_;
  RayCaster<width> rays_;
  Shadows<width> shadows_;
};

template <typename Channel>
void trace_tile(const EmbreeFrame& frame, EmbreeMode mode, int packet_width, int x_begin,
                int y_begin, int x_end, int y_end, Channel* rgb) {
  const FlushSubnormals flush;
  const int width =
      mode == EmbreeMode::narrow_packets && packet_width > 4 ? packet_width / 2 : packet_width;
  const auto seed = static_cast<unsigned>(y_begin * frame.width + x_begin);
  if (width == 16)
    TileTracer<16, Channel>(frame, mode, seed).trace(x_begin, y_begin, x_end, y_end, rgb);
  else if (width == 8)
    TileTracer<8, Channel>(frame, mode, seed).trace(x_begin, y_begin, x_end, y_end, rgb);
  else
    TileTracer<4, Channel>(frame, mode, seed).trace(x_begin, y_begin, x_end, y_end, rgb);
}

}  // namespace

int embree_packet_width(RTCDevice device) {
  if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED)) return 16;
  if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED)) return 8;
  return 4;
}

void trace_embree_tile(const EmbreeFrame& frame, EmbreeMode mode, int packet_width, int x_begin,
                       int y_begin, int x_end, int y_end, unsigned char* rgb) {
  trace_tile(frame, mode, packet_width, x_begin, y_begin, x_end, y_end, rgb);
}

void trace_embree_tile(const EmbreeFrame& frame, EmbreeMode mode, int packet_width, int x_begin,
                       int y_begin, int x_end, int y_end, float* rgb) {
  trace_tile(frame, mode, packet_width, x_begin, y_begin, x_end, y_end, rgb);
}

}  // namespace raytracer::peers
