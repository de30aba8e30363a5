// Every scene that a request may mean: shipped, posted to be kept, or sent as a body.
//
// A scene is read from its text once, without the query's values; a view of it shares what was
// read. Two bounded memories: the posted scenes by their ids, which clients count on, and scenes
// by the digests of their texts, which nobody sees: a long text that comes again is not read again.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "engine/engine.h"
#include "server/catalog.h"
#include "server/lru_cache.h"
#include "server/quota.h"

namespace raytracer {

/// A scene with all that is worth knowing of it more than once.
struct KnownScene {
  Scene scene;                 ///< as its document says it; only views are within all limits
  std::string content_digest;  ///< see etag.h
};

/// A posted scene, with what was posted: whoever asks for its document gets that.
struct KeptScene {
  std::shared_ptr<const KnownScene> known;
  std::string document;
  std::string id;         ///< 32 hexadecimal digits, the same for what differs in white space only
  std::size_t bytes = 0;  ///< the memory that it takes
};

/// A scene as one request wants to see it.
struct SceneView {
  std::shared_ptr<const KnownScene> known;
  Scene scene;
  double parse_ms = 0;         ///< to find or read the scene, and to judge the view
  Quota::Share body_memory{};  ///< of the body that came with the request
  std::shared_ptr<const std::string> document{};  ///< its text, where it may have to travel

  /// What decides the picture, if the same request would give the same bytes again. A time budget
  /// does not: how far it gets differs from run to run.
  std::optional<std::string> picture_digest() const;
};

/// Every member function may be called from any thread.
class Scenes {
 public:
  /// What was posted elsewhere under an id, if it was.
  using Elsewhere = std::function<std::optional<std::string>(const std::string& id)>;

  /// `most_kept` bytes of posted scenes and `most_read` bytes of scenes by their texts.
  Scenes(const Catalog& catalog, const Limits& limits, std::size_t most_kept, std::size_t most_read,
         Elsewhere elsewhere = {});

  /// A view of the document's scene. Throws HttpError with all errors of both.
  SceneView read(const DocumentText& document, const Overrides& overrides) {
    return read(document, overrides, limits_);
  }
  /// The same within limits that another server has admitted it by.
  SceneView read(const DocumentText& document, const Overrides& overrides, const Limits& limits);

  /// A view of the shipped scene of that name or the posted one with that id. Throws HttpError:
  /// 404, or with the view's errors.
  SceneView at(std::string_view name, const Overrides& overrides);

  /// Keeps it, so that at() finds it by its id. Throws HttpError 413 if it is too large for that.
  std::shared_ptr<const KeptScene> keep(std::shared_ptr<const KnownScene> known,
                                        std::string document);

  /// Its document, which is not read for that. Throws HttpError 404.
  std::shared_ptr<const std::string> document(std::string_view name);

  /// A view of a known scene. Throws HttpError with the view's errors.
  static SceneView view(std::shared_ptr<const KnownScene> known, const Overrides& overrides,
                        const Limits& limits);

  LruCounts kept() const { return kept_.counts(); }
  LruCounts read_lately() const { return read_.counts(); }

 private:
  std::shared_ptr<const KeptScene> kept_at(std::string_view id);
  static SceneView parse(const DocumentText& document, const Overrides& overrides,
                         const Limits& limits);

  const Catalog& catalog_;
  const Limits limits_;
  const Elsewhere elsewhere_;
  LruCache<KeptScene> kept_;
  LruCache<KnownScene> read_;
};

}  // namespace raytracer
