#include "editor/cli/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/support/test_files.h"

namespace lararium::editor {
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

// The message for an invalid command line.
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
  const auto train = Parsed<TrainCommandOptions>(
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

TEST(EditorOptions, TextInAnotherEncodingIsRefused) {
  const std::string latin1 =
      "Gr\xf6\xdf"
      "e";
  EXPECT_THAT(Refusal({"new", "p", "--title", latin1}),
              HasSubstr("--title: the text is not UTF-8"));
  EXPECT_THAT(Refusal({"project", "p", "--credits", latin1}), HasSubstr("is not UTF-8"));
  EXPECT_THAT(Refusal({"lines", "p", "--set", "a", "--text", "de=" + latin1}),
              HasSubstr("is not UTF-8"));
  EXPECT_EQ(Parsed<NewOptions>({"new", "p", "--title", "Gr\u00f6\u00dfe"}).title, "Größe");
}

TEST(EditorOptions, TrainAddNeedsARecording) {
  EXPECT_THAT(Refusal({"train", "p", "--add"}), HasSubstr("needs the recording to add"));
  const test::TemporaryFolder folder;
  EXPECT_TRUE(Parsed<TrainCommandOptions>({"train", "p", "--add", "--camera", "0"}).add);
  EXPECT_TRUE(
      Parsed<TrainCommandOptions>({"train", "p", "--add", "--images", folder.path().string()}).add);
}

TEST(EditorOptions, TrainTakesOneRecordingThatIsThere) {
  const test::TemporaryFolder folder;
  const std::string images = folder.path().string();
  EXPECT_THAT(Refusal({"train", "p", "--images", images, "--camera", "0"}), HasSubstr("excludes"));
  EXPECT_THAT(Refusal({"train", "p", "--video", images + "/none.mp4"}), HasSubstr("none.mp4"));
}

TEST(EditorOptions, TrainWithoutARecordingTakesTheOneBefore) {
  const auto train = Parsed<TrainCommandOptions>({"train", "p"});
  EXPECT_TRUE(train.video.empty() && train.images.empty() && train.camera.empty());
  EXPECT_FALSE(train.points.has_value());
  EXPECT_FALSE(train.tag_size.has_value());
}

TEST(EditorOptions, CameraMeasuresAPlaceOrListsWhatIsConnected) {
  EXPECT_EQ(Parsed<CameraOptions>({"camera", "p.lararium", "--knee", "0.8"}).project, "p.lararium");
  EXPECT_TRUE(Parsed<CameraOptions>({"camera", "--list"}).list);
  EXPECT_THAT(Refusal({"camera"}), HasSubstr("PROJECT"));
  EXPECT_THAT(Refusal({"camera", "--list", "p.lararium"}), HasSubstr("--list"));
  EXPECT_THAT(Refusal({"camera", "--list", "--forget"}), HasSubstr("--list"));
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
  EXPECT_EQ(Parsed<CheckPointsOptions>(
                {"check-points", "p", "--clear", "counter", "--frame", "000012.png"})
                .frame,
            "000012.png");
  EXPECT_THAT(Refusal({"check-points", "p", "--frame", "000012.png"}), HasSubstr("--clear"));
  EXPECT_THAT(Refusal({"check-points", "p", "--clear", "a", "--frame", "1.png", "--pixel", "1,2"}),
              HasSubstr("--pick"));
  EXPECT_THAT(Refusal({"check-points", "p", "--clear", "a", "--session", "1"}),
              HasSubstr("--frame"));
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
  EXPECT_EQ(Parsed<TrainCommandOptions>({"train", "p", "--points", "100"}).points, 100);
  EXPECT_EQ(Parsed<PruneOptions>({"prune", "p", "--points", "10000000"}).points, 10'000'000);
  EXPECT_EQ(Parsed<ExportOptions>({"export", "p", "--out", "a", "--points", "700"}).points, 700);
}

TEST(EditorOptions, AnExportIsAFileOrASignedFolder) {
  const std::string key = "/dev/null";  // A file that is there.
  EXPECT_THAT(Refusal({"export", "p"}), HasSubstr("--out or --web"));
  EXPECT_THAT(Refusal({"export", "p", "--out", "a", "--web", "b", "--sign", key}),
              HasSubstr("excludes"));
  EXPECT_THAT(Refusal({"export", "p", "--web", "b"}), HasSubstr("lararium-editor key NAME"));
  EXPECT_THAT(Refusal({"export", "p", "--out", "a", "--address", "https://x"}), HasSubstr("--web"));
  EXPECT_THAT(Refusal({"export", "p", "--web", "b", "--sign", key, "--address", "http://x"}),
              HasSubstr("https://"));
  const auto web =
      Parsed<ExportOptions>({"export", "p", "--web", "b", "--sign", key, "--address", "https://x"});
  EXPECT_EQ(web.web, "b");
  EXPECT_EQ(web.address, "https://x");
  EXPECT_THAT(Refusal({"export", "p", "--web", "b", "--sign", key, "--fleet", "wss://h/s"}),
              HasSubstr("--fleet-password-file"));
  EXPECT_THAT(Refusal({"export", "p", "--web", "b", "--sign", key, "--group", "red"}),
              HasSubstr("--fleet"));
}

TEST(EditorOptions, TagsHaveASizeInMetres) {
  for (const char* wrong : {"0", "-0.1", "101", "big"}) {
    EXPECT_THAT(Refusal({"train", "p", "--tag-size", wrong}), HasSubstr("--tag-size")) << wrong;
  }
  EXPECT_EQ(
      Parsed<TrainCommandOptions>({"train", "p", "--tag-size", "0.1", "--tag-family", "tag25h9"})
          .tag_family,
      "tag25h9");
}

TEST(EditorOptions, IntrinsicsAreFourOrEightNumbers) {
  EXPECT_THAT(Refusal({"train", "p", "--intrinsics", "1,2,3,4,5"}), HasSubstr("4 or 8"));
  EXPECT_THAT(Refusal({"train", "p", "--intrinsics", "1,2,3"}), HasSubstr("--intrinsics"));
  EXPECT_THAT(Refusal({"train", "p", "--intrinsics", "a,b,c,d"}), HasSubstr("--intrinsics"));
  EXPECT_EQ(Parsed<TrainCommandOptions>({"train", "p", "--intrinsics", "1,2,3,4,5,6,7,8"})
                .intrinsics.size(),
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
  EXPECT_EQ(Parsed<TrainCommandOptions>({"train", "p", "--remove-session", "2"}).remove_session, 2);
  EXPECT_TRUE(Parsed<TrainCommandOptions>({"train", "p", "--put-back"}).put_back);
  EXPECT_FALSE(Parsed<TrainCommandOptions>({"train", "p"}).remove_session.has_value());
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

TEST(EditorOptions, AGarmentIsCheckedOrPicturedOnAPreset) {
  const auto listed = Parsed<WardrobeOptions>({"wardrobe"});
  EXPECT_TRUE(listed.check.empty() && listed.picture.empty());
  const auto pictured = Parsed<WardrobeOptions>(
      {"wardrobe", "--picture", "tunic", "--picture", "toga", "--on", "girl", "--out", "t.png"});
  EXPECT_EQ(pictured.picture, (std::vector<std::string>{"tunic", "toga"}));
  EXPECT_EQ(pictured.on, "girl");
  EXPECT_THAT(Refusal({"wardrobe", "--picture", "tunic"}), HasSubstr("--out"));
  EXPECT_THAT(Refusal({"wardrobe", "--picture", "spacesuit", "--out", "t.png"}),
              HasSubstr("spacesuit"));
}

TEST(EditorOptions, CastChangesWhatIsGivenOfSomebodyNamed) {
  const auto cast = Parsed<CastOptions>({"cast", "p", "--name", "ada", "--voice-rate", "120",
                                         "--bone", "l_hip=LeftUpLeg", "--bone", "r_hip="});
  EXPECT_EQ(cast.voice_rate, 120);
  EXPECT_FALSE(cast.voice_pitch || cast.voice_variant || cast.height);
  EXPECT_THAT(cast.bones, ElementsAre("l_hip=LeftUpLeg", "r_hip="));
  EXPECT_EQ(Parsed<CastOptions>({"cast", "p"}).name, "");
  EXPECT_EQ(
      Parsed<CastOptions>({"cast", "p", "--name", "ada", "--voice-variant", ""}).voice_variant, "");
  EXPECT_THAT(Refusal({"cast", "p", "--height", "1.6"}), HasSubstr("--name"));
  EXPECT_THAT(Refusal({"cast", "p", "--name", "ada", "--remove", "ada"}), HasSubstr("excludes"));
  EXPECT_THAT(Refusal({"cast", "p", "--name", "ada", "--plain", "--preset", "keeper"}),
              HasSubstr("excludes"));
}

TEST(EditorOptions, TextsMayBeEmpty) {
  const auto project = Parsed<ProjectOptions>({"project", "p", "--captions", ""});
  EXPECT_EQ(project.captions, "");
  EXPECT_FALSE(project.spoken || project.title || project.credits);
  EXPECT_EQ(Parsed<LinesOptions>({"lines", "p", "--set", "hail", "--speaker", ""}).speaker, "");
}

TEST(EditorOptions, PlaceDoesOneWorkWithAllThatItNeeds) {
  EXPECT_EQ(Parsed<PlaceOptions>({"place", "p", "--rename", "site", "--to", "bar"}).to, "bar");
  EXPECT_THAT(Refusal({"place", "p", "--rename", "site"}), HasSubstr("--to"));
  EXPECT_THAT(Refusal({"place", "p", "--add", "bar", "--remove", "bar"}), HasSubstr("--"));
  EXPECT_THAT(Refusal({"place", "p", "--set", "bar"}), HasSubstr("needs a change"));
  EXPECT_THAT(Refusal({"place", "p", "--occluders-of", "bar"}), HasSubstr("needs a"));
}

TEST(EditorOptions, WhatTheCameraViewPlaysIsAFileOrFolderThatIsThere) {
  const test::TemporaryFolder folder;
  const std::string images = folder.path().string();
  EXPECT_EQ(Parsed<PlaceOptions>({"place", "p", "--set", "site", "--preview", images}).preview,
            images);
  EXPECT_THAT(Refusal({"place", "p", "--set", "site", "--preview", images + "/none.mp4"}),
              HasSubstr("none.mp4"));
}

TEST(EditorOptions, StageTakesPicksTagsAndNumbers) {
  const auto stage =
      Parsed<StageOptions>({"stage", "p", "--pick", "origin=000010.png,3.5,4", "--pick",
                            "floor=a,b.png,1,2", "--length", "1.2", "--at", "-1,0,2", "--turn",
                            "-90", "--scale", "0.5", "--floor", "--nudge", "-0.01,0,0"});
  EXPECT_THAT(stage.picks, ElementsAre("origin=000010.png,3.5,4", "floor=a,b.png,1,2"));
  EXPECT_THAT(stage.at, ElementsAre(-1, 0, 2));
  EXPECT_THAT(stage.turn, ElementsAre(-90));
  EXPECT_THAT(stage.nudge, ElementsAre(-0.01, 0, 0));
  EXPECT_TRUE(stage.on_floor);
  EXPECT_THAT(Refusal({"stage", "p", "--clear", "middle"}), HasSubstr("middle"));
  EXPECT_THAT(Refusal({"stage", "p", "--without-tags", "--tag-size", "0.1"}),
              HasSubstr("excludes"));
  EXPECT_THAT(Refusal({"stage", "p", "--clear", "middle=a.png"}), HasSubstr("middle"));
  EXPECT_THAT(Refusal({"stage", "p", "--clear", "origin", "--session", "1"}), HasSubstr("--clear"));
  EXPECT_THAT(Refusal({"stage", "p", "--session", "1"}), HasSubstr("--pick"));
  EXPECT_EQ(
      Parsed<StageOptions>({"stage", "p", "--clear", "origin=a.png", "--session", "1"}).session, 1);
}

TEST(EditorOptions, TimelineWritesAddsOrChanges) {
  EXPECT_EQ(Parsed<TimelineOptions>({"timeline", "p", "--out", "a.otio"}).out, "a.otio");
  const auto moved = Parsed<TimelineOptions>(
      {"timeline", "p", "--item", "hail", "--item", "markers/1", "--move", "-0.5", "--ripple"});
  EXPECT_THAT(moved.items, ElementsAre("hail", "markers/1"));
  EXPECT_EQ(moved.move, -0.5);
  const auto added =
      Parsed<TimelineOptions>({"timeline", "p", "--add", "walks", "--actor", "ada", "--at", "2",
                               "--field", "to=1,-2", "--field", "speed=1"});
  EXPECT_THAT(added.fields, ElementsAre("to=1,-2", "speed=1"));
  EXPECT_THAT(Refusal({"timeline", "p", "--add", "markers"}), HasSubstr("--at"));
  EXPECT_THAT(Refusal({"timeline", "p", "--item", "hail"}), HasSubstr("needs a change"));
  EXPECT_THAT(Refusal({"timeline", "p", "--field", "name=a"}), HasSubstr("--add or --item"));
  EXPECT_THAT(Refusal({"timeline", "p", "--move", "1"}), HasSubstr("--item"));
}

TEST(EditorOptions, ProbesAreOfPhotographsOrOfPlaces) {
  const test::TemporaryFolder folder;
  const std::string sky = (folder / "sky.exr").string();
  std::ofstream(sky) << "sky";
  const auto added = Parsed<ProbeOptions>(
      {"probe", "add", "p", "noon", sky, "--place", "bar", "--hour", "12.5", "--match", "90,30"});
  EXPECT_EQ(added.work, ProbeOptions::Work::kAdd);
  EXPECT_EQ(added.project, "p");
  EXPECT_EQ(added.name, "noon");
  EXPECT_THAT(added.files, ElementsAre(sky));
  EXPECT_THAT(added.pairs, ElementsAre(90, 30));
  EXPECT_EQ(Parsed<ProbeOptions>({"probe", "list", "p"}).work, ProbeOptions::Work::kList);
  EXPECT_EQ(Parsed<ProbeOptions>({"probe", "info", sky}).work, ProbeOptions::Work::kInfo);
  EXPECT_EQ(Parsed<ProbeOptions>({"probe", "set", "p", "noon", "--exposure", "-1.5"}).exposure,
            -1.5);
  EXPECT_THAT(Refusal({"probe", "add", "p", "noon"}), HasSubstr("FILE"));
  EXPECT_THAT(Refusal({"probe", "remove", "p"}), HasSubstr("NAME"));
}

TEST(EditorOptions, ThingsAreBuiltInOrModels) {
  EXPECT_EQ(Parsed<ObjectOptions>({"object", "p", "--set", "jug", "--heading", "-45"}).heading,
            -45);
  EXPECT_THAT(Refusal({"object", "p", "--add", "jug"}), HasSubstr("--model, or --file"));
  EXPECT_THAT(Refusal({"object", "p", "--add", "jug", "--model", "spaceship"}),
              HasSubstr("spaceship"));
  EXPECT_THAT(Refusal({"object", "p", "--at", "0,0,0"}), HasSubstr("needs a"));
  EXPECT_THAT(Refusal({"sound", "p", "--bring", "sea"}), HasSubstr("--file"));
  EXPECT_THAT(Refusal({"sound", "p", "--gain", "1"}), HasSubstr("--ambience"));
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
}  // namespace lararium::editor
