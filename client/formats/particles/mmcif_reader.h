// mmCIF (mmcif.wwpdb.org), read by gemmi: _atom_site and _struct_conn; and the CIF of small
// structures, whose sites are fractions of a cell: one cell of them is shown. Any column of
// _atom_site gives colours.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "client/formats/particles/atom_collector.h"
#include "client/formats/particles/cif_bonds.h"
#include "client/formats/particles/cif_contents.h"
#include "client/formats/particles/particle_reader.h"
#include "client/formats/text_source.h"

namespace raytracer::client {

class MmcifReader : public ParticleReader {
 public:
  MmcifReader(std::unique_ptr<TextSource> source, const ImportOptions& options);
  std::optional<Particles> next_frame() override;
  bool has_more() const override { return row_ < row_count_; }

 private:
  void find_columns();
  void find_color_words();
  void read_row(std::size_t row);
  std::string value(std::size_t row, int column) const;
  double number(std::size_t row, int column) const;
  Particles read_cell();

  AtomCollector atoms_;
  std::string text_;  ///< to find the line of what is wrong
  CifContents contents_;
  std::optional<CifBonds> bonds_;  ///< where they are drawn
  std::size_t row_ = 0;
  std::size_t row_count_ = 0;
  std::array<int, 3> place_{};
  int element_ = -1;
  int chain_ = -1;
  int residue_ = -1;
  int residue_number_ = -1;
  int insertion_ = -1;
  int atom_ = -1;
  int alternate_ = -1;
  int model_ = -1;
  int color_ = -1;
};

}  // namespace raytracer::client
