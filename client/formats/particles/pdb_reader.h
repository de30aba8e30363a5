// The Protein Data Bank's format of fixed columns, version 3.3
// (wwpdb.org/documentation/file-format): ATOM and HETATM, MODEL and ENDMDL, CONECT. Columns that
// give colours: bfactor, occupancy.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "client/formats/lines.h"
#include "client/formats/particles/atom_collector.h"
#include "client/formats/particles/particle_reader.h"

namespace raytracer::client {

class PdbReader : public ParticleReader {
 public:
  PdbReader(std::unique_ptr<TextSource> source, const ImportOptions& options);
  std::optional<Particles> next_frame() override;
  bool has_more() const override { return !lines_->at_end(); }

 private:
  using Bond = std::array<int, 2>;  ///< serial numbers

  void read_bonds();
  void read_atom();
  void add_bonds(Particles& particles) const;
  void find_next_model();

  std::unique_ptr<TextSource> source_;
  std::string text_;  ///< all of it, where bonds are drawn: they stand behind the atoms
  std::optional<Lines> lines_;
  AtomCollector atoms_;
  std::vector<Bond> bonds_;
  std::vector<Omission> omissions_;  ///< of the whole file, until they are told
  // Of this model, where bonds are drawn:
  std::unordered_map<int, std::uint32_t> by_serial_;
  std::vector<std::uint32_t> hetero_;  ///< atoms that are no standard residue's
};

}  // namespace raytracer::client
