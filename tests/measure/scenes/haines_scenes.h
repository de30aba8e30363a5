// Haines' standard procedural databases (E. Haines: "A Proposal for Standard Graphics
// Environments", IEEE CG&A 7(11), 1987), made by generators of our own.
//
// Balls, rings and tree are his to the printed digit; the mountain has his size, glass and view,
// but other chance; the goblet stands for his teapot, whose patches are data. Gears, tetra and
// shells are like those of his later collection in kind and number.
#pragma once

#include <string>

namespace raytracer::measure {

/// 7,381 mirror spheres above a floor: each carries nine of a third of its radius.
std::string haines_balls();

/// 8,192 triangles of a fractal mountain, four glass spheres above it.
std::string haines_mount();

/// 4,200 spheres and as many cylinders, five each to a ring; a floor; little mirrors.
std::string haines_rings();

/// 4,095 cones, each with a sphere at its end, under seven lights.
std::string haines_tree();

/// A surface of revolution of 4,512 smooth triangles on a board of 36 squares, all mirroring.
std::string haines_goblet();

/// 36 toothed wheels that mirror, 27,648 triangles, under five lights.
std::string haines_gears();

/// Sierpinski's tetrahedron in 4,096 triangles.
std::string haines_tetra();

/// 5,000 spheres that overlap along three windings of a spiral, all mirroring.
std::string haines_shells();

}  // namespace raytracer::measure
