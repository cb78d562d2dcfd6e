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

TEST(EditorOptions, CalibrateTakesOneSourceAndABoard) {
  const auto calibrate = Parsed<CalibrateOptions>(
      {"calibrate", "--camera", "1", "--board", "7x5", "--square", "0.03", "--seconds", "20"});
  EXPECT_EQ(calibrate.camera, "1");
  EXPECT_EQ(calibrate.columns, 7);
  EXPECT_EQ(calibrate.rows, 5);
  EXPECT_EQ(calibrate.square, 0.03);
  EXPECT_EQ(calibrate.seconds, 20.0);
  EXPECT_EQ(Parsed<CalibrateOptions>({"calibrate", "--print-board", "a.svg"}).columns, 9);
  EXPECT_THAT(Refusal({"calibrate"}), HasSubstr("--print-board"));
  EXPECT_THAT(Refusal({"calibrate", "--camera", "0", "--print-board", "a.svg"}),
              HasSubstr("--print-board"));
  EXPECT_THAT(Refusal({"calibrate", "--camera", "0", "--board", "nine"}), HasSubstr("--board"));
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

TEST(EditorOptions, OccluderDoesOneWorkWithAllThatItNeeds) {
  const auto add = Parsed<OccluderOptions>({"occluder", "p", "--add", "gate", "--shape", "arch",
                                            "--size", "width=3,opening=1.5", "--at", "1,0,-2.5",
                                            "--turn", "-30", "--receives-shadow", "no"});
  EXPECT_EQ(add.add, "gate");
  EXPECT_EQ(add.shape, "arch");
  EXPECT_THAT(add.sizes, ElementsAre("width=3", "opening=1.5"));
  EXPECT_THAT(add.at, ElementsAre(1, 0, -2.5));
  EXPECT_THAT(add.turn, ElementsAre(-30));
  EXPECT_EQ(add.receives_shadow, "no");
  EXPECT_EQ(add.blocks_sound, "");
  EXPECT_FALSE(add.scale.has_value());
  const auto set = Parsed<OccluderOptions>({"occluder", "p", "--place", "site", "--set", "gate",
                                            "--turn", "10,-90,5", "--scale", "0.01"});
  EXPECT_THAT(set.turn, ElementsAre(10, -90, 5));
  EXPECT_EQ(set.scale, 0.01);
  EXPECT_EQ(Parsed<OccluderOptions>({"occluder", "p"}).place, "");
  EXPECT_THAT(Refusal({"occluder", "p", "--add", "a"}), HasSubstr("--shape"));
  EXPECT_THAT(Refusal({"occluder", "p", "--add", "a", "--shape", "cone"}), HasSubstr("cone"));
  EXPECT_THAT(Refusal({"occluder", "p", "--add", "a", "--model", "/none.glb"}), HasSubstr("none"));
  EXPECT_THAT(Refusal({"occluder", "p", "--shape", "box"}), HasSubstr("--add"));
  EXPECT_THAT(Refusal({"occluder", "p", "--set", "a"}), HasSubstr("--size"));
  EXPECT_THAT(Refusal({"occluder", "p", "--at", "1,2,3"}), HasSubstr("--set"));
  EXPECT_THAT(Refusal({"occluder", "p", "--remove", "a", "--at", "1,2,3"}), HasSubstr("--set"));
  EXPECT_THAT(Refusal({"occluder", "p", "--set", "a", "--remove", "b"}), HasSubstr("--"));
  EXPECT_THAT(Refusal({"occluder", "p", "--set", "a", "--blocks-sound", "maybe"}),
              HasSubstr("maybe"));
}

TEST(EditorOptions, AlignTakesPairsWithTheirPicks) {
  const auto added =
      Parsed<AlignOptions>({"align", "p", "--occluder", "counter", "--place", "site", "--pair",
                            "-1.5,0,2e3", "--pick", "0.png,10,20.5", "--pick", "8.png,30,40"});
  EXPECT_EQ(added.occluder, "counter");
  EXPECT_EQ(added.pair, (std::vector<double>{-1.5, 0.0, 2000.0}));
  EXPECT_EQ(added.picks, (std::vector<std::string>{"0.png,10,20.5", "8.png,30,40"}));
  EXPECT_FALSE(added.keep_scale.has_value());
  EXPECT_FALSE(added.flat.has_value());
  const auto refined = Parsed<AlignOptions>({"align", "p", "--occluder", "a", "--keep-scale",
                                             "--by-points", "--refine", "--within", "0.1"});
  EXPECT_TRUE(refined.by_points && refined.refine);
  EXPECT_EQ(refined.keep_scale, true);
  EXPECT_EQ(refined.within, 0.1);
  EXPECT_EQ(Parsed<AlignOptions>({"align", "p", "--occluder", "a", "--fit-scale"}).keep_scale,
            false);
  EXPECT_EQ(Parsed<AlignOptions>({"align", "p", "--occluder", "a", "--not-flat"}).flat, false);
  EXPECT_THAT(Refusal({"align", "p"}), HasSubstr("--occluder"));
  EXPECT_THAT(Refusal({"align", "p", "--occluder", "a", "--pick", "0.png,1,2"}),
              HasSubstr("--pair"));
  EXPECT_THAT(Refusal({"align", "p", "--occluder", "a", "--within", "0.1"}), HasSubstr("--refine"));
  EXPECT_THAT(Refusal({"align", "p", "--occluder", "a", "--refine", "--within", "-1"}),
              HasSubstr("--within"));
  EXPECT_THAT(Refusal({"align", "p", "--occluder", "a", "--remove", "0"}), HasSubstr("--remove"));
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
  EXPECT_TRUE(Parsed<TrainOptions>({"train", "p", "--put-back"}).put_back);
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
