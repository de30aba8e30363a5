// PDB and mmCIF: which atoms are shown, and as what.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/formats/particles_in_pictures.h"

namespace raytracer::test {
namespace {

using nlohmann::json;

TEST(Pdb, elements_come_from_their_column_or_the_name) {
  const json scene = document(".pdb", pdb_atom(1, " CA ", "GLY", 'A', 1, 0, "C") +
                                          pdb_atom(2, "CA  ", " CA", 'A', 2, 5, "") +
                                          pdb_atom(3, " CB ", "ALA", 'A', 3, 9, "") +
                                          pdb_atom(4, "HG11", "VAL", 'A', 4, 12, ""));
  std::vector<std::string> materials;
  for (const json& object : scene.at("objects")) materials.push_back(object.at("material"));
  EXPECT_EQ(materials, (std::vector<std::string>{"C", "Ca", "H"}));
  EXPECT_EQ(scene.at("objects")[0].at("centers").size(), 2U);
}

/// Files from before 1996 have their own name and the line's number there.
TEST(Pdb, number_of_a_line_is_no_element) {
  std::string line = pdb_atom(1, " CA ", "GLY", 'A', 1, 0, "");
  line.replace(72, 8, "1ABC  45");
  EXPECT_EQ(document(".pdb", line).at("objects")[0].at("material"), "C");
}

/// Whether the atoms are of these elements, each of another.
void expect_elements(const std::string& atoms, const std::vector<std::string>& elements) {
  const json materials = document(".pdb", atoms).at("materials");
  EXPECT_EQ(materials.size(), elements.size());
  for (const std::string& element : elements) EXPECT_TRUE(materials.contains(element)) << element;
}

TEST(Pdb, ions_have_charmm_s_names_where_no_column_says_their_element) {
  expect_elements(
      pdb_atom(1, " SOD", "SOD", 'A', 1, 0, "") + pdb_atom(2, " POT", "POT", 'A', 2, 5, "") +
          pdb_atom(3, "CLA ", "CLA", 'A', 3, 9, "") + pdb_atom(4, "CAL ", "CAL", 'A', 4, 12, ""),
      {"Na", "K", "Cl", "Ca"});
}

TEST(Pdb, names_of_proteins_may_begin_a_column_early) {
  expect_elements(
      pdb_atom(1, "CA  ", "GLY", 'A', 1, 0, "") + pdb_atom(2, "HG  ", "SER", 'A', 2, 5, "") +
          pdb_atom(3, "CD2 ", "HIE", 'A', 3, 9, "") + pdb_atom(4, "SE  ", "MSE", 'A', 4, 12, ""),
      {"C", "H", "Se"});
}

TEST(Pdb, water_and_alternate_locations_are_left_out_and_counted) {
  const std::string text = pdb_atom(1, " CA ", "GLY", 'A', 1, 0, "C", 'B') +
                           pdb_atom(2, " CA ", "GLY", 'A', 1, 1, "C", 'A') +
                           pdb_atom(3, " O  ", "HOH", 'A', 2, 5, "O") +
                           pdb_atom(4, " O  ", "HOH", 'A', 3, 5, "O");
  const auto frames = read_text(*client::format_of(".pdb"), text);
  ASSERT_EQ(frames[0].omissions.size(), 2U);
  EXPECT_EQ(frames[0].omissions[0].first_line, 2);
  EXPECT_EQ(frames[0].omissions[1].count, 2);
  client::ImportOptions options;
  options.with_water = true;
  EXPECT_EQ(count_of(document(".pdb", text), "sphere"), 1U);
  EXPECT_EQ(count_of(document(".pdb", text, options), "sphere"), 3U);
}

/// The side chain has its own two places; the hydrogen is known in the second one only. The other
/// residue that may stand there has atoms which this one has not.
TEST(Pdb, atoms_of_one_location_only_are_shown) {
  const std::string text = pdb_atom(1, " CA ", "SER", 'A', 1, 0, "C", 'A') +
                           pdb_atom(2, " CA ", "SER", 'A', 1, 1, "C", 'B') +
                           pdb_atom(3, " HG ", "SER", 'A', 1, 2, "H", 'B') +
                           pdb_atom(4, " CB ", "SER", 'A', 1, 3, "C", 'C') +
                           pdb_atom(5, " CB ", "SER", 'A', 1, 4, "C", 'D') +
                           pdb_atom(6, " CG2", "THR", 'A', 1, 5, "C", 'B');
  const auto frames = read_text(*client::format_of(".pdb"), text);
  EXPECT_EQ(count_of(document(".pdb", text), "sphere"), 3U);
  ASSERT_EQ(frames[0].omissions.size(), 1U);
  EXPECT_EQ(frames[0].omissions[0].count, 3);
}

TEST(Pdb, water_of_simulations_is_water) {
  for (const char* const name : {"SOL", "TIP", "TP3", "SPC", "WAT"})
    EXPECT_EQ(count_of(document(".pdb", pdb_atom(1, " CA ", "GLY", 'A', 1, 0, "C") +
                                            pdb_atom(2, " O  ", name, 'A', 2, 5, "O")),
                       "sphere"),
              1U)
        << name;
}

TEST(Pdb, serials_may_reach_into_the_sixth_column) {
  std::string line = pdb_atom(1, " CA ", "GLY", 'A', 1, 0, "C");
  line.replace(0, 11, "ATOM 100000");
  EXPECT_EQ(count_of(document(".pdb", pdb_atom(1, " N  ", "GLY", 'A', 1, 1, "N") + line), "sphere"),
            2U);
}

TEST(Pdb, water_alone_is_shown) {
  const std::string water = pdb_atom(1, " O  ", "HOH", 'A', 1, 0, "O");
  EXPECT_EQ(document(".pdb", water).at("objects").size(), 1U);
  const json with_ion = document(".pdb", water + pdb_atom(2, "NA  ", " NA", 'A', 2, 5, "NA"));
  ASSERT_EQ(with_ion.at("objects").size(), 1U);
  EXPECT_EQ(with_ion.at("objects")[0].at("material"), "Na");
}

TEST(Pdb, models_are_frames) {
  const std::string atom = pdb_atom(1, " CA ", "GLY", 'A', 1, 0, "C");
  EXPECT_EQ(documents(".ent", "MODEL        1\n" + atom + "TER\nENDMDL\nMODEL        2\n" + atom +
                                  "ENDMDL\nEND\n")
                .size(),
            2U);
  EXPECT_EQ(documents(".pdb", atom + "END\n" + atom + "END\n").size(), 2U);
}

TEST(Pdb, models_begin_frames_where_none_is_ended) {
  const std::string atom = pdb_atom(1, " CA ", "GLY", 'A', 1, 0, "C");
  const auto frames =
      documents(".pdb", "MODEL        1\n" + atom + "MODEL        2\n" + atom + atom + "END\n");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(count_of(frames[0], "sphere"), 1U);
  EXPECT_EQ(count_of(frames[1], "sphere"), 2U);
}

TEST(Pdb, chains_residues_and_bfactors_give_colours) {
  const std::string text = pdb_atom(1, " CA ", "GLY", 'A', 1, 0, "C") +
                           pdb_atom(2, " CA ", "ASP", 'B', 1, 5, "C") +
                           pdb_atom(3, " CA ", "GLY", 'B', 2, 9, "C");
  const auto colours = [&](const std::string& color) {
    return document(".pdb", text, options_for(color, client::AtomStyle::spacefill))
        .at("materials")
        .size();
  };
  EXPECT_EQ(colours("chain"), 2U);
  EXPECT_EQ(colours("residue"), 2U);
  EXPECT_EQ(colours("bfactor"), 3U);
  EXPECT_EQ(colours("occupancy"), 1U);
}

/// Columns 61 to 66 have room for 9e300.
TEST(Pdb, bfactors_beyond_single_precision_are_the_largest) {
  std::string text;
  for (const char* const bfactor : {"  10.0", " 9e300", "  20.0", "-9e300"})
    text += pdb_atom(1, " CA ", "GLY", 'A', 1, 0, "C").replace(60, 6, bfactor);
  const json scene = document(".pdb", text, options_for("bfactor", client::AtomStyle::spacefill));
  EXPECT_EQ(scene.at("materials").size(), 3U);
}

TEST(Pdb, each_error_has_its_line) {
  struct PdbMistake {
    std::string text;
    int line;
    std::string says;
    std::string color{};
  };
  const std::string atom = pdb_atom(1, " CA ", "GLY", 'A', 1, 0, "C");
  const std::vector<PdbMistake> table{
      {"HEADER\n", 1, "the file has no atoms"},
      {atom + atom.substr(0, 50) + "\n", 2, "ends before column 54"},
      {std::string(atom).replace(33, 2, "xy"), 1, "'xy000' stands in columns 31 to 38, where x"},
      {atom, 1, "nothing here is called 'mass'", "mass"},
      {atom.substr(0, 60) + "\n", 1, "'' stands where bfactor is to be a number", "bfactor"},
  };
  for (const PdbMistake& mistake : table) {
    SCOPED_TRACE(mistake.text);
    const auto frames = read_text(*client::format_of(".pdb"), mistake.text,
                                  options_for(mistake.color, client::AtomStyle::spacefill));
    ASSERT_EQ(frames.at(0).errors.size(), 1U);
    EXPECT_EQ(frames[0].errors[0].line, mistake.line);
    EXPECT_NE(frames[0].errors[0].what.find(mistake.says), std::string::npos)
        << frames[0].errors[0].what;
  }
}

TEST(Mmcif, models_of_ice_have_a_molecule_at_each_place) {
  const auto frames =
      documents(".cif", shipped("ice.cif"), options_for("", client::AtomStyle::ball_and_stick));
  ASSERT_EQ(frames.size(), 2U);
  for (const json& frame : frames) {
    EXPECT_EQ(count_of(frame, "sphere"), 24U);
    EXPECT_EQ(count_of(frame, "cylinder"), 2U * 16U);
  }
}

TEST(Mmcif, any_column_of_the_sites_gives_colours) {
  EXPECT_EQ(documents(".mmcif", shipped("ice.cif"),
                      options_for("B_iso_or_equiv", client::AtomStyle::spacefill))[0]
                .at("materials")
                .size(),
            8U);
}

TEST(Mmcif, column_of_words_gives_a_colour_each_and_gaps_among_numbers_are_gray) {
  const std::string text =
      "\xEF\xBB\xBF"
      "data_x\nloop_\n_atom_site.type_symbol\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
      "_atom_site.Cartn_z\n_atom_site.group_PDB\n_atom_site.q\n"
      "C 0 0 0 ATOM 1(2)\nC 5(2) 0 0 HETATM .\nC 9 0 0 ATOM 2\n";
  const auto read = [&](const char* column) {
    return read_text(*client::format_of(".cif"), text,
                     options_for(column, client::AtomStyle::spacefill))
        .at(0);
  };
  const client::Reading words = read("group_PDB");
  EXPECT_EQ(words.scene.materials.size(), 2U);
  EXPECT_TRUE(words.omissions.empty());
  const client::Reading numbers = read("q");
  EXPECT_EQ(numbers.scene.materials.size(), 3U);
  ASSERT_EQ(numbers.omissions.size(), 1U);
  EXPECT_NE(numbers.omissions[0].one.find("gray"), std::string::npos);
}

TEST(Mmcif, cell_without_a_length_or_a_site_without_a_place_is_an_error) {
  const auto error_of = [](const std::string& length, const std::string& place) {
    return read_text(*client::format_of(".cif"),
                     "data_x\n_cell_length_a " + length +
                         "\n_cell_length_b 5\n_cell_length_c 5\n_cell_angle_alpha 90\n"
                         "_cell_angle_beta 90\n_cell_angle_gamma 90\nloop_\n_atom_site_label\n"
                         "_atom_site_fract_x\n_atom_site_fract_y\n_atom_site_fract_z\n"
                         "C1 0.1 0.2 0.3\nC9 " +
                         place + " 0.2 0.45\n")
        .at(0)
        .errors.at(0)
        .what;
  };
  EXPECT_NE(error_of("?", "0.1").find("_cell_length_"), std::string::npos);
  EXPECT_NE(error_of("5", "?").find("'C9' has no place"), std::string::npos) << error_of("5", "?");
}

/// Four copies by P 21/c, of which operators leave three in other cells.
TEST(Mmcif, every_copy_is_brought_back_into_the_cell) {
  const json scene = document(
      ".cif",
      "data_x\n_cell_length_a 10\n_cell_length_b 10\n_cell_length_c 10\n"
      "_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma 90\n"
      "_symmetry_space_group_name_H-M 'P 21/c'\nloop_\n_atom_site_label\n_atom_site_fract_x\n"
      "_atom_site_fract_y\n_atom_site_fract_z\nC1 0.1 0.2 0.3\nC2 0.1 0.2 0.45\n");
  const json centers = scene.at("objects")[0].at("centers");
  EXPECT_EQ(centers.size(), 8U);
  for (const json& center : centers) {
    EXPECT_LT(center[0], 0);  // a scene's x is the file's with its sign changed
    EXPECT_GT(center[0], -10);
    for (const std::size_t axis : {1U, 2U}) {
      EXPECT_GT(center[axis], 0);
      EXPECT_LT(center[axis], 10);
    }
  }
}

TEST(Mmcif, cell_of_a_small_structure_is_filled) {
  const json scene = document(
      ".cif",
      "data_salt\n_cell_length_a 5.64\n_cell_length_b 5.64\n_cell_length_c 5.64\n"
      "_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma 90\n"
      "_symmetry_space_group_name_H-M 'F m -3 m'\nloop_\n_atom_site_label\n_atom_site_fract_x\n"
      "_atom_site_fract_y\n_atom_site_fract_z\nNa1 0 0 0\nCl1 0.5 0.5 0.5\n");
  EXPECT_EQ(count_of(scene, "sphere"), 8U);
}

/// Magnetite's group has two origins, and its name says neither.
TEST(Mmcif, operators_that_the_file_lists_stand_over_the_name_of_its_group) {
  const auto atoms = [](const std::string& symmetry) {
    return count_of(document(".cif",
                             "data_x\n_cell_length_a 8\n_cell_length_b 8\n_cell_length_c 8\n"
                             "_cell_angle_alpha 90\n_cell_angle_beta 90\n_cell_angle_gamma 90\n" +
                                 symmetry +
                                 "loop_\n_atom_site_label\n_atom_site_fract_x\n_atom_site_fract_y\n"
                                 "_atom_site_fract_z\nFe1 0.125 0.125 0.125\n"),
                    "sphere");
  };
  const std::string name = "_symmetry_space_group_name_H-M 'F d -3 m'\n";
  const std::string inversion = "x,y,z\n'1/4-x, 1/4-y, 1/4-z'\n1/2+x,1/2+y,z\n";
  EXPECT_EQ(atoms(name), 16U);
  for (const char* const tag :
       {"_symmetry_equiv_pos_as_xyz\n", "_space_group_symop_operation_xyz\n"})
    for (std::string symmetry : {std::string(), name}) {
      symmetry.append("loop_\n").append(tag).append(inversion);
      EXPECT_EQ(atoms(symmetry), 2U) << tag;
    }
  EXPECT_EQ(read_text(*client::format_of(".cif"),
                      "data_x\n_symmetry_equiv_pos_as_xyz 'x,y,up'\n_atom_site_label C\n"
                      "_atom_site_fract_x 0\n")
                .at(0)
                .errors.size(),
            1U);
}

TEST(Mmcif, tags_may_be_capitals_and_atoms_in_a_later_block) {
  const json scene = document(".cif",
                              "DATA_A\n_cell.length_a 1\nDATA_B\nLOOP_\n_Atom_Site.Type_Symbol\n"
                              "_ATOM_SITE.CARTN_X\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
                              "C 1 2 3\nC 4 5 6\n");
  EXPECT_EQ(scene.at("objects")[0].at("centers"), json::parse("[[-1, 2, 3], [-4, 5, 6]]"));
}

/// A category of one row needs no loop.
TEST(Mmcif, single_rows_may_be_pairs) {
  const std::string atom =
      "data_A\n_atom_site.type_symbol C\n_atom_site.Cartn_x 1\n_atom_site.Cartn_y 2\n"
      "_atom_site.Cartn_z 3\n";
  EXPECT_EQ(document(".cif", atom).at("objects")[0].at("center"), json::parse("[-1, 2, 3]"));
}

TEST(Mmcif, errors_have_their_line) {
  const auto error_of = [](const std::string& text) {
    return read_text(*client::format_of(".cif"), text).at(0).errors.at(0);
  };
  EXPECT_EQ(error_of("data_X\nloop_\n_atom_site.id\n'1\n").line, 4);
  EXPECT_EQ(
      error_of("data_X\nloop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n").what,
      "the table of atoms has no rows");
  const client::LineError wrong = error_of(
      "data_X\nloop_\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n1 2 3\n1 two "
      "3\n");
  EXPECT_EQ(wrong.line, 7);
  EXPECT_EQ(wrong.what, "'two' stands where _atom_site.Cartn_y is to be a number");
}

/// What is no value, or one over several lines, is before the wrong one.
TEST(Mmcif, lines_are_counted_as_cif_separates_values) {
  const auto line_of = [](const std::string& text) {
    return read_text(*client::format_of(".cif"), text).at(0).errors.at(0).line;
  };
  const std::string tags =
      "_atom_site.auth_atom_id\n_atom_site.Cartn_x # in angstrom\n_atom_site.Cartn_y\n"
      "_atom_site.Cartn_z\n";
  EXPECT_EQ(line_of("data_X\nloop_\n" + tags +
                    "'O 5' 1 2 3 # 'two' more\n\n\"C\"1\" 1 2 3\r\n;two\n lines\n;\n1\n2 3\n"
                    "a'b 1 2\n'x'\n"),
            16);
  EXPECT_EQ(line_of("data_X loop_ _cell.a 1 2 LOOP_\n" + tags + "C 1 2 x"), 6);
  EXPECT_EQ(line_of("data_X\nloop_\n_ATOM_SITE.cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
                    "1 2\n3 4\n5 z\n"),
            8);
  // Pairs, among which another category's may stand.
  EXPECT_EQ(line_of("data_X\n_atom_site.id ';'\n_atom_site.Cartn_x 1\n_cell.length_a 5\n"
                    "_atom_site.Cartn_y\n;two\n;\n_atom_site.Cartn_z 3\n"),
            6);
}

}  // namespace
}  // namespace raytracer::test
