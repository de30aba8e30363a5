#include "client/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <vector>

#include "client/failure.h"
#include "client/image_format.h"
#include "client/output_file.h"
#include "client/y4m.h"

namespace raytracer::client {
namespace {

constexpr const char* forms = "write FRAMES-%04d.png, MOTION.apng, or - for raw video";

/// "FRAMES-%04d.png", of which %d or %04d is the frame's number.
class NumberedFiles : public Film {
 public:
  NumberedFiles(const std::smatch& pattern, bool resumes)
      : before_(pattern[1]),
        digits_(pattern.length(2) > 0 ? std::stoi(pattern[2]) : 1),
        after_(pattern[3]),
        resumes_(resumes) {
    const std::string ending = file(0).ending();
    const auto* const format =
        std::find_if(image_formats.begin(), image_formats.end(),
                     [&](const ImageFormat& each) { return each.ending == ending; });
    if (format == image_formats.end())
      throw InputError(
          fmt::format("--output: the frames are to end in .png, .ppm or .pfm: {}", forms));
    media_type_ = format->media_type;
    file(0).check_writable();
  }

  std::string media_type() const override { return media_type_; }

  bool has(int frame) override {
    // They appear whole.
    const bool is_there = resumes_ && std::filesystem::exists(file(frame).path);
    if (is_there) kept_ = file(frame);
    return is_there;
  }

  void add(int frame, const std::string& image) override {
    if (kept_) check_size(*kept_, image);
    file(frame).write(image);
    ++count_;
  }

  std::string finish() override {
    return fmt::format("{}: {} {} written", before_ + "..." + after_, count_,
                       count_ == 1 ? "frame" : "frames");
  }

 private:
  static void check_size(const OutputFile& kept, const std::string& image) {
    const ImageSize here = image_size(image).value_or(ImageSize{});
    std::ifstream stream(kept.path, std::ios::binary);
    std::string head(64, '\0');
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    const ImageSize there = image_size(head).value_or(here);
    if (there.width_px != here.width_px || there.height_px != here.height_px)
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

class AnimatedPng : public Film {
 public:
  AnimatedPng(const std::string& path, FrameRate rate) : file_{path}, rate_(rate) {
    file_.check_writable();
  }

  std::string media_type() const override { return std::string(png_format.media_type); }
  void add(int, const std::string& image) override { frames_.push_back(image); }

  std::string finish() override {
    file_.write(animated_png(frames_, rate_));
    return fmt::format("{}: {} {}", file_.path.string(), frames_.size(),
                       frames_.size() == 1 ? "frame" : "frames");
  }

 private:
  OutputFile file_;
  FrameRate rate_;
  std::vector<std::string> frames_;  ///< compressed
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
    } else if (size.width_px != size_.width_px || size.height_px != size_.height_px) {
      throw ServerError("the frames differ in size");
    }
    write_to_standard_output(y4m_frame(image));
  }

  std::string finish() override {
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
  if (target.resumes && !is_numbered)
    throw InputError("--resume goes with numbered frames: -o FRAMES-%04d.png");
  if (output == "-") return std::make_unique<Y4mStream>(target.rate);
  if (is_numbered) return std::make_unique<NumberedFiles>(pattern, target.resumes);
  if (OutputFile{output}.ending() == ".apng")
    return std::make_unique<AnimatedPng>(output, target.rate);
  throw InputError(fmt::format("--output: '{}' names no frames: {}", output, forms));
}

}  // namespace raytracer::client
