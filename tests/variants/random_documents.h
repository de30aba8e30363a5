// Objects of documents, at random places about the origin.
#pragma once

#include <string>

namespace raytracer::test {

std::string random_spheres(int count, double radius, const std::string& material);

/// Every third one open; thick and thin, long and short, alone in their colours.
std::string random_cylinders(int count, const std::string& material);

/// The same of cones, whole and cut off, flat and slender, some of equal radii.
std::string random_cones(int count, const std::string& material);

/// A rough_sheet() that corners' normals shade and, of an even side, colour.
std::string smooth_sheet(int side, const std::string& material);

/// A rough sheet of 2 * side * side triangles, each corner shared, that hangs over itself.
std::string rough_sheet(int side, const std::string& material);

/// Triangles across each other and the whole image, some of them also behind the eye.
std::string random_triangles(int count, const std::string& material);

}  // namespace raytracer::test
