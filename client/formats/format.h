// The formats that the client reads besides scene documents: an ending and a reader each. To add
// one: its reader, and a row for each ending.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>

#include "client/formats/meshes/mesh_file.h"
#include "client/formats/nff/nff_file.h"
#include "client/formats/particles/open_particles.h"
#include "client/formats/scene_file.h"

namespace raytracer::client {

/// Which options a file of a format leaves open, each more than those before it.
enum class Openness {
  nothing,
  missing_view,  ///< from where it is seen, unless it says so
  picture,       ///< from where it is seen, and before what
  atoms          ///< how atoms are drawn, too
};

struct Format {
  std::string_view ending;
  std::unique_ptr<SceneFile> (*open)(FileInput input, const ImportOptions& options);
  Openness openness;
};

inline constexpr std::array formats{
    Format{".nff", open_nff, Openness::missing_view},
    Format{".pdb", open_pdb, Openness::atoms},
    Format{".ent", open_pdb, Openness::atoms},
    Format{".cif", open_mmcif, Openness::atoms},
    Format{".mmcif", open_mmcif, Openness::atoms},
    Format{".xyz", open_xyz, Openness::atoms},
    Format{".extxyz", open_xyz, Openness::atoms},
    Format{".dump", open_lammps_dump, Openness::atoms},
    Format{".lammpstrj", open_lammps_dump, Openness::atoms},
    Format{".csv", open_csv, Openness::atoms},
    Format{".tsv", open_tsv, Openness::atoms},
    Format{".ply", open_ply, Openness::picture},
    Format{".obj", open_obj, Openness::picture},
    Format{".stl", open_stl, Openness::picture},
    Format{".gltf", open_gltf, Openness::picture},
    Format{".glb", open_glb, Openness::picture},
};

/// By the ending of a path, small letters or capitals, and without .gz or .zst after it; or a
/// LAMMPS dump by the beginning "dump." of its name. Null if it is no format's.
const Format* format_of(std::string_view path);

/// ".nff, .pdb, ...", for people.
std::string all_endings();

}  // namespace raytracer::client
