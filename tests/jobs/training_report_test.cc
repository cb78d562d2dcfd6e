#include "editor/jobs/training_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "editor/text/text.h"
#include "shared/core/file.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::HasSubstr;

TrainingReport Example() {
  TrainingReport report;
  report.recordings.training = {SourceDocument::Kind::kVideo, "walk.mp4"};
  report.recordings.added.push_back({{SourceDocument::Kind::kImages, "evening"}, {}});
  report.warnings = {"walk.mp4: is interlaced", "evening: 2 camera raw files are left out"};
  report.recording = "evening";
  report.frames = 120;
  report.located = 117;
  report.ended = 1'700'000'000;
  report.seconds = 200.0;
  report.focal_deviation_px = 1.5;
  using Kind = train::CaptureAdvice::Kind;
  report.advice = {{.kind = Kind::kNotLocated,
                    .first = "4.png",
                    .last = "5.png",
                    .reason = train::WeakReason::kBlur},
                   {.kind = Kind::kOneSide,
                    .first = "7.png",
                    .last = "9.png",
                    .end = train::CaptureAdvice::End::kLeft,
                    .value = 2.5,
                    .walk = {0.5, true}},
                   {.kind = Kind::kStepBack,
                    .first = "7.png",
                    .last = "9.png",
                    .value = 12.0,
                    .walk = {0.25, false}},
                   {.kind = Kind::kExposure, .value = 3.0, .session = 2},
                   {.kind = Kind::kWritten, .text = "Film the door."}};
  report.keyframes = 40;
  report.points = 5000;
  report.mean_error_px = 0.5;
  report.error_95_px = 1.25;
  return report;
}

TEST(TrainingReport, IsReadBackAsItWasWritten) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "training.json";
  ASSERT_TRUE(SaveTrainingReport(file, Example()).ok());
  const Result<TrainingReport> read = LoadTrainingReport(file);
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_EQ(TrainingText("site", *read), TrainingText("site", Example()));
  EXPECT_EQ(TrainingJson(*read), TrainingJson(Example()));
  EXPECT_EQ(FormatFields(read->recordings), FormatFields(Example().recordings));
  EXPECT_EQ(read->recording, "evening");
  EXPECT_EQ(read->warnings, Example().warnings);
  EXPECT_EQ(read->ended, 1'700'000'000);
  EXPECT_EQ(read->focal_deviation_px, 1.5);
  EXPECT_EQ(read->keyframes, 40);
  EXPECT_EQ(read->advice, Example().advice);
}

TEST(TrainingReport, KeepsTheEnglishSentenceOfEachAdvice) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "training.json";
  ASSERT_TRUE(SaveTrainingReport(file, Example()).ok());
  const Result<Json> json = LoadJson(file);
  ASSERT_TRUE(json.ok()) << json.message();
  const Json& advice = json->at("training").at("advice");
  const Json texts = TrainingJson(Example()).at("advice");
  ASSERT_EQ(advice.size(), texts.size());
  for (size_t i = 0; i < texts.size(); ++i) {
    EXPECT_EQ(advice[i].at("text"), texts[i]);
  }
  EXPECT_EQ(advice[0].at("kind"), "not_located");
  EXPECT_EQ(advice[4], Json({{"text", "Film the door."}}));
}

TEST(TrainingReport, OfAnotherVersionIsRefused) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "training.json";
  ASSERT_TRUE(SaveTrainingReport(file, Example()).ok());
  Json json = *LoadJson(file);
  json["schema"] = 1;
  ASSERT_TRUE(SaveJson(file, json).ok());
  EXPECT_THAT(LoadTrainingReport(file).message(), HasSubstr("schema"));
}

TEST(TrainingReport, KeepsTheSentenceOfAdviceOfAnUnknownKind) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "training.json";
  ASSERT_TRUE(SaveTrainingReport(file, Example()).ok());
  Json json = *LoadJson(file);
  json["training"]["advice"] =
      Json::array({{{"text", "Walk past the counter."}},
                   {{"kind", "dust"}, {"value", 1}, {"text", "Clean the lens."}}});
  ASSERT_TRUE(SaveJson(file, json).ok());
  const Result<TrainingReport> read = LoadTrainingReport(file);
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_EQ(TrainingJson(*read).at("advice"), Json({"Walk past the counter.", "Clean the lens."}));
}

TEST(TrainingReport, WhoseNumbersAreNoneKeepsTheSentence) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "training.json";
  TrainingReport report = Example();
  report.advice[1].walk = {std::numeric_limits<double>::quiet_NaN(), false};
  ASSERT_TRUE(SaveTrainingReport(file, report).ok());
  const Result<TrainingReport> read = LoadTrainingReport(file);
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_EQ(TrainingJson(*read), TrainingJson(report));
}

// Sets the texts of the process back to English.
class AdviceOfATraining : public testing::Test {
 protected:
  ~AdviceOfATraining() override { LoadTexts(LARARIUM_LOCALE_DIR, "en"); }
};

TEST_F(AdviceOfATraining, IsSaidInTheLanguageOfTheInterface) {
  LoadTexts(LARARIUM_LOCALE_DIR, "it");
  std::vector<std::string> said;
  for (const train::CaptureAdvice& advice : Example().advice) {
    said.push_back(train::AdviceSentence(advice).Translated(Tr));
  }
  EXPECT_EQ(said[0],
            "Non è stato possibile localizzare i fotogrammi da 4.png a 5.png (immagini mosse o "
            "sfocate): riprendi di nuovo questa parte, più lentamente o con una luce migliore, con "
            "la messa a fuoco fissa.");
  EXPECT_THAT(said[2], HasSubstr("circa il 25 % della distanza"));
  EXPECT_EQ(said[4], "Film the door.") << "nobody knows what it says";
}

TEST(TrainingReport, OfAMapThatWasNotTrainedHereHasItsRecordingsAlone) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "training.json";
  TrainingReport report;
  report.recordings.training = {SourceDocument::Kind::kImages, "photographs"};
  ASSERT_TRUE(SaveTrainingReport(file, report).ok());
  const Result<TrainingReport> read = LoadTrainingReport(file);
  ASSERT_TRUE(read.ok()) << read.message();
  EXPECT_EQ(read->recordings.training.path, "photographs");
  EXPECT_TRUE(read->recording.empty());
}

TEST(TrainingReport, SaysWhatWasFoundHowWellAndWhatToFilmNext) {
  const std::string text = TrainingText("site", Example());
  EXPECT_THAT(text, HasSubstr("site: 117 of 120 images located, 5000 points"));
  EXPECT_THAT(text, HasSubstr("mean reprojection error 0.500 px"));
  EXPECT_THAT(text, HasSubstr("95 % of the sights are within 1.250 px"));
  EXPECT_THAT(text, HasSubstr("3 min 20 s"));
  EXPECT_THAT(text, HasSubstr("- Film the door.\n"));
  EXPECT_THAT(text, HasSubstr("what to film next:\n- The frames 4.png to 5.png could not be"));
}

TEST(TrainingReport, DescribesTheWholeMapAndTheRecordingThatWasTrained) {
  train::TrainResult result;
  result.database = test::MakeSceneDatabase(test::MakeSyntheticWorld({.points = 50}));
  result.report.frames = 10;
  result.report.located.resize(9);
  result.report.seconds = {{"matching", 2.0}, {"mapping", 3.0}};
  result.report.camera = result.database.camera;
  const TrainingReport report =
      DescribeTraining({}, {SourceDocument::Kind::kVideo, "walk.mp4"}, result, std::nullopt);
  EXPECT_EQ(report.recording, "walk.mp4");
  EXPECT_EQ(report.frames, 10);
  EXPECT_EQ(report.located, 9);
  EXPECT_EQ(report.points, 50);
  EXPECT_EQ(report.seconds, 5.0);
  EXPECT_NEAR(report.error_95_px, 0.0, 1e-3) << "the synthetic sights have no noise";
  EXPECT_FALSE(report.focal_deviation_px.has_value());
  EXPECT_FALSE(report.advice.empty());
  EXPECT_GT(report.ended, 1'600'000'000);
}

TEST(TrainingReport, ThatIsDamagedSaysWhere) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "training.json";
  const auto problem = [&](const char* text) {
    CHECK(WriteFileAtomically(file, std::string_view(text)).ok());
    return LoadTrainingReport(file).message();
  };
  EXPECT_THAT(problem("{"), HasSubstr("training.json"));
  EXPECT_THAT(problem(R"({"schema": 3, "recordings": {}})"), HasSubstr("schema"));
  EXPECT_THAT(problem(R"({"schema": 2})"), HasSubstr("recordings"));
  EXPECT_THAT(problem(R"({"schema": 2, "recordings": {}, "training": {"recording": "a"}})"),
              HasSubstr("frames"));
  EXPECT_THAT(problem(R"({"schema": 2, "recordings": {"training": {"video": "a", "film": 1}}})"),
              HasSubstr("film"));
}

}  // namespace
}  // namespace lararium::editor
