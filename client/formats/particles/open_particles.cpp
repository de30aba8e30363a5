#include "client/formats/particles/open_particles.h"

#include <fmt/format.h>

#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "client/formats/arrange.h"
#include "client/formats/particles/draw_particles.h"
#include "client/formats/particles/lammps_reader.h"
#include "client/formats/particles/mmcif_reader.h"
#include "client/formats/particles/pdb_reader.h"
#include "client/formats/particles/table_reader.h"
#include "client/formats/particles/xyz_reader.h"

namespace raytracer::client {
namespace {

/// Whose sizes, colours or bonds are made up.
void tell_of_unknown_elements(const Particles& particles, AtomStyle style, Reading& reading) {
  const bool has_colors =
      !particles.values.empty() || !particles.groups.empty() || !particles.colors.empty();
  if (has_colors && !particles.radii.empty() && style == AtomStyle::spacefill) return;
  for (const std::uint8_t element : particles.elements)
    if (element == 0)
      reading.omit(0, "atom is of no known element", "atoms are of no known element");
}

/// Frame for frame, seen from where the first one is seen best.
class ParticleScenes : public SceneFile {
 public:
  using MakeReader = std::function<std::unique_ptr<ParticleReader>()>;

  /// The reader is made when the first frame is asked for: it may find errors already.
  ParticleScenes(MakeReader make_reader, Upright upright, ImportOptions options)
      : make_reader_(std::move(make_reader)), upright_(upright), options_(std::move(options)) {}

  std::optional<Reading> next_frame() override {
    if (!has_more()) return std::nullopt;
    Reading reading;
    try {
      if (!reader_) reader_ = make_reader_();
      std::optional<Particles> particles = reader_->next_frame();
      if (!particles && view_) return std::nullopt;
      if (!particles) throw LineError{1, "the file has no atoms: its frames are empty"};
      reading.omissions = std::move(particles->omissions);
      tell_of_unknown_elements(*particles, options_.style, reading);
      draw_particles(*std::move(particles), options_, scale_, reading.scene);
      if (!view_) view_ = view_of_all(reading.scene, options_, upright_);
      arrange(reading.scene, options_, *view_);
      tell_of_first_frame(reading);
      tell_once(reading.omissions);
    } catch (const LineError& error) {
      reading.errors.push_back(error);
      is_broken_ = true;
    }
    return reading;
  }

  bool has_more() const override { return !is_broken_ && (!reader_ || reader_->has_more()); }

 private:
  /// What does not suit a later frame.
  void tell_of_first_frame(Reading& reading) const {
    if (options_.zoom <= 1 && !is_all_in_view(reading.scene))
      reading.omit(0,
                   fmt::format("frame leaves the first one's picture, as others may; --zoom {:.3g} "
                               "shows twice as much",
                               options_.zoom / 2),
                   "");
    if (scale_.is_exceeded)
      reading.omit(0, "frame has numbers beyond the first one's range of colours, as others may",
                   "");
  }

  /// Each kind with the first frame that has it: thousands may have the same.
  void tell_once(std::vector<Omission>& omissions) {
    std::erase_if(omissions, [&](const Omission& kind) { return !told_.insert(kind.one).second; });
  }

  MakeReader make_reader_;
  Upright upright_;
  ImportOptions options_;
  std::unique_ptr<ParticleReader> reader_;
  DrawingScale scale_;
  std::optional<model::View> view_;
  std::set<std::string> told_;
  bool is_broken_ = false;
};

template <typename Reader, typename... Arguments>
std::unique_ptr<SceneFile> open_with(Upright upright, FileInput input, const ImportOptions& options,
                                     Arguments... arguments) {
  const auto shared = std::make_shared<FileInput>(std::move(input));
  return std::make_unique<ParticleScenes>(
      [=]() -> std::unique_ptr<ParticleReader> {
        return std::make_unique<Reader>(std::move(shared->source), arguments..., options);
      },
      upright, options);
}

}  // namespace

std::unique_ptr<SceneFile> open_pdb(FileInput input, const ImportOptions& options) {
  return open_with<PdbReader>(Upright::none, std::move(input), options);
}

std::unique_ptr<SceneFile> open_mmcif(FileInput input, const ImportOptions& options) {
  return open_with<MmcifReader>(Upright::none, std::move(input), options);
}

std::unique_ptr<SceneFile> open_xyz(FileInput input, const ImportOptions& options) {
  return open_with<XyzReader>(Upright::none, std::move(input), options);
}

std::unique_ptr<SceneFile> open_lammps_dump(FileInput input, const ImportOptions& options) {
  return open_with<LammpsReader>(Upright::z, std::move(input), options);
}

std::unique_ptr<SceneFile> open_csv(FileInput input, const ImportOptions& options) {
  return open_with<TableReader>(Upright::none, std::move(input), options, ',');
}

std::unique_ptr<SceneFile> open_tsv(FileInput input, const ImportOptions& options) {
  return open_with<TableReader>(Upright::none, std::move(input), options, '\t');
}

}  // namespace raytracer::client
