#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/io/temporary_folder.hpp"
#include "tests/study/bent_tube.hpp"
#include "vessel/study/build_surface.hpp"

/// Surfaces that are wrong in one way each: repaired with a note, or refused with the place.
namespace tether {
namespace {

using testing::bent_tube;
using Spoil = std::function<void(RawSurface&)>;

StudyCase study_of(const std::filesystem::path& file) {
  StudyCase study;
  study.name = "bad";
  study.surface = {file, "cm"};
  study.openings.resize(2);
  study.openings[0] = {"in", {}}, study.openings[0].second.near = {4, 0, 0};
  study.openings[1] = {"out", {}}, study.openings[1].second.near = {-2, 3.46, 0};
  study.inlet = "in";
  study.edges.longest = 0.25;
  return study;
}

StudyCase spoilt(const std::string& name, const Spoil& spoil) {
  RawSurface surface = bent_tube();
  spoil(surface);
  const auto file = test_folder() / (name + ".stl");
  testing::write_stl(file, surface);
  return study_of(file);
}

int add_point(RawSurface& s, const Vec3& x) {
  s.points.conservativeResize(3, s.points.cols() + 1);
  s.points.col(s.points.cols() - 1) = x;
  return static_cast<int>(s.points.cols()) - 1;
}
void add(RawSurface& s, const Triangle& t) {
  s.triangles.push_back(t);
  s.face_id.push_back(0);
}
void add_copy(RawSurface& s, const Vec3& shift, double scale) {
  const RawSurface one = bent_tube();
  const auto first = static_cast<int>(s.points.cols());
  s.points.conservativeResize(3, first + one.points.cols());
  s.points.rightCols(one.points.cols()) = (scale * one.points).colwise() + shift;
  for (const Triangle& t : one.triangles) add(s, {t[0] + first, t[1] + first, t[2] + first});
}
void remove(RawSurface& s, std::size_t first, std::size_t count) {
  const auto at = static_cast<std::ptrdiff_t>(first), end = at + static_cast<std::ptrdiff_t>(count);
  s.triangles.erase(s.triangles.begin() + at, s.triangles.begin() + end);
  s.face_id.resize(s.triangles.size());
}

struct Mended {
  const char* name;
  Spoil spoil;
  RepairKind note;
};

class MendedSurface : public ::testing::TestWithParam<Mended> {};

TEST_P(MendedSurface, IsAsTheGoodOneAndSaysWhatWasDone) {
  const BuiltSurface built = build_surface(spoilt(GetParam().name, GetParam().spoil));
  EXPECT_NEAR(built.summary.surface.volume, testing::tube_volume(),
              0.02 * testing::tube_volume());  // 32 corners: -0.6 %
  EXPECT_EQ(built.surface.openings.size(), 2U);
  const auto& notes = built.summary.repairs;
  const auto note = std::find_if(notes.begin(), notes.end(), [](const auto& n) { return n.kind == GetParam().note; });
  ASSERT_NE(note, notes.end()) << text_of(built.summary);
  EXPECT_GT(note->count, 0);
  EXPECT_GT(note->place.norm(), 0);
}

constexpr std::size_t mid = 2 * 32 * 20;  // a triangle half way along

const Mended mended[] = {
    {"hole_of_one", [](RawSurface& s) { remove(s, mid, 1); }, RepairKind::holes_filled},
    {"hole_of_four", [](RawSurface& s) { remove(s, mid, 4); }, RepairKind::holes_filled},
    {"two_holes", [](RawSurface& s) { remove(s, mid, 2), remove(s, mid - 400, 2); }, RepairKind::holes_filled},
    {"one_flipped", [](RawSurface& s) { std::swap(s.triangles[mid][0], s.triangles[mid][1]); },
     RepairKind::triangles_turned},
    {"half_flipped",
     [](RawSurface& s) {
       for (std::size_t t = 0; t < mid; ++t) std::swap(s.triangles[t][0], s.triangles[t][1]);
     },
     RepairKind::triangles_turned},
    {"inside_out",
     [](RawSurface& s) {
       for (Triangle& t : s.triangles) std::swap(t[0], t[1]);
     },
     RepairKind::triangles_turned},
    {"twice",
     [](RawSurface& s) {
       for (std::size_t t = mid; t < mid + 9; ++t) add(s, s.triangles[t]);
     },
     RepairKind::triangles_dropped},
    {"twice_and_turned",
     [](RawSurface& s) {
       const Triangle t = s.triangles[mid];
       add(s, {t[1], t[0], t[2]});
     },
     RepairKind::triangles_dropped},
    {"points_apart",
     [](RawSurface& s) {
       Triangle& t = s.triangles[mid];
       t[0] = add_point(s, s.points.col(t[0]) + Vec3::Constant(2e-6));
     },
     RepairKind::points_merged},
    {"crumb",
     [](RawSurface& s) {
       add_copy(s, {0, 0, 3}, 0.1);
     },
     RepairKind::pieces_dropped},
    {"second_vessel",
     [](RawSurface& s) {
       add_copy(s, {0, 0, 3}, 0.6);
     },
     RepairKind::pieces_dropped},
    {"fin",
     [](RawSurface& s) {
       const Triangle t = s.triangles[mid];
       add(s, {t[0], t[1], add_point(s, 1.1 * s.points.col(t[2]))});
     },
     RepairKind::fins_dropped},
    {"needle",
     [](RawSurface& s) {
       const Triangle t = s.triangles[mid];  // a point hardly off an edge: two needles and a cap
       const Vec3 x = 0.999 * s.points.col(t[0]) + 0.0005 * (s.points.col(t[1]) + s.points.col(t[2]));
       const int n = add_point(s, x);
       s.triangles[mid] = {t[0], t[1], n};
       add(s, {t[1], t[2], n}), add(s, {t[2], t[0], n});
     },
     RepairKind::slivers_removed},
    {"spike_through_the_wall",
     [](RawSurface& s) {
       const int n = s.triangles[mid][0];
       s.points.col(n) += 2.3 * (testing::tube_middle(20.0 / 44) - s.points.col(n));
     },
     RepairKind::crossings_removed},
    {"wavy_rim",
     [](RawSurface& s) {
       for (int i = 0; i < 32; ++i) s.points(1, i) -= 0.3 * std::pow(std::sin(i * std::numbers::pi / 16), 2);
     },
     RepairKind::rims_cut},
    {"rim_hardly_off_its_plane",
     [](RawSurface& s) {
       for (int i = 0; i < 32; ++i) s.points(1, i) -= 0.01 * std::sin(i * std::numbers::pi / 8);
     },
     RepairKind::rims_flattened},
    {"point_that_only_touches",
     [](RawSurface& s) {
       const Vec3 x = s.points.col(s.triangles[mid][0]);
       const int n = s.triangles[mid][0];
       const Vec3 out = (x - testing::tube_middle(20.0 / 44)).normalized();
       const int a = add_point(s, x + 0.1 * out), b = add_point(s, x + 0.1 * out + Vec3(0, 0, 0.1)),
                 c = add_point(s, x + 0.15 * out + Vec3(0.05, 0, 0));
       add(s, {n, a, b}), add(s, {n, b, c}), add(s, {n, c, a}), add(s, {a, c, b});
     },
     RepairKind::pieces_dropped},
};
INSTANTIATE_TEST_SUITE_P(BadSurface, MendedSurface, ::testing::ValuesIn(mended),
                         [](const auto& info) { return std::string(info.param.name); });

/// The message of what is refused; whether it has places goes to `placed`.
std::string refusal(const StudyCase& study, bool& placed) {
  placed = false;
  try {
    build_surface(study);
  } catch (const PlacedError& error) {
    placed = !error.places.empty();
    return error.what();
  } catch (const InputError& error) {
    return error.what();
  }
  return "was not refused";
}

struct Refused {
  const char* name;
  Spoil spoil;
  const char* said;
};
class RefusedSurface : public ::testing::TestWithParam<Refused> {};

TEST_P(RefusedSurface, SaysWhatAndWhere) {
  bool placed = false;
  const std::string message = refusal(spoilt(GetParam().name, GetParam().spoil), placed);
  EXPECT_NE(message.find(GetParam().said), std::string::npos) << message;
  EXPECT_TRUE(placed) << message;
}

const Refused refused[] = {
    {"in_two_parts", [](RawSurface& s) { remove(s, mid, 64 * 4); }, "no opening near"},
    {"large_hole",
     [](RawSurface& s) {
       for (int row = 3; row >= 0; --row) remove(s, mid + static_cast<std::size_t>(64 * row), 14);
     },
     "is not among the study's openings"},
    {"touching_along_an_edge",
     [](RawSurface& s) {  // another tube has an edge of it, too
       const Triangle t = s.triangles[mid];
       add_copy(s, {0, 0, 3}, 1);
       const int first = static_cast<int>(s.points.cols()) / 2;
       s.points.col(first + t[0]) = s.points.col(t[0]), s.points.col(first + t[1]) = s.points.col(t[1]);
     },
     "parts of the surface touch"},
    {"crushed",
     [](RawSurface& s) {
       for (int j = 18; j < 26; ++j)
         for (int i = 0; i < 32; ++i) {
           const Vec3 middle = testing::tube_middle(j / 44.0);
           s.points.col(32 * j + i) = middle - 0.6 * (s.points.col(32 * j + i) - middle);
         }
     },
     "cross"},
    {"deep_rim",
     [](RawSurface& s) {
       for (int i = 0; i < 32; ++i) s.points(1, i) -= 3 * std::pow(std::sin(i * std::numbers::pi / 16), 2);
     },
     "as deep as wide"},
};
INSTANTIATE_TEST_SUITE_P(BadSurface, RefusedSurface, ::testing::ValuesIn(refused),
                         [](const auto& info) { return std::string(info.param.name); });

/// In the plane of its rim, with a third side that what closes the rim has, too.
TEST(BadSurface, ATriangleThatSticksOutOfARimIsLeftOut) {
  const BuiltSurface built = build_surface(spoilt("sticks_out", [](RawSurface& s) {
    const Vec3 middle = testing::tube_middle(0), beside = (s.points.col(0) + s.points.col(1)) / 2;
    add(s, {0, 1, add_point(s, middle + 1.05 * (beside - middle))});
  }));
  EXPECT_NEAR(built.summary.surface.volume, testing::tube_volume(), 0.02 * testing::tube_volume());
  EXPECT_EQ(built.surface.openings.size(), 2U);
}

TEST(BadSurface, AMoebiusStripIsRefused) {
  bool placed = false;
  EXPECT_NE(refusal(spoilt("moebius",
                           [](RawSurface& s) {
                             s = {Points(3, 0), {}, {}};
                             for (int i = 0; i < 20; ++i)
                               for (const double w : {-0.3, 0.3}) {
                                 const double a = 2 * std::numbers::pi * i / 20;
                                 add_point(s, {(2 + w * std::cos(a / 2)) * std::cos(a),
                                               (2 + w * std::cos(a / 2)) * std::sin(a), w * std::sin(a / 2)});
                               }
                             for (int i = 0; i < 20; ++i) {
                               const int a = 2 * i, b = a + 1, c = i < 19 ? a + 2 : 1, d = i < 19 ? a + 3 : 0;
                               add(s, {a, c, b}), add(s, {b, c, d});
                             }
                           }),
                    placed)
                .find("one side"),
            std::string::npos);
  EXPECT_TRUE(placed);
}

TEST(BadSurface, AWrongUnitIsRefusedWithWhatWasMeasured) {
  bool placed = false;
  const std::string wide = refusal(spoilt("ten_times_too_wide", [](RawSurface& s) { s.points *= 10; }), placed);
  EXPECT_NE(wide.find("cm wide in cm, which no vessel is; did you mean mm"), std::string::npos) << wide;
  StudyCase study = spoilt("ten_times_too_narrow", [](RawSurface&) {});
  study.surface->unit = "mm";
  const std::string narrow = refusal(study, placed);
  EXPECT_NE(narrow.find("did you mean cm"), std::string::npos) << narrow;
  study.surface->any_size = true;
  study.openings[0].second.near = {0.4, 0, 0}, study.openings[1].second.near = {-0.2, 0.346, 0};
  study.edges.longest = 0.025, study.centreline_spacing = 0.02;
  EXPECT_NEAR(build_surface(study).summary.surface.volume, 1e-3 * testing::tube_volume(),
              2e-5 * testing::tube_volume());
}

TEST(BadSurface, FilesThatHoldNoSurfaceAreRefused) {
  bool placed = false;
  const auto said = [&](const char* name, const std::string& content) {
    std::ofstream(test_folder() / name) << content;
    return refusal(study_of(test_folder() / name), placed);
  };
  EXPECT_NE(said("empty.stl", "").find("empty.stl"), std::string::npos);
  EXPECT_NE(said("no_triangle.stl", "solid s\nendsolid s\n").find("holds no triangle"), std::string::npos);
  EXPECT_NE(said("cut.stl", "solid s\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n")
                .find("corners instead of three"),
            std::string::npos);
  EXPECT_NE(said("words.ply", "no surface at all").find("words.ply"), std::string::npos);
  EXPECT_NE(said("node.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n").find("node.obj:3: names node 9"), std::string::npos);
  EXPECT_NE(said("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").find("is flat"), std::string::npos);
}

struct Length {
  const char* name;
  void (*set)(StudyCase&);
  const char* said;
};
void PrintTo(const Length& length, std::ostream* out) {
  *out << length.name;
}
class RefusedLength : public ::testing::TestWithParam<Length> {};

/// A length that leaves nothing, or makes more than can be had.
TEST_P(RefusedLength, IsToldWithItsField) {
  StudyCase study = spoilt(std::string("length_") + GetParam().name, [](RawSurface&) {});
  GetParam().set(study);
  bool placed = false;
  EXPECT_EQ(refusal(study, placed), GetParam().said);
}

const Length lengths[] = {
    {"merge", [](StudyCase& s) { s.repair.merge = 20, s.lines["repair.merge"] = "study.yaml:3"; },
     "study.yaml:3: repair.merge: 20 cm: leaves no triangle of the surface: must be shorter than its edges"},
    {"merge_of_a_few", [](StudyCase& s) { s.repair.merge = 5; },
     "repair.merge: 5 cm: leaves no triangle of the surface: must be shorter than its edges"},
    {"longest", [](StudyCase& s) { s.edges.longest = 1e-4; },
     "edges.longest: 0.0001 cm: would make 1.36e+10 triangles: must make at most 2e+06"},
    {"longest_of_nothing", [](StudyCase& s) { s.edges.longest = 1e-300; },
     "edges.longest: 1e-300 cm: would make countless triangles: must make at most 2e+06"},
    {"shortest", [](StudyCase& s) { s.edges.per_radius = 0.5, s.edges.shortest = 1e-4; },
     "edges.shortest: 0.0001 cm: would make 1.36e+10 triangles: must make at most 2e+06"},
    {"spacing", [](StudyCase& s) { s.centreline_spacing = 1e-7; },
     "centreline_spacing: 1e-07 cm: would make a line of 6.93e+07 points or more: must make at most 5000"},
    {"trim", [](StudyCase& s) { s.openings[1].second.trim = 9.9, s.lines["openings.out.trim"] = "study.yaml:5"; },
     "study.yaml:5: openings.out.trim: 9.9 cm: its vessel is 8.36 cm long: must be shorter"},
    {"order",
     [](StudyCase& s) {
       s.openings[1].second.near.clear(), s.openings[1].second.order = 3, s.lines["openings.out"] = "study.yaml:5";
     },
     "study.yaml:5: openings.out.order: 3: the surface has 2 openings"},
    {"edges_longer_than_the_vessel_is_wide",
     [](StudyCase& s) { s.edges.longest = 6, s.lines["edges"] = "study.yaml:6"; },
     "study.yaml:6: edges: the new triangles change the lumen's volume by -88 %: must be at most 10 %: choose shorter "
     "edges"},
    {"edges_of_a_silent_file", [](StudyCase& s) { s.edges.longest = 6, s.path = "study.yaml"; },
     "study.yaml: edges: the new triangles change the lumen's volume by -88 %: must be at most 10 %: choose shorter "
     "edges"},
    {"inner_edge", [](StudyCase& s) { s.model.emplace().longest_edge = 1e-3; },
     "model.longest_edge: 0.001 cm: would make 2.22e+11 tetrahedra: must make at most 2e+07"},
};
INSTANTIATE_TEST_SUITE_P(BadSurface, RefusedLength, ::testing::ValuesIn(lengths),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace tether
