#include "engine/image/image.h"

namespace raytracer {

template <typename Channel>
Raster<Channel>::~Raster() = default;

template struct Raster<float>;
template struct Raster<unsigned char>;

}  // namespace raytracer
