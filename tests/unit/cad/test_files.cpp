// What files hold beside a sound solid, in every format: loose things, faces to sew, units, faults, damage.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>
#include <regex>
#include <sstream>

#include "cad/cad.h"
#include "core/error.h"
#include "support/files.h"
#include "support/shapes.h"

namespace polycube {
namespace {

using files::refusal;
using files::TestFile;
using std::numbers::pi;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string step_of(const std::string& brep) {
  const TestFile file("made.step");
  shapes::write_step(brep, file.path());
  return file.read();
}

/// A STEP file with more entities at the end of its data.
std::string with_entities(const std::string& step, const std::string& entities) { return replaced(step, "ENDSEC;\nEND-ISO", entities + "ENDSEC;\nEND-ISO"); }

std::string refusal_of_step(const std::string& text) {
  const TestFile file("part.step", text);
  return refusal([&] { CadModel::read(file.path()); });
}

TEST(Files, LooseThingsAreLeftOutAndCount) {
  const std::string box = shapes::box(1, 2, 3), loose = shapes::moved(shapes::loose_face(1), 0, 9, 9, 9);
  const CadModel after = CadModel::from_brep(shapes::compound(box, loose)), before = CadModel::from_brep(shapes::compound(loose, box));
  EXPECT_THAT(after.warnings(), ElementsAre("left out beside the solid: 1 loose face"));
  EXPECT_THAT(after.faces(), ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(before.warnings(), ElementsAre("left out beside the solid: 1 loose face"));
  EXPECT_THAT(before.faces(), ElementsAre(2, 3, 4, 5, 6, 7));
  EXPECT_THAT(before.edges(), ElementsAre(5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16));
  EXPECT_THAT(before.vertices(), ElementsAre(5, 6, 7, 8, 9, 10, 11, 12));
  EXPECT_NEAR(before.volume(), 6, 1e-12);
  EXPECT_NEAR(before.diagonal(), std::sqrt(14.0), 1e-12);
  EXPECT_EQ(before.euler_characteristic(), 2);
  for (int f = 1; f <= 6; ++f) {
    EXPECT_EQ(before.face(f + 1).area, after.face(f).area);
    EXPECT_EQ(before.face(f + 1).axis, after.face(f).axis);
    EXPECT_EQ(before.brep_order(2)[static_cast<std::size_t>(f) - 1], f + 1);
  }
  for (const int e : before.edges())
    for (const int f : before.edge(e).faces) EXPECT_THAT(before.face(f).edges, ::testing::Contains(e));
  // The pose that stages work in has the same numbers.
  const CadModel moved = before.transformed(Mat3::Identity(), Vec3(1, 2, 3), 2, 1e-9);
  EXPECT_EQ(moved.faces(), before.faces());
  EXPECT_NEAR(moved.volume(), 48, 1e-6);
}

TEST(Files, ASharedFaceIsTheSolidsOwn) {
  const std::string plate = shapes::plate_with_hole(10, 8, 2, 1.5);
  const CadModel plain = CadModel::from_brep(plate);
  for (int f = 1; f <= plain.face_count(); ++f) {
    const CadModel model = CadModel::from_brep(shapes::face_and_solid(plate, f));
    EXPECT_THAT(model.warnings(), IsEmpty());  // nothing is left out
    ASSERT_EQ(model.faces().size(), plain.faces().size());
    // It comes first in the whole shape, and looks out of the solid though the copy beside it looks in.
    EXPECT_EQ(model.face(1).area, plain.face(f).area);
    const Vec2 uv = model.project_to_face(1, plain.face(f).centre).uv;
    EXPECT_GT(model.face_normal(1, uv).dot(plain.face_normal(f, uv)), 0.999);
  }
}

TEST(Files, FacesAreSewn) {
  const std::string plate = shapes::plate_with_hole(10, 8, 2, 1.5);
  const CadModel whole = CadModel::from_brep(plate);
  const auto sews = [&](const std::string& brep) {
    const CadModel model = CadModel::from_brep(brep);
    EXPECT_THAT(model.warnings(), ElementsAre(HasSubstr("its 7 faces are sewn to one within 1e-07 mm")));
    EXPECT_THAT(model.faces(), ElementsAre(1, 2, 3, 4, 5, 6, 7));
    EXPECT_EQ(model.edges().size(), whole.edges().size());
    EXPECT_NEAR(model.volume(), whole.volume(), 1e-6);
    for (const int f : model.faces()) {
      EXPECT_EQ(model.face(f).kind, whole.face(f).kind);
      EXPECT_NEAR(model.face(f).area, whole.face(f).area, 1e-9);
      EXPECT_NEAR((model.face(f).centre - whole.face(f).centre).norm(), 0, 1e-9);
    }
    EXPECT_THAT(refusal([&] { CadModel::from_brep(brep, {.sew = false}); }), HasSubstr("not a solid"));
  };
  sews(shapes::taken_apart(plate));
  const CadModel hollow = CadModel::from_brep(shapes::taken_apart(shapes::hollow_box(10)));
  EXPECT_NEAR(hollow.volume(), CadModel::from_brep(shapes::hollow_box(10)).volume(), 1e-6);
  EXPECT_EQ(hollow.euler_characteristic(), 4);
  for (const std::string& round : {shapes::sphere(3), shapes::torus(5, 2), shapes::cone(2, 0, 3)})
    EXPECT_NEAR(CadModel::from_brep(shapes::taken_apart(round)).volume(), CadModel::from_brep(round).volume(), 1e-6);
  EXPECT_THAT(refusal([&] { CadModel::from_brep(shapes::compound(shapes::taken_apart(plate), shapes::taken_apart(shapes::moved(plate, 0, 50, 0, 0)))); }),
              HasSubstr("2 solids"));
  EXPECT_THAT(refusal([&] { CadModel::from_brep(shapes::open_box(1)); }), HasSubstr("open at Edge"));
  const CadModel beside = CadModel::from_brep(shapes::compound(shapes::moved(shapes::open_box(1), 0, 50, 0, 0), shapes::taken_apart(plate)));
  EXPECT_THAT(beside.warnings(), ElementsAre(HasSubstr("its 7 faces are sewn"), "left out beside the solid: 5 loose faces"));
  EXPECT_THAT(beside.faces(), ElementsAre(6, 7, 8, 9, 10, 11, 12));
}

TEST(Files, FacesAreSewnWithinTheFilesOwnTolerance) {
  const std::string apart = shapes::taken_apart(shapes::box(4, 5, 6), 3e-5);
  EXPECT_THAT(refusal([&] { CadModel::from_brep(apart); }), HasSubstr("open at Edge"));
  EXPECT_THAT(CadModel::from_brep(shapes::loosened(apart, 1e-4)).warnings(), ElementsAre(HasSubstr("within 0.0001 mm")));
  const std::string step = step_of(apart), declared = "LENGTH_MEASURE(1.E-07)";
  EXPECT_THAT(refusal_of_step(step), HasSubstr("open at Edge"));
  const TestFile file("loose.step", replaced(step, declared, "LENGTH_MEASURE(1.E-04)"));
  EXPECT_THAT(CadModel::read(file.path()).warnings(), ElementsAre(HasSubstr("within 0.0001 mm")));
}

TEST(Files, LengthsComeOutInMillimetres) {
  const std::string cylinder = shapes::cylinder(3, 5);
  for (const char* unit : {"MM", "INCH", "M"}) {
    const TestFile step("unit.stp"), iges("unit.igs"), solid("unit.iges");
    shapes::write_step(cylinder, step.path(), unit);
    shapes::write_iges(cylinder, iges.path(), unit);
    shapes::write_iges(cylinder, solid.path(), unit, true);
    for (const TestFile* file : {&step, &iges, &solid}) {
      const CadModel model = CadModel::read(file->path());
      EXPECT_NEAR(model.volume(), 45 * pi, 1e-4) << unit << " " << file->path();
      EXPECT_EQ(model.faces().size(), 3u);
    }
  }
  const TestFile step("unit.step");
  shapes::write_step(cylinder, step.path(), "MM");
  step.write(replaced(step.read(), "SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.CENTI.,.METRE.)"));
  EXPECT_NEAR(CadModel::read(step.path()).volume(), 45e3 * pi, 1e-3);
}

TEST(Files, FaultsBesideTheSolidDoNoHarm) {
  const std::string step = step_of(shapes::box(1, 2, 3));
  const auto reads = [](const std::string& text) {
    const TestFile file("faulty.step", text);
    const CadModel model = CadModel::read(file.path());
    EXPECT_NEAR(model.volume(), 6, 1e-12);
    EXPECT_THAT(model.faces(), ElementsAre(1, 2, 3, 4, 5, 6));
    return model.warnings();
  };
  const std::string name = "ADVANCED_BREP_SHAPE_REPRESENTATION(''";
  EXPECT_THAT(reads(replaced(step, name, "ADVANCED_BREP_SHAPE_REPRESENTATION($")), IsEmpty());
  EXPECT_THAT(reads(replaced(step, "MANIFOLD_SOLID_BREP(''", "MANIFOLD_SOLID_BREP($")), IsEmpty());
  EXPECT_THAT(reads(replaced(step, "ADVANCED_FACE(''", "ADVANCED_FACE($")), IsEmpty());
  // An annotation that no reader knows, in a representation of its own and in that of the solid.
  EXPECT_THAT(reads(with_entities(step, "#9000 = LEADER_DIRECTED_CALLOUT('',(#11));\n#9001 = SHAPE_REPRESENTATION('',(#9000),$);\n")),
              ElementsAre(HasSubstr("the solid is not built on")));
  EXPECT_THAT(reads(with_entities(replaced(step, name + ",(", name + ",(#9000,"), "#9000 = LEADER_DIRECTED_CALLOUT('',(#11));\n")), IsEmpty());
  // Construction whose curve cannot be read, and a line that is no entity.
  EXPECT_THAT(reads(with_entities(replaced(step, name + ",(", name + ",(#9002,"), "#9002 = GEOMETRIC_CURVE_SET('',(#9003));\n#9003 = LINE('',#9004,#9005);\n")),
              ElementsAre(HasSubstr("the solid is not built on")));
  EXPECT_THAT(reads(with_entities(step, "#9006 = PRODUCT 'x');\n")), ElementsAre(HasSubstr("the solid is not built on")));
}

TEST(Files, FaultsOfTheSolidAreRefused) {
  const std::string step = step_of(shapes::box(1, 2, 3));
  EXPECT_THAT(refusal_of_step(step), "accepted");
  for (const auto& [good, bad] : {std::pair{"= PLANE(''", "= PLAIN(''"}, std::pair{"ADVANCED_FACE('',(", "ADVANCED_FACE('',(#9999,"},
                                  std::pair{"SI_UNIT(.MILLI.,.METRE.)", "SI_UNIT(.MYLLI.,.METRE.)"}, std::pair{"CLOSED_SHELL('',(", "CLOSED_SHELL('',(#1,"},
                                  std::pair{"CARTESIAN_POINT('',(1.,2.,3.", "CARTESIAN_POINT('',(1.,x,3."}}) {
    const std::string line = refusal_of_step(replaced(step, good, bad));
    EXPECT_THAT(line, HasSubstr("damaged at entity #")) << bad;
    EXPECT_EQ(line.find("##"), std::string::npos) << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
  }
  for (const double share : {0.3, 0.6, 0.9, 0.99}) {
    const std::string cut = step.substr(0, static_cast<std::size_t>(share * static_cast<double>(step.size())));
    EXPECT_NE(refusal_of_step(cut), "accepted") << share;
  }
}

/// Without the date and the running numbers that OCCT's writers put in.
std::string undated(const std::string& made) {
  const std::string text = std::regex_replace(made, std::regex("'Post [0-9]+'|'[^']*-made\\.step'"), "'Part'");
  const std::string dated = std::regex_replace(text, std::regex("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}|15H[0-9]{8}\\.[0-9]{6}"), "15H20000101.000000");
  return std::regex_replace(dated, std::regex("translator [0-9]+\\.[0-9]+ [0-9.]+"), "translator");
}

enum Ending { kModel = 0, kRefusal = 1, kOther = 2 };

/// How reading ends in a process of its own, as programs read: after a fault in OCCT nothing more is to be read.
Ending ending(const std::string& path) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit seconds{60, 60};
    setrlimit(RLIMIT_CPU, &seconds);
    Ending result = kModel;
    try {
      CadModel::read(path);
    } catch (const InvalidInput& error) {
      result = std::string(error.what()).find('\n') == std::string::npos ? kRefusal : kOther;
    } catch (...) {
      result = kOther;
    }
    _exit(result);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? static_cast<Ending>(WEXITSTATUS(status)) : kOther;
}

TEST(Files, WhatIsBuiltOnItselfIsRefused) {
  const std::string plate = shapes::plate_with_hole(10, 8, 2, 1.5);
  const TestFile step("cycle.step"), iges("cycle.igs");
  shapes::write_step(plate, step.path());
  const std::string text = step.read();
  std::smatch edge, face;
  ASSERT_TRUE(std::regex_search(text, edge, std::regex("(#[0-9]+) = ORIENTED_EDGE\\('',\\*,\\*,(#[0-9]+)")));
  ASSERT_TRUE(std::regex_search(text, face, std::regex("(#[0-9]+) = ADVANCED_FACE\\('',\\((#[0-9]+)")));
  for (const std::smatch* found : {&edge, &face}) {
    const std::string itself = replaced((*found)[0], (*found)[2].str(), (*found)[1].str());
    step.write(replaced(text, (*found)[0], itself));
    ASSERT_EQ(ending(step.path()), kRefusal);
    EXPECT_THAT(refusal([&] { CadModel::read(step.path()); }), HasSubstr("is built on itself"));
  }
  shapes::write_iges(plate, iges.path());
  std::string lines = iges.read();
  std::smatch curve;
  // A composite curve: "102,4,11,13,15,17;" with its own number, and those of its parts.
  ASSERT_TRUE(std::regex_search(lines, curve, std::regex("102,4,([0-9]+)(,[^;]*; *) ([0-9]+)P")));
  std::string itself = std::to_string(std::stoi(curve[3]));
  itself.insert(0, curve[1].str().size() - itself.size(), ' ');
  lines = replaced(lines, curve[0].str(), "102,4," + itself + curve[2].str() + " " + curve[3].str() + "P");
  iges.write(lines);
  ASSERT_EQ(ending(iges.path()), kRefusal);
  EXPECT_THAT(refusal([&] { CadModel::read(iges.path()); }), HasSubstr("is built on itself"));
}

TEST(Files, TwoEntitiesOfOneNumberAreRefused) {
  const std::string step = step_of(shapes::box(1, 2, 3)), again = "#7 = DIRECTION('',(0.,0.,1.));\n";
  EXPECT_THAT(refusal_of_step(with_entities(step, again)), HasSubstr("two entities #7"));
  EXPECT_THAT(refusal_of_step(with_entities(step, "/* " + again + " */")), "accepted");
  EXPECT_THAT(refusal_of_step(replaced(step, "PRODUCT('", "PRODUCT('#7 = 7 ")), "accepted");
  // A quote too many does not turn the rest of the file inside out.
  EXPECT_THAT(refusal_of_step(with_entities(replaced(step, "PRODUCT('", "PRODUCT('it's "), again)), HasSubstr("two entities #7"));
  EXPECT_THAT(refusal_of_step(replaced(step, "PRODUCT('", "PRODUCT('it's #7 = 7 ")), "accepted");
}

TEST(Files, AByteOrderMarkIsPassedOver) { EXPECT_THAT(refusal_of_step("\xEF\xBB\xBF" + step_of(shapes::box(1, 2, 3))), "accepted"); }

TEST(Files, NumbersOutOfRangeAreRefused) {
  const std::string plate = shapes::plate_with_hole(10, 8, 2, 1.5);
  const TestFile step("range.step"), iges("range.igs");
  shapes::write_step(plate, step.path());
  shapes::write_iges(plate, iges.path());
  for (const auto& [file, pattern] : {std::pair{&step, "LINE\\([^;]*;\\s*#[0-9]+ = CARTESIAN_POINT\\('',\\(0\\."}, std::pair{&iges, "\n110,0\\."}}) {
    const std::string text = file->read();
    std::smatch found;
    ASSERT_TRUE(std::regex_search(text, found, std::regex(pattern)));
    std::string changed = found[0].str();
    // In IGES at the cost of the number after it: columns count.
    changed.replace(changed.size() - 2, 2, "1.E200");
    file->write(file == &iges ? replaced(text, found[0].str() + text.substr(static_cast<std::size_t>(found.position() + found.length()), 4), changed)
                              : replaced(text, found[0], changed));
    ASSERT_EQ(ending(file->path()), kRefusal);
    EXPECT_THAT(refusal([&] { CadModel::read(file->path()); }), HasSubstr("out of range, 1.E200"));
  }
  // Not in a name.
  step.write(replaced(step_of(plate), "PRODUCT('", "PRODUCT('1.E200 "));
  EXPECT_EQ(refusal([&] { CadModel::read(step.path()); }), "accepted");
}

TEST(Files, AnyDamageEndsInAModelOrARefusal) {
  const std::string plate = shapes::plate_with_hole(10, 8, 2, 1.5), loft = shapes::loft(4, 5);
  const TestFile iges("made.igs");
  shapes::write_iges(plate, iges.path());
  const std::vector<std::pair<std::string, std::string>> seeds{{".step", undated(step_of(plate))},
                                                               {".step", undated(step_of(shapes::taken_apart(loft)))},
                                                               {".brep", plate},
                                                               {".brep", shapes::compound(shapes::loose_face(1), loft)},
                                                               {".igs", undated(iges.read())}};
  std::mt19937 chance(12);
  const auto below = [&](std::size_t bound) { return static_cast<std::size_t>(chance() % bound); };
  const std::string letters = "0123456789 ,;#()$*'-.E";
  std::array<int, 2> endings{};
  for (const auto& [suffix, whole] : seeds) {
    const TestFile file("damaged" + suffix);
    for (int round = 0; round < 60; ++round) {
      std::string text = whole;
      const std::size_t at = below(text.size()), from = below(text.size()), length = below(200);
      switch (round % 5) {
        case 0:
          text.resize(at);
          break;
        case 1:
          text[at] = static_cast<char>(text[at] ^ (1 << (length % 8)));
          break;
        case 2:
          for (std::size_t k = 0; k <= length % 20; ++k) text[below(text.size())] = letters[below(letters.size())];
          break;
        case 3:
          text.erase(at, length);
          break;
        default:
          text.insert(at, whole.substr(from, length));
      }
      file.write(text);
      const Ending end = ending(file.path());
      EXPECT_NE(end, kOther) << suffix << ", round " << round;
      if (end != kOther) ++endings[end];
    }
  }
  EXPECT_GT(endings[kModel], 20);
  EXPECT_GT(endings[kRefusal], 100);
}

TEST(Files, ReadingStopsWhenTold) {
  const std::string plate = shapes::plate_with_hole(10, 8, 2, 1.5);
  const TestFile step("stop.step"), iges("stop.igs"), brep("stop.brep", plate);
  shapes::write_step(plate, step.path());
  shapes::write_iges(shapes::taken_apart(plate), iges.path());
  for (const TestFile* file : {&step, &iges, &brep}) {
    int asked = 0;
    Monitor counting;
    counting.cancel_requested = [&] { return ++asked < 0; };
    CadModel::read(file->path(), {}, counting);
    EXPECT_GT(asked, 5);
    // Whichever question is answered with yes: reading ends as cancelled, never as a refusal or with half a model.
    for (int yes = 1; yes <= asked; yes += 1 + asked / 20) {
      int count = 0;
      Monitor monitor;
      monitor.cancel_requested = [&] { return ++count >= yes; };
      EXPECT_THROW(CadModel::read(file->path(), {}, monitor), Cancelled) << file->path() << " " << yes << " of " << asked;
    }
  }
}

}  // namespace
}  // namespace polycube
