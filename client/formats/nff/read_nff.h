// Haines' Neutral File Format, whole: E. Haines, "A Proposal for Standard Graphics Environments",
// IEEE Computer Graphics and Applications 7(11), 1987, and the NFF.TXT of his Standard Procedural
// Databases (SPD).
//
//   v  from X Y Z  at X Y Z  up X Y Z  angle DEGREES  [hither DISTANCE]  resolution W H
//   b  R G B                                background
//   l  X Y Z [R G B]                        light
//   f  R G B Kd Ks Shine T INDEX            fill of what follows
//   s  X Y Z RADIUS                         sphere
//   c  X Y Z RADIUS  X Y Z RADIUS           open cone, or cylinder if the radii are equal
//   p  N  then N times X Y Z                polygon
//   pp N  then N times X Y Z  NX NY NZ      polygonal patch
//
// Any white space separates words, and what comes first, fills excepted, is free. How it reads
// what the format leaves open is in README.md beside this file.
#pragma once

#include <string_view>

#include "client/formats/import_options.h"
#include "client/formats/reading.h"

namespace raytracer::client {

/// Names at most 20 errors. Without a viewpoint all is in view, as the options ask; without lights
/// it has a studio's. Throws InputError for an option against what the file says.
Reading read_nff(std::string_view text, const ImportOptions& options = {});

}  // namespace raytracer::client
