#include "client/formats/text_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "client/failure.h"
#include "client/formats/ascii.h"
#include "client/formats/unpacking.h"

namespace raytracer::client {
namespace {

class StringSource : public TextSource {
 public:
  explicit StringSource(std::string_view text) : text_(text) {}

  std::size_t read(std::span<char> room) override {
    const std::size_t count = std::min(room.size(), text_.size());
    std::copy_n(text_.begin(), count, room.begin());
    text_.remove_prefix(count);
    return count;
  }

 private:
  std::string_view text_;
};

class FileSource : public TextSource {
 public:
  explicit FileSource(const std::string& path)
      : file_(std::fopen(path.c_str(), "rb"), &std::fclose) {
    if (!file_) throw InputError(fmt::format("cannot be opened: {}", std::strerror(errno)));
  }

  std::size_t read(std::span<char> room) override {
    const std::size_t count = std::fread(room.data(), 1, room.size(), file_.get());
    if (count == 0 && std::ferror(file_.get()) != 0)
      throw InputError(fmt::format("cannot be read: {}", std::strerror(errno)));
    return count;
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

/// Of another source, no more than `most` bytes.
class BoundedSource : public TextSource {
 public:
  BoundedSource(std::unique_ptr<TextSource> inner, std::size_t most)
      : inner_(std::move(inner)), left_(most) {}

  std::size_t read(std::span<char> room) override {
    const std::size_t count = inner_->read(room);
    if (count > left_)
      throw InputError(
          "unpacks to more than a hundred times its size; unpack it, if that is what it is to be");
    left_ -= count;
    return count;
  }

 private:
  std::unique_ptr<TextSource> inner_;
  std::size_t left_;
};

}  // namespace

std::unique_ptr<TextSource> source_of_text(std::string_view text) {
  return std::make_unique<StringSource>(text);
}

std::unique_ptr<TextSource> source_of_file(const std::string& path) {
  auto file = std::make_unique<FileSource>(path);
  const bool is_gzip = ends_in_any_case(path, ".gz");
  if (!is_gzip && !ends_in_any_case(path, ".zst")) return file;
  std::error_code unknown;
  const auto packed = std::filesystem::file_size(path, unknown);
  constexpr std::size_t free = 32 << 20;
  constexpr std::size_t most_times = 100;
  const std::size_t most = free + (unknown ? 0 : most_times * static_cast<std::size_t>(packed));
  auto unpacked = is_gzip ? gunzip(std::move(file)) : unzstd(std::move(file));
  return std::make_unique<BoundedSource>(std::move(unpacked), most);
}

std::string_view without_compression(std::string_view path) {
  for (const std::string_view ending : {".gz", ".zst"})
    if (ends_in_any_case(path, ending)) return path.substr(0, path.size() - ending.size());
  return path;
}

std::string read_all(TextSource& source) {
  std::string text;
  constexpr std::size_t room_size = 1 << 18;
  const std::unique_ptr<char[]> room(new char[room_size]);  // touched as far as used
  constexpr std::size_t most = 1 << 30;
  while (const std::size_t count = source.read({room.get(), room_size})) {
    text.append(room.get(), count);
    if (text.size() > most) throw InputError("is larger than a gigabyte; split it");
  }
  return text;
}

}  // namespace raytracer::client
