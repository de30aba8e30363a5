// What a kind of object tells the engine, a concept for each of the pieces: a kind that is listed
// in objects.h and lacks one does not compile, and the compiler names the piece. Each is in its own
// folder beside this file; nothing outside of the folder and the lists names a kind. The pieces are
// documented here, not in each folder again.
//
//   X.h        what it is: the concepts below
//   packets.h  how it lies in memory: its PacketLayout (packet_kind.h)
//   X-inl.h    packets of rays: the concepts in kind-inl.h
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "engine/fields/field_table.h"           // IWYU pragma: export
#include "engine/fields/types.h"                 // IWYU pragma: export
#include "engine/finders/finder.h"               // IWYU pragma: export
#include "engine/lights/light_kind.h"            // IWYU pragma: export
#include "engine/math/box.h"                     // IWYU pragma: export
#include "engine/math/projection.h"              // IWYU pragma: export
#include "engine/math/ray.h"                     // IWYU pragma: export
#include "engine/objects/geometry_statistics.h"  // IWYU pragma: export
#include "engine/objects/packing.h"              // IWYU pragma: export

namespace raytracer {

/// Of a structure that a document may say: how many primitives one is.
template <class Document>
concept HasItemCount = requires(const Document& x) {
  { item_count(x) } -> std::same_as<std::size_t>;
};

/// The space that it takes: calls include(point, reach).
template <class Document>
concept HasExtents = requires(const Document& x, void include(const Vec3&, double)) {
  for_each_extent(x, include);
};

/// Appends its primitives, in frame coordinates.
template <class Document, class Primitive>
concept HasPack = requires(const Document& x, Packing<Primitive>& packing) {
  pack(x, packing);
};

template <class Document, class Primitive>
concept ObjectDocument = DocumentedType<Document> && HasItemCount<Document> &&
    HasExtents<Document> && HasPack<Document, Primitive>;

/// What one of them is in frame coordinates.
template <class Kind>
concept HasPrimitive = requires(const typename Kind::Primitive& p) {
  { p.id } -> std::convertible_to<PrimitiveId>;
};

template <class Kind>
concept HasTraits = requires {
  Kind::Documents::count;                                   // Types<X, Xs>: what a document may say
  { Kind::noun } -> std::convertible_to<std::string_view>;  // what messages call it
  { Kind::search } -> std::convertible_to<Search>;          // how it can be found
  // Whether hard shadows are off by what rounds the points that they fall on, and by no more
  // however far away what casts them is.
  { Kind::has_exact_shadows } -> std::convertible_to<bool>;
  // Whether it can pass over the points of a sweep.
  { Kind::has_light_sweep } -> std::convertible_to<bool>;
  { Kind::tolerance_px } -> std::convertible_to<double>;  // what single may displace of its edges
};

/// A box around a primitive.
template <class Kind>
concept HasBounds = requires(const typename Kind::Primitive& p) {
  { bounds(p) } -> std::same_as<Box>;
};

/// The definition: where a ray meets it first at t > 0, plain and in double.
template <class Kind>
concept HasReference = requires(const Ray& ray, const typename Kind::Primitive& p) {
  { intersect(ray, p) } -> std::same_as<std::optional<SurfaceHit>>;
};

/// What plans have to know: how near, far and large it is; how a mirroring one magnifies; where it
/// is among others of the kind, if that can be said.
template <class Kind>
concept HasStatistics = requires(const typename Kind::Primitive& p, const Viewpoint& from,
                                 GeometryStatistics& to, CurvedMirrors& mirrors) {
  add_statistics(p, from, to);
  add_mirror(p, mirrors);
  { placement_of(p) } -> std::same_as<std::optional<Placement>>;
};

/// Of a kind that is bounded: up to how many are tried one by one, the pixels that one may cover, a
/// lower bound of its distance from the eye, and the same primitive relative to a place that is not
/// the eye's: as a light there sees it. For how many pixels of the image for each primitive it is
/// worth it to build cells around a point light.
template <class Kind>
concept HasBoundedSearch = requires(const typename Kind::Primitive& p,
                                    const Projection& projection) {
  { Kind::few } -> std::convertible_to<FewPrimitives>;
  { Kind::pixels_for_cells } -> std::convertible_to<double>;
  { footprint(projection, p) } -> std::same_as<PixelRectangle>;
  { nearest_distance(p) } -> std::same_as<double>;
  { seen_from(p, Vec3{}) } -> std::same_as<typename Kind::Primitive>;
};

/// Of a kind that finds its own parts: the pixels that it may cover; the longest way between one of
/// its parts and what receives its shadow under a light from `towards`, `all` being the box around
/// everything; and the sine of that light's elevation over it.
template <class Kind>
concept HasOwnSearch = requires(const typename Kind::Primitive& p, const Projection& projection,
                                const Vec3& towards, const Box& all) {
  { footprint(projection, p) } -> std::same_as<PixelRectangle>;
  { shadow_path(p, towards, all) } -> std::same_as<double>;
  { elevation_sine(p, towards) } -> std::same_as<double>;
};

template <class Kind>
concept HasItsSearch = Kind::search == Search::unbounded ||
                       (Kind::search == Search::bounded && HasBoundedSearch<Kind>) ||
                       (Kind::search == Search::own && HasOwnSearch<Kind>);

template <class Kind>
concept ObjectKind = HasTraits<Kind> && HasPrimitive<Kind> && HasBounds<Kind> &&
    HasReference<Kind> && HasStatistics<Kind> && HasItsSearch<Kind>;

// What a kind may have. Screen bins take more: HasScreenDepth, HasScreenOutline
// (finders/screen_bins.h), and so do lights' lists.

/// A document's structure: an item's own colours; else the material's.
template <class Document>
concept HasItemColors = requires(const Document& x) {
  x.colors;
};

/// How plans speak of so many; else its noun.
template <class Kind>
concept HasNameInPlans = requires(std::size_t count, const GeometryStatistics& statistics) {
  { name_of(Kind(), count, statistics) } -> std::same_as<std::string>;
};

/// How rays from its own parts to distant lights find what is in their way, the lowest of the
/// lights with this sine of its elevation; else as all others do.
template <class Kind>
concept HasNeighbourSearch = requires(double lowest_light) {
  explain_neighbours(Kind(), lowest_light);
};

/// How near to the origin the edge of its shadow may fall, under a light or one direction of a soft
/// one; of others anywhere.
template <class Kind>
concept HasShadowEdges = requires(const typename Kind::Primitive& p, const PackedLight& light) {
  { shadow_edge_distance(p, light) } -> std::same_as<double>;
};

/// Whether light along it is a doubtful case; else none is.
template <class Kind>
concept HasGrazingLight = requires(const typename Kind::Primitive& p, const PackedLight& light) {
  { is_grazed(p, light) } -> std::same_as<bool>;
};

/// Of what may be seen thinner than a pixel: calls visit(rectangle, share) with what of the image
/// a piece may cover, and the share that it does; else it is taken for what no sample misses.
template <class Kind>
concept HasSubpixelPieces = requires(const typename Kind::Primitive& p,
                                     const Projection& projection,
                                     void visit(const PixelRectangle&, double)) {
  for_each_subpixel_piece(p, projection, visit);
};

}  // namespace raytracer
