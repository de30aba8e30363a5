// XYZ, LAMMPS dumps and tables: what becomes of their columns, and what is wrong with them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "client/failure.h"
#include "tests/formats/particles_in_pictures.h"

namespace raytracer::test {
namespace {

using nlohmann::json;

const std::string dump_head =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 10\n0 20\n5 10\n";

TEST(Xyz, atoms_become_spheres_of_their_element_with_x_mirrored) {
  const json scene = document(".xyz", "3\nwater\nO 0 0 1\nH 1 2 3\nh1 4 5 6\n");
  ASSERT_EQ(scene.at("objects").size(), 2U);
  EXPECT_EQ(scene.at("objects")[0],
            json({{"type", "sphere"}, {"center", {0, 0, 1}}, {"radius", 1.52}, {"material", "O"}}));
  EXPECT_EQ(scene.at("objects")[1].at("centers"), json({{-1, 2, 3}, {-4, 5, 6}}));
  EXPECT_EQ(scene.at("objects")[1].at("material"), "H");
}

TEST(Xyz, properties_name_the_columns) {
  const std::string text =
      "2\nLattice=\"1 0 0\" Properties=id:I:1:pos:R:3:species:S:1:radius:R:1:force:R:2\n"
      "7 1 2 3 Na 0.5 8 9\n8 4 5 6 Cl 0.25 8 9\n";
  const json scene = document(".extxyz", text);
  EXPECT_EQ(scene.at("objects")[0].at("radius"), 0.5);
  EXPECT_EQ(scene.at("objects")[1].at("radius"), 0.25);
  EXPECT_EQ(document(".xyz", text, options_for("force_2")).at("objects").size(), 1U);
}

TEST(Xyz, species_are_a_column_of_colours) {
  const std::string text = "2\nProperties=species:S:1:pos:R:3\nNa 0 0 0\nCl 5 0 0\n";
  const json scene = document(".extxyz", text, options_for("species"));
  EXPECT_EQ(scene, document(".extxyz", text, options_for("element")));
  const std::string numbers = "2\nProperties=Z:I:1:pos:R:3\n11 0 0 0\n17 5 0 0\n";
  EXPECT_EQ(document(".extxyz", numbers, options_for("Z")), scene);
}

TEST(Xyz, vectors_give_colours_by_their_length) {
  const auto materials = [](const std::string& properties, const std::string& color) {
    return document(
               ".extxyz",
               "3\nProperties=" + properties + "\n0 0 0 3 0 4 5\n5 0 0 0 6 8 10\n9 0 0 -5 0 0 5\n",
               options_for(color))
        .at("materials");
  };
  const json by_speed = materials("pos:R:3:vel:R:3:speed:R:1", "speed");
  EXPECT_EQ(by_speed.size(), 2U);
  EXPECT_EQ(materials("pos:R:3:vel:R:3:speed:R:1", "vel"), by_speed);
  EXPECT_EQ(materials("pos:R:3:Vel:R:3:speed:R:1", "vel"), by_speed);
  const auto missing =
      read_text(*client::format_of(".xyz"), "1\nProperties=pos:R:3:vel:R:2\n0 0 0 1 nan\n",
                options_for("vel"));
  ASSERT_TRUE(missing.at(0).errors.empty());
  EXPECT_EQ(missing[0].omissions.size(), 1U);
}

TEST(Xyz, frames_follow_each_other_under_one_camera) {
  const auto frames = documents(".xyz", "1\n\nC 0 0 0\n2\n\nC 0 0 0\nC 9 9 9\n\n");
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].at("camera"), frames[1].at("camera"));
  EXPECT_EQ(centers_of(frames[1]).size(), 2U);
}

TEST(Xyz, labels_of_simulations_name_elements) {
  const json scene = document(".xyz", "4\n\nOW 0 0 0\nHW1 1 0 0\nCl 5 0 0\nXx 9 0 0\n");
  EXPECT_EQ(scene.at("materials").size(), 4U);
  for (const char* const element : {"O", "H", "Cl", "X"})
    EXPECT_TRUE(scene.at("materials").contains(element)) << element;
}

TEST(Xyz, frames_without_atoms_are_left_out_and_counted) {
  const std::string text = "0\nempty\n0\n\n1\n\nC 0 0 0\n0\n\n1\n\nC 1 0 0\n0\n\n";
  const auto frames = read_text(*client::format_of(".xyz"), text);
  ASSERT_EQ(frames.size(), 2U);
  ASSERT_EQ(frames[0].omissions.size(), 1U);
  EXPECT_EQ(frames[0].omissions[0].count, 2);
  EXPECT_EQ(frames[1].omissions[0].count, 1);
  EXPECT_EQ(read_text(*client::format_of(".xyz"), "0\n\n")[0].errors.size(), 1U);
}

TEST(Lammps, frames_without_atoms_are_left_out_and_counted) {
  const std::string empty = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: ATOMS x y z\n";
  const auto frames = read_text(*client::format_of(".dump"),
                                empty + dump_head + "ITEM: ATOMS x y z\n1 1 1\n2 2 2\n" + empty);
  ASSERT_EQ(frames.size(), 1U);
  ASSERT_EQ(frames[0].omissions.size(), 1U);
  EXPECT_EQ(frames[0].omissions[0].count, 1);
}

TEST(Lammps, places_are_taken_as_they_are_or_in_box_lengths) {
  const auto centers = [](const std::string& columns, const std::string& rows) {
    return centers_of(document(".dump", dump_head + "ITEM: ATOMS " + columns + "\n" + rows));
  };
  EXPECT_EQ(centers("id x y z", "1 1 2 6\n2 3 4 7\n"), (std::vector<json>{{-1, 2, 6}, {-3, 4, 7}}));
  EXPECT_EQ(centers("zu yu xu", "6 2 1\n7 4 3\n"), (std::vector<json>{{-1, 2, 6}, {-3, 4, 7}}));
  EXPECT_EQ(centers("xs ys zs", "0.5 0.5 0.2\n0 1 1\n"),
            (std::vector<json>{{-5, 10, 6}, {0, 20, 10}}));
}

/// The bounds of a box that leans by 4 along x are wider by 4.
TEST(Lammps, box_lengths_of_a_tilted_box_lean) {
  const std::string text =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 14 4\n"
      "0 10 0\n0 10 0\nITEM: ATOMS xs ys zs\n0.5 0.5 0.5\n0 0 0\n";
  EXPECT_EQ(centers_of(document(".lammpstrj", text)), (std::vector<json>{{-7, 5, 5}, {0, 0, 0}}));
}

TEST(Lammps, types_have_a_colour_each_and_numbers_a_place_on_the_map) {
  const std::string text = dump_head + "ITEM: ATOMS type x y z v\n2 0 0 0 -1\n1 1 1 1 3\n";
  const json types = document(".dump", text);
  EXPECT_EQ(types.at("objects").size(), 2U);
  const json values = document(".dump", text, options_for("v"));
  ASSERT_EQ(values.at("objects").size(), 2U);
  // The ends of viridis, in linear shares.
  const json low = values.at("materials").at("fill1").at("color");
  const json high = values.at("materials").at("fill2").at("color");
  EXPECT_NEAR(low[2].get<double>(), 0.0887, 1e-3);
  EXPECT_NEAR(high[0].get<double>(), 0.9823, 1e-3);
}

TEST(Lammps, types_are_numbers_where_a_map_is_asked_for) {
  const std::string atoms = dump_head + "ITEM: ATOMS type v x y z\n2 2 0 0 0\n1 1 1 1 1\n";
  client::ImportOptions on_map = options_for("v");
  on_map.color_map = "magma";
  const json expected = document(".dump", atoms, on_map).at("materials");
  for (const char* const color : {"type", ""}) {
    on_map.color = color;
    EXPECT_EQ(document(".dump", atoms, on_map).at("materials"), expected);
  }
  EXPECT_NE(document(".dump", atoms).at("materials"), expected);
}

TEST(Lammps, types_have_the_same_colours_in_any_order) {
  const auto color_of_the_first = [](const std::string& rows) {
    const json scene = document(".dump", dump_head + "ITEM: ATOMS type x y z\n" + rows);
    const json& object = scene.at("objects")[0];
    return scene.at("materials").at(object.at("material").get<std::string>()).at("color");
  };
  EXPECT_EQ(color_of_the_first("1 0 0 0\n2 1 1 1\n"), color_of_the_first("1 0 0 0\n1 1 1 1\n"));
  EXPECT_EQ(color_of_the_first("2 0 0 0\n1 1 1 1\n"), color_of_the_first("2 0 0 0\n2 1 1 1\n"));
  EXPECT_NE(color_of_the_first("2 0 0 0\n2 1 1 1\n"), color_of_the_first("1 0 0 0\n1 1 1 1\n"));
}

TEST(Lammps, radius_and_diameter_are_sizes) {
  const json radii =
      document(".dump", dump_head + "ITEM: ATOMS radius x y z\n0.5 0 0 0\n0.25 1 1 1\n");
  EXPECT_EQ(radii.at("objects")[0].at("radius"), json({0.5, 0.25}));
  const json halves =
      document(".dump", dump_head + "ITEM: ATOMS diameter x y z\n0.5 0 0 0\n0.25 1 1 1\n");
  EXPECT_EQ(halves.at("objects")[0].at("radius"), json({0.25, 0.125}));
}

TEST(Particles, range_of_colours_is_that_of_the_first_frame_with_two_numbers) {
  const std::string same = "2\nProperties=pos:R:3:v:R:1\n0 0 0 5\n1 0 0 5\n";
  const std::string other = "2\nProperties=pos:R:3:v:R:1\n0 0 0 5\n1 0 0 6\n";
  const auto frames = documents(".extxyz", same + other + other, options_for("v"));
  ASSERT_EQ(frames.size(), 3U);
  EXPECT_EQ(frames[0].at("objects").size(), 1U);
  EXPECT_EQ(frames[1].at("objects").size(), 2U);
  EXPECT_EQ(frames[1].at("materials"), frames[2].at("materials"));
}

TEST(Particles, without_a_size_touch_each_other) {
  const json scene = document(".csv", "x,y,z\n0,0,0\n3,0,0\n6,0,0\n");
  EXPECT_EQ(scene.at("objects")[0].at("radius"), 1.5);
}

struct ParticleMistake {
  std::string ending;
  std::string text;
  int line;
  std::string says;
  client::ImportOptions options{};
};

TEST(Particles, each_error_has_its_line_and_says_what_is_wrong) {
  const std::vector<ParticleMistake> table{
      {".xyz", "", 1, "'' is no number of atoms"},
      {".xyz", "x\n", 1, "'x' is no number of atoms"},
      {".xyz", "0\n\n", 1, "the file has no atoms"},
      {".xyz", "99999999999\n\n", 1, "is no number of atoms"},
      {".xyz", "3\n\nC 0 0 0\nC 0 0 1\n", 4, "the file ends after 2 of 3 atoms"},
      {".xyz", "2\n\nC 0 0 0\nC 0 zero 1\n", 4,
       "'zero' stands where a number is to be, in column 'y'"},
      {".xyz", "1\n\nC 0 0\n", 3, "the line has 3 fields, and is to have 4: element x y z"},
      {".xyz", "1\n\nC 0 0 1e200\n", 3, "'1e200' is too far away"},
      {".xyz", "1\n\nC 0 0 nan\n", 3, "'nan' stands where a number is to be"},
      {".xyz", "1\nProperties=species:S:x\nC 0 0 0\n", 2, "'x' is no number of columns"},
      {".xyz", "1\n\nC 0 0 0\n", 2, "nothing here is called 'mass'", options_for("mass")},
      {".dump", "ITEM: TIMESTEP\n0\n", 2, "the file ends in the middle of a frame"},
      {".dump", "1 2 3\n", 1, "'1 2 3' stands where a line is to begin with ITEM:"},
      {".dump", "ITEM: ENTRIES c\n", 1, "'ENTRIES c' is no section of a dump of atoms"},
      {".dump", dump_head + "ITEM: ATOMS id type\n1 1\n", 9, "the atoms have no places"},
      {".dump", dump_head + "ITEM: ATOMS x y z\n1 1 1\n", 10, "the frame ends after 1 of 2 atoms"},
      {".dump", "ITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS xs ys zs\n1 1 1\n", 4, "BOX BOUNDS"},
      {".dump", "ITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS\n0 x\n", 4,
       "'0 x' is no edge of the box"},
      {".csv", "1,2,3\n", 1, "a number stands in the first line"},
      {".csv", "x,y\n1,2\n", 1, "no column is called z"},
      {".csv", "x y z\n1 2 3\n", 1, "commas are between them in a .csv"},
      {".csv", "x,y,z\n", 1, "the table has a header and no points"},
      {".csv", "x,y,z\n1,2,\n", 2, "nothing stands where a number is to be, in column 'z'"},
      {".csv", "x,y,z\n1,2,3,4\n", 2, "more fields than the header"},
      {".csv", "x,y,z\n1,2,\"3\n", 2, "a quotation mark is not closed"},
      {".csv", "x,y,z,radius\n1,2,3,0\n", 2, "the radius is '0', and must be greater than 0"},
      {".csv", "x,y,z,r,g,b\n1,2,3,0,0,300\n", 2, "the colour has '300'"},
  };
  for (const ParticleMistake& mistake : table) {
    SCOPED_TRACE(mistake.text);
    const auto frames =
        read_text(*client::format_of(mistake.ending), mistake.text, mistake.options);
    ASSERT_EQ(frames.size(), 1U);
    ASSERT_EQ(frames[0].errors.size(), 1U);
    EXPECT_EQ(frames[0].errors[0].line, mistake.line);
    EXPECT_NE(frames[0].errors[0].what.find(mistake.says), std::string::npos)
        << frames[0].errors[0].what;
  }
}

TEST(Particles, style_of_bonds_needs_elements) {
  client::ImportOptions options;
  options.style = client::AtomStyle::sticks;
  EXPECT_THROW(document(".csv", "x,y,z\n1,2,3\n", options), client::InputError);
}

TEST(Particles, line_of_more_than_a_megabyte_is_refused) {
  const auto frames =
      read_text(*client::format_of(".csv"), "x,y,z\n" + std::string((1 << 20) + 1, ' '));
  ASSERT_EQ(frames[0].errors.size(), 1U);
  EXPECT_EQ(frames[0].errors[0].line, 2);
}

TEST(Particles, frames_that_leave_the_first_one_s_picture_or_range_are_told_once) {
  const auto omissions = [](const std::string& later) {
    std::string text;
    for (const std::string& frame : {std::string("0 0 0 1\nC 1 0 0 2\n"), later, later})
      text += "2\nProperties=species:S:1:pos:R:3:q:R:1\nC " + frame;
    client::ImportOptions options;
    options.color = "q";
    std::vector<std::size_t> counts;
    for (const client::Reading& frame : read_text(*client::format_of(".xyz"), text, options))
      counts.push_back(frame.omissions.size());
    return counts;
  };
  using Counts = std::vector<std::size_t>;
  EXPECT_EQ(omissions("0 0 0 1.5\nC 1 0 0 2\n"), (Counts{0, 0, 0}));
  EXPECT_EQ(omissions("0 0 0 1.5\nC 9 0 0 2\n"), (Counts{0, 1, 0}));
  EXPECT_EQ(omissions("0 0 0 1.5\nC 1 0 0 3\n"), (Counts{0, 1, 0}));
  EXPECT_EQ(omissions("0 9 0 0\nC 1 0 0 3\n"), (Counts{0, 2, 0}));
}

}  // namespace
}  // namespace raytracer::test
