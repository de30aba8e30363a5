#include "client/formats/unpacking.h"

#include <zlib.h>
#include <zstd.h>

#include <limits>
#include <vector>

#include "client/failure.h"

namespace raytracer::client {
namespace {

constexpr const char* damaged = "cannot be unpacked: the compressed data is damaged";
constexpr const char* cut_off = "cannot be unpacked: the compressed data ends early";

/// What was read and not yet unpacked.
class PackedBytes {
 public:
  explicit PackedBytes(std::unique_ptr<TextSource> source) : source_(std::move(source)) {}

  /// Those that are left, or more; none at the end.
  std::span<char> some() {
    if (left_.empty()) left_ = std::span(room_).first(source_->read(room_));
    return left_;
  }
  void leave(std::size_t count) { left_ = left_.last(count); }

 private:
  std::unique_ptr<TextSource> source_;
  std::vector<char> room_ = std::vector<char>(1 << 16);
  std::span<char> left_;
};

/// A file may have several members, one after the other.
class GzipSource : public TextSource {
 public:
  explicit GzipSource(std::unique_ptr<TextSource> packed) : packed_(std::move(packed)) {
    constexpr int gzip_only = 16;
    if (inflateInit2(&stream_, MAX_WBITS + gzip_only) != Z_OK) throw InputError(damaged);
  }
  ~GzipSource() override { inflateEnd(&stream_); }

  std::size_t read(std::span<char> room) override {
    room = room.first(std::min<std::size_t>(room.size(), std::numeric_limits<uInt>::max()));
    stream_.next_out = reinterpret_cast<Bytef*>(room.data());
    stream_.avail_out = static_cast<uInt>(room.size());
    while (stream_.avail_out == room.size()) {
      const std::span<char> some = packed_.some();
      if (some.empty()) {
        if (inside_) throw InputError(cut_off);
        return 0;
      }
      if (!inside_ && some[0] == '\0') {  // tapes and blocks are filled up, and gzip takes it
        packed_.leave(some.size() - 1);
        continue;
      }
      stream_.next_in = reinterpret_cast<Bytef*>(some.data());
      stream_.avail_in = static_cast<uInt>(some.size());
      const int result = inflate(&stream_, Z_NO_FLUSH);
      packed_.leave(stream_.avail_in);
      if (result != Z_OK && result != Z_STREAM_END) throw InputError(damaged);
      inside_ = result != Z_STREAM_END;
      if (!inside_) inflateReset(&stream_);
    }
    return room.size() - stream_.avail_out;
  }

 private:
  PackedBytes packed_;
  z_stream stream_{};
  bool inside_ = true;  ///< of a member, or before the first
};

class ZstdSource : public TextSource {
 public:
  explicit ZstdSource(std::unique_ptr<TextSource> packed) : packed_(std::move(packed)) {
    // What the program zstd takes without --long: a header cannot ask for gigabytes.
    constexpr int largest_window_log = 27;
    ZSTD_DCtx_setParameter(stream_.get(), ZSTD_d_windowLogMax, largest_window_log);
  }

  std::size_t read(std::span<char> room) override {
    ZSTD_outBuffer out{room.data(), room.size(), 0};
    while (out.pos == 0) {
      const std::span<char> some = packed_.some();
      if (some.empty() && !inside_) return 0;
      ZSTD_inBuffer in{some.data(), some.size(), 0};
      const std::size_t result = ZSTD_decompressStream(stream_.get(), &out, &in);
      if (ZSTD_isError(result) != 0) throw InputError(damaged);
      packed_.leave(in.size - in.pos);
      inside_ = result != 0;
      if (some.empty() && out.pos == 0 && inside_) throw InputError(cut_off);
    }
    return out.pos;
  }

 private:
  PackedBytes packed_;
  std::unique_ptr<ZSTD_DStream, std::size_t (*)(ZSTD_DStream*)> stream_{ZSTD_createDStream(),
                                                                        &ZSTD_freeDStream};
  bool inside_ = true;  ///< of a frame, or before the first
};

}  // namespace

std::unique_ptr<TextSource> gunzip(std::unique_ptr<TextSource> packed) {
  return std::make_unique<GzipSource>(std::move(packed));
}

std::unique_ptr<TextSource> unzstd(std::unique_ptr<TextSource> packed) {
  return std::make_unique<ZstdSource>(std::move(packed));
}

}  // namespace raytracer::client
