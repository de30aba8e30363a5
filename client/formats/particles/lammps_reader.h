// LAMMPS's text dumps (docs.lammps.org/dump.html): frames of "ITEM: ..." sections. Places are taken
// from x y z, xu yu zu, or xs ys zs and xsu ysu zsu, which count in box lengths, in that order.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "client/formats/lines.h"
#include "client/formats/particles/columns.h"
#include "client/formats/particles/particle_reader.h"

namespace raytracer::client {

class LammpsReader : public ParticleReader {
 public:
  LammpsReader(std::unique_ptr<TextSource> source, const ImportOptions& options);
  std::optional<Particles> next_frame() override;
  bool has_more() const override { return !lines_.at_end(); }

 private:
  /// Its edges, and the corner from which they go.
  struct Cell {
    model::Triple corner{};
    std::array<model::Triple, 3> edges{};
  };

  /// What stands before a frame's atoms.
  struct Head {
    std::size_t count = 0;
    std::optional<Cell> cell;
  };

  Head read_head();
  std::size_t read_count();
  Cell read_cell();
  void read_columns();
  std::string_view value_line();

  std::unique_ptr<TextSource> source_;
  Lines lines_;
  ImportOptions options_;
  std::vector<std::string> header_;  ///< as the file has it
  bool is_scaled_ = false;
  std::optional<Columns> columns_;
  std::vector<std::string_view> fields_;
};

}  // namespace raytracer::client
