#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "core/error.h"
#include "core/options.h"

namespace polycube {
namespace {

using testing::HasSubstr;
using Given = std::vector<std::pair<std::string, std::string>>;

std::string complaint(const Given& given) {
  try {
    parse_options(given);
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "";
}

TEST(Options, NumbersOutOfRangeAreToldAsThat) {
  for (const auto& [name, text] : {std::pair{"hexes", "99999999999999"}, std::pair{"size", "1e400"}}) {
    std::string told;
    try {
      parse_options({{name, text}});
    } catch (const InvalidInput& error) {
      told = error.what();
    }
    EXPECT_EQ(told, "--" + std::string(name) + ": '" + text + "' is out of range");
  }
}

TEST(Options, DefaultsAreValidAndReadBack) {
  const MeshOptions defaults;
  EXPECT_NO_THROW(check(defaults));
  for (const OptionSpec& option : option_table()) {
    if (option.zero_is_unset || option_text(defaults, option).empty()) continue;
    EXPECT_EQ(option_text(parse_options({{option.name, option_text(defaults, option)}}), option), option_text(defaults, option)) << option.name;
  }
}

TEST(Options, EveryOptionIsDescribed) {
  EXPECT_GE(option_table().size(), 11u);
  for (const OptionSpec& option : option_table()) {
    EXPECT_FALSE(option.meaning.empty()) << option.name;
    const std::string type = option_type(option);
    if (type == "double" || type == "int") {
      EXPECT_LT(option.min, option.max) << option.name;
    }
  }
}

TEST(Options, ReadsEveryType) {
  const MeshOptions o = parse_options({{"size", "2.5"}, {"order", "1"}, {"element_type", "C3D8I"}, {"labels", "Face7=-Z,Face3=+X"}});
  EXPECT_EQ(o.size, 2.5);
  EXPECT_EQ(o.order, 1);
  EXPECT_EQ(effective_element_type(o), "C3D8I");
  EXPECT_EQ(o.labels, (FaceLabels{{3, 0}, {7, 5}}));
  EXPECT_TRUE(parse_options({{"coarsest", "True"}}).coarsest);
}

TEST(Options, ElementTypeBringsItsOrder) {
  EXPECT_EQ(parse_options({{"element_type", "C3D8I"}}).order, 1);
  EXPECT_EQ(parse_options({{"element_type", "C3D20R"}}).order, 2);
  EXPECT_THAT(complaint({{"element_type", "C3D8I"}, {"order", "2"}}), HasSubstr("order 1"));
}

TEST(Options, RefusesBadSizesInOneLine) {
  for (const char* bad : {"0", "-1", "nan", "inf", "", "abc", "1mm", "1e400", "-0"}) {
    const std::string text = complaint({{"size", bad}});
    EXPECT_THAT(text, HasSubstr("--size")) << bad;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

TEST(Options, RefusesOthers) {
  EXPECT_THAT(complaint({{"order", "3"}}), HasSubstr("--order"));
  EXPECT_THAT(complaint({{"hexes", "1.5"}}), HasSubstr("--hexes"));
  EXPECT_THAT(complaint({{"element_type", "C3D10"}}), HasSubstr("C3D20R"));
  EXPECT_THAT(complaint({{"time_limit", "0"}}), HasSubstr("--time-limit"));
  EXPECT_THAT(complaint({{"size", "1"}, {"hexes", "10"}}), HasSubstr("only one"));
  EXPECT_THAT(complaint({{"colour", "red"}}), HasSubstr("colour"));
  for (const char* bad : {"Face=+X", "Face1", "Face0=+X", "Edge1=+X", "Face1=X", "Face1=+X,Face1=-X", "Face1x=+X"})
    EXPECT_THAT(complaint({{"labels", bad}}), HasSubstr("--label:")) << bad;
}

TEST(Options, FrameIsReadNormalisedAndSquared) {
  const MeshOptions o = parse_options({{"frame", "2,0,0/0.001,-5,0"}});
  ASSERT_EQ(o.frame.size(), 2u);
  const Mat3 frame = frame_of(o.frame);
  EXPECT_LT((frame * frame.transpose() - Mat3::Identity()).norm(), 1e-15);
  EXPECT_NEAR(frame.determinant(), 1, 1e-15);
  EXPECT_EQ(Vec3(frame.row(0)), Vec3(1, 0, 0));
  EXPECT_EQ(Vec3(frame.row(1)), Vec3(0, -1, 0));
  for (const OptionSpec& option : option_table()) {
    if (option.name == "frame") {
      EXPECT_EQ(option_text(o, option), "2,0,0/0.001,-5,0");
    }
  }
  EXPECT_TRUE(parse_options({{"frame", ""}}).frame.empty());
  EXPECT_EQ(parse_options({{"frame", "1, 0, -1e200/0,+1,0"}}).frame[0][2], -1e200);
}

TEST(Options, RefusesBadFramesInOneLine) {
  for (const char* bad : {"1,0,0", "1,0,0/0,1,0/0,0,1", "1,0/0,1,0", "1,0,0,0/0,1,0", "1,0,0;0,1,0", "0,0,0/0,1,0", "1,0,0/2,0,0", "1,0,0/1,1,0", "a,b,c/0,1,0",
                          "1,0,nan/0,1,0", "1,0,inf/0,1,0", "1,,0/0,1,0", "/", "X"}) {
    const std::string text = complaint({{"frame", bad}});
    EXPECT_THAT(text, HasSubstr("--frame: ")) << bad;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
  EXPECT_THAT(complaint({{"frame", "1,0,0/1,1,0"}}), HasSubstr("not 45 degrees apart"));
}

TEST(Options, DivisionsAndSizesReadBackAsTheSame) {
  const MeshOptions o = parse_options({{"min_layers", "3"}, {"divisions", "Edge4=6, Face5-Face1=3..,Edge7=..4,Edge8=2..5"}, {"sizes", "Face3=0.5,X=2"}});
  EXPECT_EQ(o.min_layers, 3);
  ASSERT_EQ(o.divisions.size(), 4u);
  EXPECT_EQ(o.divisions[1].faces, (std::array{1, 5}));
  EXPECT_EQ(o.divisions[1].at_least, 3);
  EXPECT_EQ(o.divisions[1].at_most, Division::kNoMaximum);
  EXPECT_EQ(o.divisions[2].at_most, 4);
  std::vector<std::pair<std::string, std::string>> texts;
  for (const OptionSpec& option : option_table()) {
    if (option.name == "divisions" || option.name == "sizes") texts.emplace_back(option.name, option_text(o, option));
  }
  EXPECT_EQ(texts[0].second, "Edge4=6,Face1-Face5=3..,Edge7=..4,Edge8=2..5");
  const MeshOptions again = parse_options(texts);
  EXPECT_EQ(again.divisions, o.divisions);
  EXPECT_EQ(again.sizes, o.sizes);
}

TEST(Options, RefusesBadDivisionsAndSizes) {
  for (const char* bad :
       {"Edge4", "Edge=3", "Edge0=3", "Edge4=", "Edge4=0", "Edge4=..", "Edge4=5..2", "Edge4=1.5", "Face1=3", "Face1-Edge2=3", "Edge4=9999999"})
    EXPECT_THAT(complaint({{"divisions", bad}}), HasSubstr("--divisions")) << bad;
  for (const char* bad : {"Face1", "Face0=1", "Edge1=1", "W=1", "X=0", "X=-1", "X=nan", "X=1,X=2", "X=1mm"})
    EXPECT_THAT(complaint({{"sizes", bad}}), HasSubstr("--sizes")) << bad;
  for (const char* comma : {"Face3=0,5", "X=2,Face3=1,25", "Face3=0,5,X=2"}) EXPECT_THAT(complaint({{"sizes", comma}}), HasSubstr("has a comma")) << comma;
  EXPECT_THAT(complaint({{"min_layers", "0"}}), HasSubstr("--min-layers"));
}

TEST(Options, FacesToKeepAreReadSortedAndOnce) {
  const MeshOptions o = parse_options({{"keep_faces", "Face7, Face3,Face7"}});
  EXPECT_EQ(o.keep_faces, (FaceList{3, 7}));
  for (const OptionSpec& option : option_table()) {
    if (option.name == "keep_faces") {
      EXPECT_EQ(option_text(o, option), "Face3,Face7");
    }
  }
  for (const char* bad : {"Edge1", "Face", "Face0", "Face1x", "3", "Face1,,Face2", "Face1-Face2"})
    EXPECT_THAT(complaint({{"keep_faces", bad}}), HasSubstr("--keep-faces")) << bad;
}

TEST(Options, LocalRefinement) {
  const MeshOptions options = parse_options({{"refine", "Face7=2, Edge3=1,Vertex2=6,Solid1=1"}});
  const LocalRefinements wanted{{{2, 7}, 2}, {{1, 3}, 1}, {{0, 2}, 6}, {{3, 1}, 1}};
  EXPECT_EQ(options.refine, wanted);
  for (const OptionSpec& option : option_table()) {
    if (option.name != "refine") continue;
    EXPECT_EQ(parse_options({{"refine", option_text(options, option)}}).refine, wanted);
  }
  EXPECT_THAT(complaint({{"refine", "Face1=0"}}), HasSubstr("from 1 to 6, not 0"));
  EXPECT_THAT(complaint({{"refine", "Face1=7"}}), HasSubstr("from 1 to 6, not 7"));
  EXPECT_THAT(complaint({{"refine", "Face1=2,Face1=1"}}), HasSubstr("Face1 is given twice"));
  for (const char* bad : {"Face1", "Face1=", "Face1=x", "Face1=1.5", "Face0=1", "X=1", "Face1-Face2=1", "Face1=1,,Face2=1"})
    EXPECT_THAT(complaint({{"refine", bad}}), HasSubstr("--refine: '")) << bad;
}

TEST(Options, AgainstThePart) {
  const PartNumbers box{{1, 2, 3, 4, 5, 6}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, {1, 2, 3, 4, 5, 6, 7, 8}};
  MeshOptions o;
  o.size = 11;
  EXPECT_THROW(check(o, 10, box), InvalidInput);
  EXPECT_NO_THROW(check(o, 12, box));
  o.labels = {{7, 0}};
  EXPECT_THROW(check(o, 12, box), InvalidInput);
  const auto complains = [&](const char* name, const char* text) {
    try {
      check(parse_options({{name, text}}), 12, box);
    } catch (const InvalidInput& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(complains("divisions", "Edge13=2"), HasSubstr("Edge13 does not exist, the part has 12 edges"));
  EXPECT_THAT(complains("divisions", "Face1-Face7=2"), HasSubstr("Face7 does not exist, the part has 6 faces"));
  EXPECT_THAT(complains("sizes", "Face9=2"), HasSubstr("Face9"));
  EXPECT_THAT(complains("keep_faces", "Face7"), HasSubstr("--keep-faces: Face7 does not exist"));
  EXPECT_EQ(complains("sizes", "Face6=2"), "");
  EXPECT_THAT(complains("refine", "Face7=1"), HasSubstr("--refine: Face7 does not exist, the part has 6 faces"));
  EXPECT_THAT(complains("refine", "Edge13=1"), HasSubstr("--refine: Edge13 does not exist, the part has 12 edges"));
  EXPECT_THAT(complains("refine", "Vertex9=1"), HasSubstr("--refine: Vertex9 does not exist, the part has 8 vertices"));
  EXPECT_THAT(complains("refine", "Solid2=1"), HasSubstr("--refine: Solid2 does not exist, the part has 1 solid"));
  EXPECT_EQ(complains("refine", "Face6=2,Edge12=1,Vertex8=3,Solid1=1"), "");
}

TEST(Options, WithoutASizeThePartDecides) {
  MeshOptions o;
  EXPECT_DOUBLE_EQ(effective_size(o, 60), 3);
  EXPECT_DOUBLE_EQ(effective_max_size(o, 60), 4);
  EXPECT_EQ(effective_min_layers(o), 2);
  o.order = 1;
  EXPECT_EQ(effective_min_layers(o), 3);
  o.max_size = 2;
  EXPECT_DOUBLE_EQ(effective_size(o, 60), 1.5);
  EXPECT_DOUBLE_EQ(effective_max_size(o, 60), 2);
  o.max_size = 0;
  o.size = 6;
  EXPECT_DOUBLE_EQ(effective_size(o, 60), 6);
  EXPECT_EQ(effective_max_size(o, 60), std::numeric_limits<double>::infinity());
  EXPECT_EQ(effective_per_circle(o), 12);
  o = {};
  o.coarsest = true;
  EXPECT_EQ(effective_min_layers(o), 1);
  EXPECT_EQ(effective_per_circle(o), 0);
  o.min_layers = 4;
  EXPECT_EQ(effective_min_layers(o), 4);
  EXPECT_EQ(parse_options({{"per_circle", "0"}}).per_circle, 0);
  EXPECT_THAT(complaint({{"max_size", "0"}}), HasSubstr("--max-size"));
  EXPECT_THAT(complaint({{"per_circle", "-1"}}), HasSubstr("--per-circle"));
  EXPECT_THAT(complaint({{"coarsest", "true"}, {"max_size", "2"}}), HasSubstr("--max-size"));
}

}  // namespace
}  // namespace polycube
