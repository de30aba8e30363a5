// The Embree peer's inner loop: packets of rays through rtcIntersect and vectorised shading.
//
// Its source is compiled for this machine's instruction set and with relaxed arithmetic, so it
// must share no inline function with the rest of the program: the linker keeps one copy of each,
// and the engine would be measured with a peer's flags. Hence plain arrays here and no engine
// headers.
#pragma once

#include <embree3/rtcore.h>

namespace raytracer::peers {

/// How rays are handed to Embree: in packets of the widest kind that it traverses natively, with or
/// without the promise that they are coherent, in packets half as wide, or one by one.
enum class EmbreeMode { coherent_packets, incoherent_packets, narrow_packets, single_rays };

/// A scene's materials, without names.
struct EmbreeMaterial {
  float color[3];
  float ka;
  float kd;
  float ks;
  float shininess;
  float reflectivity;
};

enum class EmbreeLightKind { distant, point, sky };

/// A disc where its size is above 0.
struct EmbreeLight {
  EmbreeLightKind kind;
  bool fades;
  float place[3];      ///< the unit vector towards a distant light; where a point light is
  float intensity[3];  ///< times colour; of a point light that fades over 4 pi, at distance 1
  float size;          ///< radius; the tangent of half the angle
};

/// Of soft lights. Where `random_side` is above 0 the others do not count.
struct EmbreePlaces {
  const float* disc_x;  ///< in the unit disc
  const float* disc_y;
  int disc_count;
  const float* sphere_x;  ///< of unit vectors
  const float* sphere_y;
  const float* sphere_z;
  int sphere_count;
  int random_side;  ///< a random one in each of random_side^2 strata
};

/// normal . x = offset; intersected outside Embree, which has no unbounded primitives.
struct EmbreePlane {
  float normal[3];  ///< unit
  float offset;
};

/// Coordinates are relative to the eye. The arrays belong to the caller.
struct EmbreeFrame {
  RTCScene scene;
  float forward[3];  ///< of the direction forward + right (2x/width - 1) + up (2y/height - 1)
  float right[3];
  float up[3];
  int width;
  int height;
  const float* sample_x;  ///< in the pixel, from its left
  const float* sample_y;  ///< in the pixel, from its lower side
  int sample_count;
  float background[3];
  float ambient;
  bool is_ambient_everywhere;  ///< else only where a light is visible, for each that is
  bool has_shadows;
  int max_depth;
  const EmbreeLight* lights;
  int light_count;
  EmbreePlaces places;
  const EmbreeMaterial* materials;  ///< of each Embree geometry by its id, then of each plane
  int geometry_count;
  const EmbreePlane* planes;
  int plane_count;
};

/// Rays in a packet of the widest kind that `device` traverses natively: 8 or 16, or 4 without AVX.
int embree_packet_width(RTCDevice device);

/// Draws pixels [x_begin, x_end) x [y_begin, y_end), row 0 on top, into `rgb`, which has three
/// channels for each pixel of the whole image: rounded to 8 bits, or as they are, from 0 to 1.
/// `packet_width` is the widest; shading works on as many rays at once as there are in a packet,
/// on the widest for single rays.
void trace_embree_tile(const EmbreeFrame& frame, EmbreeMode mode, int packet_width, int x_begin,
                       int y_begin, int x_end, int y_end, unsigned char* rgb);
void trace_embree_tile(const EmbreeFrame& frame, EmbreeMode mode, int packet_width, int x_begin,
                       int y_begin, int x_end, int y_end, float* rgb);

}  // namespace raytracer::peers
