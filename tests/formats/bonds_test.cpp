// Bonds that PDB and mmCIF name, and those that distances tell.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/formats/particles_in_pictures.h"

namespace raytracer::test {
namespace {

using nlohmann::json;

const std::string zinc_and_sulfur =
    "data_X\nloop_\n_atom_site.type_symbol\n_atom_site.label_atom_id\n_atom_site.auth_comp_id\n"
    "_atom_site.auth_asym_id\n_atom_site.auth_seq_id\n_atom_site.Cartn_x\n_atom_site.Cartn_y\n"
    "_atom_site.Cartn_z\nZN ZN ZN A 1 0 0 0\nS SG CYS A 2 5 0 0\n";

/// Sixty atoms with three bonds each, of which each is drawn in two halves.
TEST(Pdb, every_bond_of_c60_is_drawn_once_in_two_halves) {
  const auto options = options_for("", client::AtomStyle::ball_and_stick);
  const json scene = document(".pdb", shipped("c60.pdb"), options);
  EXPECT_EQ(count_of(scene, "sphere"), 60U);
  EXPECT_EQ(count_of(scene, "cylinder"), 2U * 90U);
}
TEST(Pdb, bonds_that_the_file_names_may_be_long) {
  const std::string atoms =
      pdb_atom(1, "ZN  ", " ZN", 'A', 1, 0, "ZN") + pdb_atom(2, " CA ", "GLY", 'A', 2, 8, "C");
  const auto options = options_for("", client::AtomStyle::sticks);
  EXPECT_EQ(count_of(document(".pdb", atoms, options), "cylinder"), 0U);
  EXPECT_EQ(count_of(document(".pdb", atoms + "CONECT    1    2\nCONECT    2    1\n", options),
                     "cylinder"),
            2U);
}
/// CONECT names all bonds of a hetero atom that it names; of others, distances tell them.
TEST(Pdb, distances_bond_no_two_hetero_atoms_that_the_file_names_apart) {
  const auto halves = [&](const std::string& record, const std::string& connections) {
    std::string text;
    for (int i = 0; i < 4; ++i)
      text += pdb_atom(i + 1, " C  ", "LIG", 'A', 1, 1.5 * i, "C").replace(0, 6, record);
    return count_of(
        document(".pdb", text + connections, options_for("", client::AtomStyle::sticks)),
        "cylinder");
  };
  EXPECT_EQ(halves("HETATM", ""), 2U * 3U);
  EXPECT_EQ(halves("HETATM", "CONECT    1    2\n"), 2U * 3U);
  EXPECT_EQ(halves("HETATM", "CONECT    1    2\nCONECT    3    4\n"), 2U * 2U);
  EXPECT_EQ(halves("ATOM  ", "CONECT    1    2\nCONECT    3    4\n"), 2U * 3U);
}
/// A connection stands with both of its atoms, and once more for a double bond. Water is left out
/// on purpose, and told already.
TEST(Pdb, bonds_of_atoms_that_the_file_lacks_are_counted_once) {
  const std::string text = pdb_atom(1, " CA ", "GLY", 'A', 1, 0, "C") +
                           pdb_atom(2, " O  ", "HOH", 'A', 2, 5, "O") +
                           "CONECT    1    2    9    9\nCONECT    9    1\nCONECT    1    8\n";
  const auto omissions =
      read_text(*client::format_of(".pdb"), text, options_for("", client::AtomStyle::sticks))
          .at(0)
          .omissions;
  ASSERT_EQ(omissions.size(), 2U);
  EXPECT_EQ(omissions[1].many, "bonds of atoms that are not in the file left out");
  EXPECT_EQ(omissions[1].count, 2);
  EXPECT_EQ(omissions[1].first_line, 3);
  EXPECT_EQ(read_text(*client::format_of(".pdb"), text).at(0).omissions.size(), 1U);
}
/// Some programs number the atoms of all models through.
TEST(Pdb, bonds_of_another_models_atoms_are_not_counted) {
  const auto model = [](const char* begin, int first) {
    return begin + pdb_atom(first, " CA ", "GLY", 'A', 1, 0, "C") +
           pdb_atom(first + 1, " CB ", "GLY", 'A', 1, 4, "C") + "ENDMDL\n";
  };
  const std::string text =
      model("MODEL        1\n", 1) + model("MODEL        2\n", 3) + "CONECT    3    4\n";
  const auto frames =
      read_text(*client::format_of(".pdb"), text, options_for("", client::AtomStyle::sticks));
  ASSERT_EQ(frames.size(), 2U);
  for (const client::Reading& frame : frames) EXPECT_TRUE(frame.omissions.empty());
}
/// The other copy is elsewhere.
TEST(Mmcif, bonds_to_other_copies_are_left_out_and_counted) {
  const std::string text =
      zinc_and_sulfur +
      "_struct_conn.conn_type_id metalc\n"
      "_struct_conn.ptnr1_auth_asym_id A\n_struct_conn.ptnr1_auth_comp_id ZN\n"
      "_struct_conn.ptnr1_auth_seq_id 1\n_struct_conn.ptnr1_label_atom_id ZN\n"
      "_struct_conn.ptnr1_symmetry 1_555\n_struct_conn.ptnr2_symmetry 3_655\n"
      "_struct_conn.ptnr2_auth_asym_id A\n_struct_conn.ptnr2_auth_comp_id CYS\n"
      "_struct_conn.ptnr2_auth_seq_id 2\n_struct_conn.ptnr2_label_atom_id SG\n";
  const auto frames =
      read_text(*client::format_of(".cif"), text, options_for("", client::AtomStyle::sticks));
  ASSERT_EQ(frames[0].omissions.size(), 1U);
  EXPECT_EQ(frames[0].omissions[0].count, 1);
  const json scene = json::parse(client::model::to_document(frames[0].scene));
  EXPECT_EQ(count_of(scene, "cylinder"), 0U);
}
TEST(Mmcif, bonds_that_the_file_names_are_drawn) {
  const std::string text =
      zinc_and_sulfur +
      "loop_\n_struct_conn.id\n"
      "_struct_conn.conn_type_id\n_struct_conn.ptnr1_auth_asym_id\n_struct_conn.ptnr1_auth_comp_"
      "id\n"
      "_struct_conn.ptnr1_auth_seq_id\n_struct_conn.ptnr1_label_atom_id\n"
      "_struct_conn.ptnr2_auth_asym_id\n_struct_conn.ptnr2_auth_comp_id\n"
      "_struct_conn.ptnr2_auth_seq_id\n_struct_conn.ptnr2_label_atom_id\n";
  const auto options = options_for("", client::AtomStyle::sticks);
  const auto bonds = [&](const std::string& rows) {
    return count_of(document(".cif", text + rows, options), "cylinder");
  };
  EXPECT_EQ(bonds("1 metalc A ZN 1 ZN A CYS 2 SG\n"), 2U);
  for (const std::string type : {"hydrog", "HYDROG", "saltbr", "mismat"})
    EXPECT_EQ(bonds("1 " + type + " A ZN 1 ZN A CYS 2 SG\n"), 0U) << type;
}
/// The atoms have both kinds of names, which differ; a connection's are of one kind.
class LabelledBonds : public testing::Test {
 protected:
  static std::vector<client::Reading> read(const std::string& kind, const std::string& rows) {
    std::string text =
        "data_X\nloop_\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
        "_atom_site.label_comp_id\n_atom_site.label_asym_id\n_atom_site.label_seq_id\n"
        "_atom_site.auth_atom_id\n_atom_site.auth_comp_id\n_atom_site.auth_asym_id\n"
        "_atom_site.auth_seq_id\n_atom_site.pdbx_PDB_ins_code\n_atom_site.label_alt_id\n"
        "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n"
        "ZN ZN ZN  B . ZN ZN  A 101 ? . 0 0 0\n"
        "S  SG CYS A 2 SG CYS A  7   A . 8 0 0\n"
        "O  O  HOH C . O  HOH A  201 ? . 0 9 0\n"
        "O  O  HOH C . O  HOH A  202 ? . 0 0 9\n"
        "C  CA GLY A 3 CA GLY A  8   ? B 30 0 0\n"
        "C  CA SER A 3 CA SER A  8   ? C 31 0 0\n"
        "loop_\n_struct_conn.conn_type_id\n";
    for (const char* const partner : {"ptnr1", "ptnr2"})
      text += fmt::format(
          "_struct_conn.{0}_{1}_asym_id\n_struct_conn.{0}_{1}_comp_id\n"
          "_struct_conn.{0}_{1}_seq_id\n_struct_conn.{0}_label_atom_id\n",
          partner, kind);
    return read_text(*client::format_of(".cif"), text + rows,
                     options_for("", client::AtomStyle::sticks));
  }

  static std::size_t sticks(const client::Reading& reading) {
    return count_of(json::parse(client::model::to_document(reading.scene)), "cylinder");
  }
};

TEST_F(LabelledBonds, are_drawn) {
  const auto frames = read("label", "metalc B ZN . ZN A CYS 2 SG\n");
  EXPECT_EQ(sticks(frames.at(0)), 2U);
}

TEST_F(LabelledBonds, authors_names_are_others) {
  EXPECT_EQ(sticks(read("label", "metalc A ZN 101 ZN A CYS 7 SG\n").at(0)), 0U);
}

TEST_F(LabelledBonds, of_atoms_that_the_model_lacks_are_counted) {
  const auto omissions = read("label",
                              "metalc B ZN . ZN A CYS 9 SG\nmetalc B ZN . ZN A HIS 2 SG\n"
                              "hydrog B ZN . ZN A HIS 2 SG\nmetalc B ZN . ZN A CYS 2 SG\n")
                             .at(0)
                             .omissions;
  ASSERT_EQ(omissions.size(), 3U);
  EXPECT_EQ(omissions[2].many, "bonds of atoms that are not in the model left out");
  EXPECT_EQ(omissions[2].count, 2);
}

/// The water, and the other residue that may stand there.
TEST_F(LabelledBonds, of_atoms_left_out_on_purpose_are_not_counted) {
  const auto omissions =
      read("label", "metalc B ZN . ZN C HOH . O\nmetalc B ZN . ZN A SER 3 CA\n").at(0).omissions;
  EXPECT_EQ(omissions.size(), 2U);
}

}  // namespace
}  // namespace raytracer::test
