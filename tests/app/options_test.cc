#include "editor/app/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/test_files.h"

namespace lararium::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kUsageError = 2;

std::variant<CommandLine, int> Parse(std::vector<std::string> arguments) {
  std::vector<const char*> argv = {"lararium-editor"};
  for (const std::string& argument : arguments) {
    argv.push_back(argument.c_str());
  }
  return ParseCommandLine(static_cast<int>(argv.size()), argv.data());
}

template <typename Options>
Options Parsed(std::vector<std::string> arguments) {
  const auto parsed = Parse(std::move(arguments));
  const CommandLine* line = std::get_if<CommandLine>(&parsed);
  if (line == nullptr || !std::holds_alternative<Options>(line->subcommand)) {
    ADD_FAILURE() << "is not this subcommand";
    return {};
  }
  return std::get<Options>(line->subcommand);
}

// What is printed for a wrong command line.
std::string Refusal(std::vector<std::string> arguments) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  const auto parsed = Parse(std::move(arguments));
  const std::string message = ::testing::internal::GetCapturedStderr();
  ::testing::internal::GetCapturedStdout();
  const int* code = std::get_if<int>(&parsed);
  EXPECT_TRUE(code != nullptr && *code == kUsageError);
  return message;
}

TEST(EditorOptions, TrainTakesARecordingItsCameraAndWhatTheMapMayWeigh) {
  const test::TemporaryFolder folder;
  const std::string images = folder.path().string();
  const auto train = Parsed<TrainOptions>(
      {"train", "p.lararium", "--images", images, "--intrinsics", "560,561,319.5,239.5", "--points",
       "5000", "--tag-size", "0.16", "--place", "yard", "--report", "report.html"});
  EXPECT_EQ(train.project, "p.lararium");
  EXPECT_EQ(train.images, images);
  EXPECT_THAT(train.intrinsics, ElementsAre(560, 561, 319.5, 239.5));
  EXPECT_EQ(train.points, 5000);
  EXPECT_EQ(train.tag_size, 0.16);
  EXPECT_EQ(train.tag_family, "tag36h11");
  EXPECT_EQ(train.place, "yard");
  EXPECT_EQ(train.report, "report.html");
  EXPECT_FALSE(train.add);
}

TEST(EditorOptions, TrainAddNeedsARecording) {
  EXPECT_THAT(Refusal({"train", "p", "--add"}), HasSubstr("needs the recording to add"));
  const test::TemporaryFolder folder;
  EXPECT_TRUE(Parsed<TrainOptions>({"train", "p", "--add", "--camera", "0"}).add);
  EXPECT_TRUE(
      Parsed<TrainOptions>({"train", "p", "--add", "--images", folder.path().string()}).add);
}

TEST(EditorOptions, TrainTakesOneRecordingThatIsThere) {
  const test::TemporaryFolder folder;
  const std::string images = folder.path().string();
  EXPECT_THAT(Refusal({"train", "p", "--images", images, "--camera", "0"}), HasSubstr("excludes"));
  EXPECT_THAT(Refusal({"train", "p", "--video", images + "/none.mp4"}), HasSubstr("none.mp4"));
}

TEST(EditorOptions, TrainWithoutARecordingTakesTheOneBefore) {
  const auto train = Parsed<TrainOptions>({"train", "p"});
  EXPECT_TRUE(train.video.empty() && train.images.empty() && train.camera.empty());
  EXPECT_FALSE(train.points.has_value());
  EXPECT_FALSE(train.tag_size.has_value());
}

TEST(EditorOptions, CheckPointsDoesOneWorkWithAllThatItNeeds) {
  const auto set = Parsed<CheckPointsOptions>(
      {"check-points", "p", "--set", "counter, left", "--at", "-1.2,0.9,-0.4"});
  EXPECT_EQ(set.set, "counter, left");
  EXPECT_THAT(set.at, ElementsAre(-1.2, 0.9, -0.4));
  const auto pick =
      Parsed<CheckPointsOptions>({"check-points", "p", "--place", "site", "--pick", "counter",
                                  "--frame", "000012.png", "--pixel", "10.5,20"});
  EXPECT_EQ(pick.frame, "000012.png");
  EXPECT_THAT(pick.pixel, ElementsAre(10.5, 20));
  EXPECT_TRUE(Parsed<CheckPointsOptions>({"check-points", "p", "--lay"}).lay);
  EXPECT_THAT(Refusal({"check-points", "p", "--set", "a"}), HasSubstr("--at"));
  EXPECT_THAT(Refusal({"check-points", "p", "--pick", "a"}), HasSubstr("--frame"));
  EXPECT_THAT(Refusal({"check-points", "p", "--at", "1,2,3"}), HasSubstr("--set"));
  EXPECT_THAT(Refusal({"check-points", "p", "--lay", "--remove", "a"}), HasSubstr("--lay"));
}

TEST(EditorOptions, PointsLieBetweenAHundredAndTenMillion) {
  const std::vector<std::vector<std::string>> commands = {
      {"train", "p"}, {"prune", "p"}, {"export", "p", "--out", "a.larshow"}};
  for (const std::vector<std::string>& command : commands) {
    for (const char* wrong : {"99", "10000001", "-5", "many"}) {
      std::vector<std::string> arguments = command;
      arguments.insert(arguments.end(), {"--points", wrong});
      EXPECT_THAT(Refusal(arguments), HasSubstr("--points")) << command.front() << " " << wrong;
    }
  }
  EXPECT_EQ(Parsed<TrainOptions>({"train", "p", "--points", "100"}).points, 100);
  EXPECT_EQ(Parsed<PruneOptions>({"prune", "p", "--points", "10000000"}).points, 10'000'000);
  EXPECT_EQ(Parsed<ExportOptions>({"export", "p", "--out", "a", "--points", "700"}).points, 700);
}

TEST(EditorOptions, TagsHaveASizeInMetres) {
  for (const char* wrong : {"0", "-0.1", "101", "big"}) {
    EXPECT_THAT(Refusal({"train", "p", "--tag-size", wrong}), HasSubstr("--tag-size")) << wrong;
  }
  EXPECT_EQ(Parsed<TrainOptions>({"train", "p", "--tag-size", "0.1", "--tag-family", "tag25h9"})
                .tag_family,
            "tag25h9");
}

TEST(EditorOptions, IntrinsicsAreFourOrEightNumbers) {
  EXPECT_THAT(Refusal({"train", "p", "--intrinsics", "1,2,3,4,5"}), HasSubstr("4 or 8"));
  EXPECT_THAT(Refusal({"train", "p", "--intrinsics", "1,2,3"}), HasSubstr("--intrinsics"));
  EXPECT_THAT(Refusal({"train", "p", "--intrinsics", "a,b,c,d"}), HasSubstr("--intrinsics"));
  EXPECT_EQ(
      Parsed<TrainOptions>({"train", "p", "--intrinsics", "1,2,3,4,5,6,7,8"}).intrinsics.size(),
      8u);
}

TEST(EditorOptions, ColmapModelsAreReadFromAFolderThatIsThere) {
  const test::TemporaryFolder folder;
  const std::string model = folder.path().string();
  const auto in = Parsed<ImportColmapOptions>(
      {"import-colmap", "p", model, "--images", model, "--place", "yard"});
  EXPECT_EQ(in.project, "p");
  EXPECT_EQ(in.model, model);
  EXPECT_EQ(in.images, model);
  EXPECT_EQ(in.place, "yard");
  EXPECT_THAT(Refusal({"import-colmap", "p"}), HasSubstr("DIR"));
  EXPECT_THAT(Refusal({"import-colmap", "p", model + "/none"}), HasSubstr("none"));
  EXPECT_THAT(Refusal({"import-colmap", "p", model, "--images", model + "/none"}),
              HasSubstr("none"));
}

TEST(EditorOptions, ColmapModelsAreWrittenToAnyFolderAsBinaryUnlessAsked) {
  const auto plain = Parsed<ExportColmapOptions>({"export-colmap", "p", "model"});
  EXPECT_EQ(plain.model, "model");
  EXPECT_FALSE(plain.text);
  EXPECT_FALSE(plain.with_images);
  const auto full =
      Parsed<ExportColmapOptions>({"export-colmap", "p", "model", "--text", "--with-images"});
  EXPECT_TRUE(full.text);
  EXPECT_TRUE(full.with_images);
  EXPECT_THAT(Refusal({"export-colmap", "p"}), HasSubstr("DIR"));
}

TEST(EditorOptions, MeasureNamesTwoPoints) {
  const auto options =
      Parsed<MeasureOptions>({"measure", "p", "--from", "3", "--to", "8", "--metres", "1.2"});
  EXPECT_EQ(options.from, 3);
  EXPECT_EQ(options.to, 8);
  EXPECT_EQ(options.metres, 1.2);
  EXPECT_FALSE(Parsed<MeasureOptions>({"measure", "p", "--from", "3", "--to", "8"}).metres);
}

TEST(EditorOptions, TrainRemovesASessionOnItsOwn) {
  EXPECT_EQ(Parsed<TrainOptions>({"train", "p", "--remove-session", "2"}).remove_session, 2);
  EXPECT_FALSE(Parsed<TrainOptions>({"train", "p"}).remove_session.has_value());
}

TEST(EditorOptions, PruneOnlyMeasuresUnlessPointsAreNamed) {
  EXPECT_FALSE(Parsed<PruneOptions>({"prune", "p"}).points.has_value());
  EXPECT_EQ(Parsed<PruneOptions>({"prune", "p", "--place", "yard"}).place, "yard");
}

TEST(EditorOptions, PortraitsShowPeopleStandingWalkingOrInAClip) {
  const test::TemporaryFolder folder;
  const std::string file = (folder.path() / "somebody.larhuman").string();
  std::ofstream(file) << "anything that is there";
  const auto portrait = Parsed<PortraitOptions>(
      {"portrait", file, "--out", "p.png", "--view", "bust", "--walk", "2.5"});
  EXPECT_EQ(portrait.view, "bust");
  EXPECT_EQ(portrait.walk, 2.5);
  EXPECT_THAT(Refusal({"portrait", file, "--out", "p.png", "--walk", "1", "--clip", "wave"}),
              HasSubstr("--clip"));
  EXPECT_THAT(Refusal({"portrait", file, "--out", "p.png", "--view", "top"}), HasSubstr("--view"));
}

TEST(EditorOptions, JsonIsAskedForBeforeOrAfterTheSubcommand) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--json", "prune", "p"}, {"prune", "p", "--json"}}) {
    const auto parsed = Parse(arguments);
    ASSERT_TRUE(std::holds_alternative<CommandLine>(parsed));
    EXPECT_TRUE(std::get<CommandLine>(parsed).json);
  }
}

TEST(EditorOptions, WithoutASubcommandTheWindowOpens) {
  EXPECT_EQ(Parsed<WindowOptions>({"p.lararium"}).project, "p.lararium");
  EXPECT_TRUE(Parsed<WindowOptions>({}).project.empty());
}

}  // namespace
}  // namespace lararium::app
