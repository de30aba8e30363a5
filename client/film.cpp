#include "client/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <system_error>
#include <utility>
#include <vector>

#include "client/failure.h"
#include "client/formats/text_source.h"
#include "client/image_format.h"
#include "client/output_file.h"
#include "client/y4m.h"

namespace raytracer::client {
namespace {

constexpr const char* forms = "write FRAMES-%04d.png, MOTION.apng, or - for raw video";

/// Frames by their numbers, of which each name has one between two other parts.
class NumberedFiles : public Film {
 public:
  NumberedFiles(std::string before, int digits, std::string after, bool resumes)
      : before_(std::move(before)), digits_(digits), after_(std::move(after)), resumes_(resumes) {
    const ImageFormat* const format = image_format_of(file(0).ending());
    if (!format)
      throw InputError(
          fmt::format("--output: the frames are to end in .png, .ppm or .pfm: {}", forms));
    media_type_ = format->media_type;
  }

  /// Throws InputError.
  void check_writable() const { file(0).check_writable(); }

  std::string media_type() const override { return media_type_; }

  bool has(int frame) override {
    // We write them whole; a full disk, or a copy that was broken off, may have cut one.
    const bool is_there =
        resumes_ && std::filesystem::is_regular_file(path(frame)) && is_whole_image(read(frame));
    if (is_there) kept_ = file(frame);
    return is_there;
  }

  void add(int frame, const std::string& image) override {
    if (kept_) check_size(*kept_, image);
    file(frame).write(image);
    ++count_;
  }

  std::string finish(bool) override {
    return fmt::format("{}: {} {} written", before_ + "..." + after_, count_,
                       count_ == 1 ? "frame" : "frames");
  }

  /// Throws InputError.
  std::string read(int frame) const { return read_all(*source_of_file(path(frame).string())); }

  std::filesystem::path path(int frame) const { return file(frame).path; }

 private:
  static void check_size(const OutputFile& kept, const std::string& image) {
    const ImageSize here = image_size(image).value_or(ImageSize{});
    std::ifstream stream(kept.path, std::ios::binary);
    std::string head(64, '\0');
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    const ImageSize there = image_size(head).value_or(here);
    if (there != here)
      throw InputError(fmt::format(
          "--resume: {} has {} x {} pixels, and the missing frames have {} x {}: remove it, or "
          "leave --resume out",
          kept.path.string(), there.width_px, there.height_px, here.width_px, here.height_px));
  }

  OutputFile file(int frame) const {
    return {fmt::format("{}{:0{}}{}", before_, frame, digits_, after_)};
  }

  std::string before_;
  int digits_;
  std::string after_;
  bool resumes_;
  std::string media_type_;
  std::optional<OutputFile> kept_;  ///< the last frame that was there
  int count_ = 0;
};

/// Its frames lie in a folder beside it until all are there, so that what is broken off can go on.
class AnimatedPng : public Film {
 public:
  AnimatedPng(const std::string& path, const FilmTarget& target)
      : file_{path},
        folder_(path + ".frames"),
        rate_(target.rate),
        resumes_(target.resumes),
        frames_((folder_ / "").string(), 1, ".png", target.resumes) {
    file_.check_writable();
    if (std::filesystem::exists(folder_)) frames_.check_writable();
  }

  std::string media_type() const override { return frames_.media_type(); }

  bool has(int frame) override {
    const bool is_there = frames_.has(frame);
    if (is_there) count_ = std::max(count_, frame + 1);
    return is_there;
  }

  void add(int frame, const std::string& image) override {
    if (!std::exchange(has_folder_, true)) make_folder();
    frames_.add(frame, image);
    count_ = std::max(count_, frame + 1);
  }

  std::string finish(bool is_whole) override {
    std::vector<std::string> images;
    images.reserve(static_cast<std::size_t>(count_));
    for (int frame = 0; frame < count_; ++frame) images.push_back(frames_.read(frame));
    file_.write(joined(images));
    if (is_whole) remove_folder();
    return fmt::format("{}: {} {}", file_.path.string(), count_, count_ == 1 ? "frame" : "frames");
  }

 private:
  void make_folder() const {
    std::error_code error;  // the file in it would fail, and say why
    std::filesystem::create_directory(folder_, error);
    if (resumes_) return;
    // An earlier film's, which a later run would go on with.
    for (const auto& entry : std::filesystem::directory_iterator(folder_, error))
      if (entry.path().extension() == ".png") std::filesystem::remove(entry.path(), error);
  }

  void remove_folder() const {
    std::error_code error;  // what else lies there stays; the film is written
    for (int frame = 0; frame < count_; ++frame)
      std::filesystem::remove(frames_.path(frame), error);
    std::filesystem::remove(folder_, error);
  }

  std::string joined(const std::vector<std::string>& images) const {
    try {
      return animated_png(images, rate_);
    } catch (const ServerError& error) {
      if (!resumes_) throw;
      throw InputError(fmt::format("--resume: {} in {}: remove the folder, or leave --resume out",
                                   error.what(), folder_.string()));
    }
  }

  OutputFile file_;
  std::filesystem::path folder_;
  FrameRate rate_;
  bool resumes_;
  NumberedFiles frames_;
  bool has_folder_ = false;
  int count_ = 0;
};

class Y4mStream : public Film {
 public:
  explicit Y4mStream(FrameRate rate) : rate_(rate) {}

  std::string media_type() const override { return std::string(ppm_format.media_type); }

  void add(int, const std::string& image) override {
    const ImageSize size = image_size(image).value_or(ImageSize{});
    if (count_++ == 0) {
      size_ = size;
      write_to_standard_output(y4m_header(size, rate_));
    } else if (size != size_) {
      throw ServerError("the frames differ in size");
    }
    write_to_standard_output(y4m_frame(image));
  }

  std::string finish(bool) override {
    return fmt::format("standard output: {} {}", count_, count_ == 1 ? "frame" : "frames");
  }

 private:
  FrameRate rate_;
  ImageSize size_;
  int count_ = 0;
};

}  // namespace

std::unique_ptr<Film> open_film(const FilmTarget& target) {
  const std::string output = !target.output.empty() ? target.output
                             : target.is_y4m        ? "-"
                                                    : FilmTarget::numbered_files;
  if (target.is_y4m && output != "-")
    throw InputError(fmt::format("--format y4m is for a pipe: -o -, not -o {}", output));
  static const std::regex numbered("([^%]*)%(?:0([1-9]))?d([^%]*)");
  std::smatch pattern;
  const bool is_numbered = std::regex_match(output, pattern, numbered);
  if (target.resumes && output == "-")
    throw InputError("--resume goes with files, which stay: -o FRAMES-%04d.png or -o MOTION.apng");
  if (output == "-") return std::make_unique<Y4mStream>(target.rate);
  if (is_numbered) {
    const int digits = pattern.length(2) > 0 ? std::stoi(pattern[2]) : 1;
    auto files = std::make_unique<NumberedFiles>(pattern[1], digits, pattern[3], target.resumes);
    files->check_writable();
    return files;
  }
  if (OutputFile{output}.ending() == ".apng") return std::make_unique<AnimatedPng>(output, target);
  throw InputError(fmt::format("--output: '{}' names no frames: {}", output, forms));
}

}  // namespace raytracer::client
