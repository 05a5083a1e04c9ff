#include "job/job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "core/types.h"
#include "job/describe.h"
#include "job/npz.h"
#include "support/files.h"

namespace polycube {
namespace {

using testing::HasSubstr;

TEST(JobOptions, EveryKindOfValue) {
  const MeshOptions options = options_from_json(R"({"size": 2.5, "order": 1, "sew": false, "effort": "quick", "labels": {"Face3": "+X", "Face7": "-Z"},
      "frame": [[0, 1.0, 0], [-1e0, 0, 0]], "keep_faces": ["Face3", "Face1"], "divisions": {"Edge4": 6, "Face1-Face2": "3.."}, "sizes": {"Face3": 0.5},
      "hexes": null})");
  EXPECT_EQ(options.size, 2.5);
  EXPECT_EQ(options.order, 1);
  EXPECT_FALSE(options.sew);
  EXPECT_EQ(options.effort, "quick");
  EXPECT_EQ(options.labels, (FaceLabels{{3, 0}, {7, 5}}));
  ASSERT_EQ(options.frame.size(), 2u);
  EXPECT_EQ(options.frame[0], Vec3(0, 1, 0));
  EXPECT_EQ(options.frame[1], Vec3(-1, 0, 0));
  EXPECT_EQ(options.keep_faces, (FaceList{1, 3}));
  EXPECT_EQ(options.divisions.size(), 2u);
  ASSERT_EQ(options.sizes.size(), 1u);
  EXPECT_EQ(options.hexes, 0);
}

TEST(JobOptions, TextAsOnTheCommandLineMeansTheSame) {
  EXPECT_EQ(options_from_json(R"({"labels": "Face3=+X", "keep_faces": "Face1,Face3", "size": "2.5"})").labels, (FaceLabels{{3, 0}}));
  EXPECT_TRUE(options_from_json(R"({"labels": {}, "frame": [], "keep_faces": ""})").labels.empty());
}

TEST(JobOptions, EveryDigitOfANumberArrives) {
  EXPECT_EQ(options_from_json(R"({"size": 0.1000000000000000055511151231257827})").size, 0.1);
  EXPECT_EQ(options_from_json(R"({"size": 0.30000000000000004})").size, 0.30000000000000004);
}

TEST(JobOptions, WhatCannotBeReadIsRefused) {
  for (const char* text : {"", "5", "[]", "{", R"({"size": 0})", R"({"colour": 1})", R"({"labels": {"Face1": "up"}})", R"({"frame": [[1, 0], [0, 1]]})"})
    EXPECT_NE(files::refusal([&] { options_from_json(text); }), "accepted") << text;
  EXPECT_THAT(files::refusal([] { job_kind("both"); }), HasSubstr("'both'"));
}

TEST(EngineDescription, HasEveryOptionInOrder) {
  const auto json = nlohmann::json::parse(describe_engine());
  ASSERT_EQ(json["options"].size(), option_table().size());
  for (std::size_t i = 0; i < option_table().size(); ++i) {
    EXPECT_EQ(json["options"][i]["name"], option_table()[i].name);
    EXPECT_EQ(json["options"][i]["max"], option_table()[i].max);
  }
  EXPECT_EQ(json["label_names"], (std::vector<std::string>{"+X", "-X", "+Y", "-Y", "+Z", "-Z"}));
  EXPECT_EQ(json["label_colours"].size(), 6u);
  EXPECT_EQ(json["smesh_hex20"].size(), 20u);
}

TEST(Npz, DataBeginAtAMultipleOf64) {
  // A stored archive holds each file as it is: header of 128 bytes at most, then the numbers.
  const files::TestFile file("arrays.npz");
  Npz arrays;
  arrays.add_rows("points", std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}, 3);
  arrays.write(file.path());
  const std::string content = file.read();
  const auto start = content.find("\x93NUMPY");
  ASSERT_NE(start, std::string::npos);
  const auto length = static_cast<std::size_t>(static_cast<unsigned char>(content[start + 8])) + 256u * static_cast<unsigned char>(content[start + 9]);
  EXPECT_EQ((10 + length) % 64, 0u);
  EXPECT_EQ(content[start + 10 + length - 1], '\n');
  EXPECT_THAT(content.substr(start + 10, length), HasSubstr("'shape': (2,3,)"));
  std::array<double, 6> numbers{};
  std::memcpy(numbers.data(), content.data() + start + 10 + length, sizeof numbers);
  EXPECT_EQ(numbers, (std::array<double, 6>{1, 2, 3, 4, 5, 6}));
}

TEST(Npz, AFolderThatIsMissingIsNamed) {
  Npz arrays;
  arrays.add("one", std::vector<int>{1});
  EXPECT_THAT(files::refusal([&] { arrays.write("/nowhere/arrays.npz"); }), HasSubstr("/nowhere/arrays.npz"));
}

}  // namespace
}  // namespace polycube
