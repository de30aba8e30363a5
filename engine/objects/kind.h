// What a kind of object has to tell the engine: each in its own folder beside this file, all of
// them listed once in objects.h. A kind that lacks one of the pieces below does not compile, once
// it is listed; nothing outside of its folder and the lists names a kind. They are documented here,
// not in each folder again.
//
// X.h: what it is.
//   struct XKind {
//     using Documents = Types<X, Xs>;    what a document may say: structures with `type`,
//                                        `description` and `fields` (fields/field_table.h)
//     using Primitive = PackedX;         one of them in frame coordinates, with a PrimitiveId `id`
//     noun                               what messages call it
//     search                             how it can be found (finders/finder.h)
//     few                                if bounded: up to how many are tried one by one
//     has_point_grid                     whether grids around point lights may hold it
//     tolerance_px                       what single precision may displace of its edges
//   };
//   item_count(x)                        how many primitives a document's structure is
//   for_each_extent(x, include)          include(point, reach): the space that it takes
//   pack(x, packing)                     its primitives, appended
//   bounds(p)                            a box around a primitive
//   footprint(projection, p)             if bounded: the pixels that it may cover
//   nearest_distance(p)                  if bounded: a lower bound of its distance from the eye
//   add_statistics(p, viewpoint, to)     what the plan has to know of it
//   add_mirror(p, mirrors)               how a mirroring one magnifies
//   placement_of(p)                      how far it is from a light
//   intersect(ray, p)                    the definition: where a ray meets it, in double
//
// packets.h: how it lies in memory, its PacketLayout (packets/layout.h).
//
// X-inl.h: packets of rays.
//   intersect_item(...)                  with one primitive, that all lanes try
//   occluded_by(...)                     which lanes it hides a light from
//   intersect_candidate(...), prefetch_candidate(...)    if bounded: with one of a screen bin
//   lanes_of(block, get), intersect(d, xs, TreeRays, active, t)    if bounded: with a tree's leaf
//   intersect_own<followed>(...)         if the kind finds its own parts, instead of these
//
// What a kind may have, and what is done without:
//   colors (of a document's structure)   an item's own colours                    the material's
//   name_of(), explain_neighbours()      how plans speak of it          its noun and the finder
//   is_grazed(p, light)                  whether light along it is a doubtful case        none is
//   for_each_subpixel_piece(...)         if it may be thinner than a pixel      it is not missed
//   screen_depth(), screen_outline()     tighter screen bins                       its footprint
//   may_intersect(...)                   tighter candidates of a pixel           all of the block
//   own_normals(...)                     if a row does not tell its normals          from the row
#pragma once

#include "engine/fields/types.h"  // IWYU pragma: export
