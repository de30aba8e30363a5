// The formats of particles: for each the file that `format.h` names.
#pragma once

#include <memory>

#include "client/formats/scene_file.h"

namespace raytracer::client {

std::unique_ptr<SceneFile> open_pdb(FileInput input, const Wishes& wishes);
std::unique_ptr<SceneFile> open_mmcif(FileInput input, const Wishes& wishes);
std::unique_ptr<SceneFile> open_xyz(FileInput input, const Wishes& wishes);
std::unique_ptr<SceneFile> open_lammps_dump(FileInput input, const Wishes& wishes);
std::unique_ptr<SceneFile> open_csv(FileInput input, const Wishes& wishes);
std::unique_ptr<SceneFile> open_tsv(FileInput input, const Wishes& wishes);

}  // namespace raytracer::client
