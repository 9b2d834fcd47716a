#include <gtest/gtest.h>

#include <cmath>

#include "common/base/error.hpp"
#include "common/io/pvd.hpp"
#include "common/io/vtp_writer.hpp"
#include "common/io/vtu_writer.hpp"
#include "tests/io/temporary_folder.hpp"
#include "vessel/mesh_file.hpp"
#include "vessel/sweep.hpp"

namespace tether {
namespace {

/// Written without VTK, read by VTK: points, cells and their order come back.
TEST(VtuWriter, FileIsReadBackByVtk) {
  const TemporaryFolder folder;
  const VesselMesh tube = circular_tube(2, 10, 0.2, 12, 4);
  const std::vector<Field> fields{Field::vectors("displacement", tube.wall.points),
                                  Field::scalars("pressure", VectorXd::Ones(tube.wall.points.cols()))};
  write_vtu(folder / "wall.vtu", tube.wall.points, cells_of(tube.wall), fields);
  const MeshFile wall = read_mesh_file(folder / "wall.vtu");
  EXPECT_EQ(wall.points, tube.wall.points);
  EXPECT_EQ(wall.prisms, tube.wall.prisms);

  Cells cells = cells_of(tube.fluid);
  cells.triangles = tube.fluid.interface;
  std::vector<double> part(cells.count(), 7);
  part.back() = 9;
  write_vtu(folder / "fluid.vtu", tube.fluid.points, cells, {}, {{"part", 1, part}});
  const MeshFile fluid = read_mesh_file(folder / "fluid.vtu");
  EXPECT_EQ(fluid.points, tube.fluid.points);
  EXPECT_EQ(fluid.tetrahedra, tube.fluid.tetrahedra);
  EXPECT_EQ(fluid.triangles, tube.fluid.interface);
  EXPECT_EQ(fluid.triangle_labels.at("part").front(), 7);
  EXPECT_EQ(fluid.triangle_labels.at("part").back(), 9);
}

TEST(VtuWriter, FailuresAreErrors) {
  const VesselMesh tube = circular_tube(2, 10, 0.2, 12, 4);
  EXPECT_THROW(write_vtu("/no/such/folder/x.vtu", tube.fluid.points, cells_of(tube.fluid), {}), RunError);
  const TemporaryFolder folder;
  EXPECT_THROW(
      write_vtu(folder / "x.vtu", tube.fluid.points, cells_of(tube.fluid), {Field::scalars("p", VectorXd::Zero(3))}),
      InternalError);
}

/// A surface keeps its order, its labels, and seven digits of its coordinates.
TEST(VtpWriter, FileIsReadBackByVtk) {
  const TemporaryFolder folder;
  Points points(3, 4);
  points << 0, 0.1, 0, 0,  //
      0, 0, 1. / 3, 0,     //
      0, 0, 0, 12345.678;
  const std::vector<Triangle> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  write_vtp(folder / "closed.vtp", points, triangles, {3, 3, 3, 5});
  const MeshFile closed = read_mesh_file(folder / "closed.vtp");
  EXPECT_EQ(closed.points, points.cast<float>().cast<double>());
  EXPECT_EQ(closed.triangles, triangles);
  EXPECT_EQ(closed.triangle_labels.at("ModelFaceID"), (std::vector<std::int64_t>{3, 3, 3, 5}));
  EXPECT_THROW(write_vtp("/no/such/folder/x.vtp", points, triangles), RunError);
}

TEST(PvdSeries, GrowsAndIsCutOnResuming) {
  const TemporaryFolder folder;
  PvdSeries series(folder / "fluid.pvd");
  for (const int step : {0, 10, 20, 30}) series.add(0.1 * step, fmt::format("fluid/{:06}.vtu", step));
  PvdSeries resumed = PvdSeries::resumed(folder / "fluid.pvd", 2.0);
  ASSERT_EQ(resumed.entries().size(), 3u);
  EXPECT_EQ(resumed.entries()[2].second, "fluid/000020.vtu");
  resumed.add(0.1 * 30, "fluid/again.vtu");
  const PvdSeries whole = PvdSeries::resumed(folder / "fluid.pvd", 1e9);
  ASSERT_EQ(whole.entries().size(), 4u);
  EXPECT_EQ(whole.entries()[3], (std::pair<double, std::string>(0.1 * 30, "fluid/again.vtu")));
  EXPECT_TRUE(PvdSeries::resumed(folder / "none.pvd", 1).entries().empty());
  EXPECT_THROW(PvdSeries::resumed(folder.file("wrong.pvd", "hello"), 1), InputError);
}

/// Of three files, which are there.
PvdSeries series_of_three(const TemporaryFolder& folder) {
  std::filesystem::create_directory(folder / "vtk");
  PvdSeries series(folder / "fluid.pvd");
  for (const int i : {0, 10, 20}) {
    const std::string name = fmt::format("vtk/fluid_{:06}.vtu", i);
    folder.file(name, "a grid");
    series.add(0.1 * i, name);
  }
  return series;
}

TEST(PvdSeries, OfADamagedOneWhatItStillNamesIsKept) {
  const TemporaryFolder folder;
  const auto whole = series_of_three(folder).entries();
  std::filesystem::resize_file(folder / "fluid.pvd", std::filesystem::file_size(folder / "fluid.pvd") - 60);
  EXPECT_THROW(PvdSeries::resumed(folder / "fluid.pvd", 1e9), InputError);
  PvdSeries rescued = PvdSeries::rescued(folder / "fluid.pvd", 1e9);
  EXPECT_EQ(rescued.entries(), decltype(whole)(whole.begin(), whole.end() - 1));
  rescued.add(whole[2].first, whole[2].second);
  EXPECT_EQ(PvdSeries::resumed(folder / "fluid.pvd", 1e9).entries(), whole);
  EXPECT_TRUE(PvdSeries::rescued(folder.file("wrong.pvd", "hello"), 1).entries().empty());
}

/// A name with a byte that is no text would make the collection unreadable once more.
TEST(PvdSeries, OfADamagedOneNamesOfNoFileAreDropped) {
  const TemporaryFolder folder;
  const auto whole = series_of_three(folder).entries();
  std::ifstream file(folder / "fluid.pvd");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  text[text.find("vtk/fluid") + 4] ^= '\x80';
  std::ofstream(folder / "fluid.pvd") << text;
  PvdSeries rescued = PvdSeries::rescued(folder / "fluid.pvd", 1e9);
  EXPECT_EQ(rescued.entries(), decltype(whole)(whole.begin() + 1, whole.end()));
  rescued.add(3, "vtk/fluid_000030.vtu");
  EXPECT_EQ(PvdSeries::resumed(folder / "fluid.pvd", 1e9).entries().size(), 3U);
}

/// Somebody has removed them before the run goes on.
TEST(PvdSeries, FilesThatAreGoneAreDroppedAndTold) {
  const TemporaryFolder folder;
  const auto whole = series_of_three(folder).entries();
  std::filesystem::remove(folder / whole[1].second);
  testing::internal::CaptureStderr();
  EXPECT_EQ(PvdSeries::rescued(folder / "fluid.pvd", 1e9).entries(), (std::vector{whole[0], whole[2]}));
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            (folder / "fluid.pvd").string() + ": 1 of the files that it lists are gone: written anew without them\n");
  testing::internal::CaptureStderr();
  EXPECT_EQ(PvdSeries::rescued(folder / "fluid.pvd", 0.5).entries(), (std::vector{whole[0]}));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "what the run makes again is not missed";
}

/// As other programs write them: on one line, over several, in single quotes.
TEST(PvdSeries, IsReadAsXml) {
  const TemporaryFolder folder;
  const auto path = folder.file("a.pvd",
                                "<VTKFile type='Collection'><Collection><DataSet timestep='0' file='a.vtp'/><DataSet "
                                "timestep=\"0.5\"\n part=\"0\"\n file=\"b &amp; c.vtp\"/><!-- <DataSet/> -->"
                                "</Collection></VTKFile>");
  EXPECT_EQ(PvdSeries::resumed(path, 1).entries(),
            (std::vector<std::pair<double, std::string>>{{0, "a.vtp"}, {0.5, "b & c.vtp"}}));
  const auto message = [&](const std::string& entry) {
    const auto bad =
        folder.file("b.pvd", "<VTKFile type=\"Collection\"><Collection><DataSet timestep=\"0\" file=\"a\"/>" + entry +
                                 "</Collection></VTKFile>");
    const std::string text = message_of([&] { PvdSeries::resumed(bad, 1); });
    return text.substr(std::min(text.size(), text.find("b.pvd")));
  };
  EXPECT_EQ(message("<DataSet timestep=\"1s\" file=\"a\"/>"),
            "b.pvd: DataSet 1 (from 0): timestep: '1s' is not a number");
  EXPECT_EQ(message("<DataSet file=\"a\"/>"), "b.pvd: DataSet 1 (from 0) states no timestep");
  EXPECT_EQ(message("<DataSet timestep=\"1\"/>"), "b.pvd: DataSet 1 (from 0) states no file");
  EXPECT_EQ(message("<DataSet"), "b.pvd:1: a tag is not whole: cut short?");
  EXPECT_EQ(message("</Collection>"), "b.pvd:1: </Collection> closes no open tag");
}

/// One file for each time of a long run; and names in a tag, each of which VTK's parser looks for among the others.
TEST(PvdSeries, MayHaveManyFilesAndFewAttributes) {
  const TemporaryFolder folder;
  std::string files, attributes;
  for (int i = 0; i < 100'000; ++i) {
    files += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"a.vtp\"></DataSet>\n", i);
    attributes += fmt::format(" a{}=\"1\"", i);
  }
  const auto many =
      folder.file("a.pvd", "<VTKFile type=\"Collection\"><Collection>\n" + files + "</Collection></VTKFile>");
  EXPECT_EQ(PvdSeries::resumed(many, 1e9).entries().size(), 100'000U);
  const auto bad = folder.file("b.pvd", "<VTKFile" + attributes + "><Collection/></VTKFile>");
  EXPECT_EQ(message_of([&] { PvdSeries::resumed(bad, 1); }), bad.string() + ":1: a tag has more than 100 attributes");
  const auto tags = folder.file("c.pvd", "<VTKFile><Collection>" + files + files + "</Collection></VTKFile>");
  EXPECT_EQ(message_of([&] { PvdSeries::resumed(tags, 1); }), tags.string() + ":125000: has more than 250000 tags");
}

}  // namespace
}  // namespace tether
