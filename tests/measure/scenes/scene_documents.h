// The bench's scenes as documents: made from fixed seeds, the same text on every machine.
//
// Two distant lights and shadows "black" where nothing else is said. A document asks for 700 x 500
// pixels and one sample; a case overrides that.
#pragma once

#include <string>

namespace raytracer::measure {

/// Two spheres of radius 2.
std::string two_spheres();

/// Two spheres above a square of 2n x 2n spheres, 28 wide whatever n, as one `sphere_square`.
std::string two_spheres_and_square(int n);

/// The same spheres in the same places, those of the square in a `spheres` object.
std::string two_spheres_and_explicit_square(int n);

/// `count` spheres in a cube seen from outside, radii within half of their mean, which is chosen
/// so that a line through the cube along an axis misses all of them in about a quarter of cases:
/// about half of the image is covered.
std::string random_spheres(int count);

/// The same in light from everywhere, shadows "ambient" as under all soft lights here.
std::string random_spheres_under_sky(int count);

/// The same under a sun 0.2 wide.
std::string random_spheres_under_wide_sun(int count);

/// The same under a lamp whose radius is a tenth of its distance.
std::string random_spheres_under_lamp(int count);

/// Haines' sphereflake: each sphere carries nine of a third of its radius (Haines: "A Proposal for
/// Standard Graphics Environments", IEEE CG&A 1987). `levels` = 4 is 7,381 spheres.
std::string sphereflake(int levels);

std::string sphereflake_under_sky(int levels);

/// A torus with bumps of `around` x `across` cells, two triangles each.
std::string bumpy_torus(int around, int across);

/// Five mirror spheres above a square of 28 x 28 and a slightly mirroring plane.
std::string reflections();

}  // namespace raytracer::measure
