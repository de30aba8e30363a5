// The formats of particles: for each the file that `format.h` names.
#pragma once

#include <memory>

#include "client/formats/scene_file.h"

namespace raytracer::client {

/// Atoms in the Protein Data Bank's columns.
std::unique_ptr<SceneFile> open_pdb(FileInput input, const ImportOptions& options);
/// Atoms of an mmCIF, or the cell of a crystal's CIF.
std::unique_ptr<SceneFile> open_mmcif(FileInput input, const ImportOptions& options);
/// Atoms line by line, perhaps with extended XYZ's further columns.
std::unique_ptr<SceneFile> open_xyz(FileInput input, const ImportOptions& options);
/// Particles as LAMMPS dumps them.
std::unique_ptr<SceneFile> open_lammps_dump(FileInput input, const ImportOptions& options);
/// Points of a table with commas, or with semicolons.
std::unique_ptr<SceneFile> open_csv(FileInput input, const ImportOptions& options);
/// Points of a table with tabs.
std::unique_ptr<SceneFile> open_tsv(FileInput input, const ImportOptions& options);

}  // namespace raytracer::client
