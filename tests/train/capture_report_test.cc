#include "editor/train/capture_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <opencv2/core.hpp>
#include <optional>
#include <regex>
#include <set>

#include "editor/train/capture_analysis.h"
#include "shared/core/file.h"
#include "tests/support/synthetic_world.h"
#include "tests/support/test_files.h"

namespace lararium::train {
namespace {

using geometry::Rigid3;
using lararium::test::LookAt;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

vision::SceneDatabase MakeDatabase() {
  vision::SceneDatabase db =
      lararium::test::MakeSceneDatabase(lararium::test::MakeSyntheticWorld({.points = 300}));
  for (vision::Keyframe& keyframe : db.keyframes) {
    keyframe.frame_index *= 2;  // every second frame of its video
  }
  return db;
}

// The report of a training on the database's keyframes and one more frame between each two of them.
TrainReport MakeReport(const vision::SceneDatabase& db) {
  TrainReport report;
  for (size_t k = 0; k < db.keyframes.size(); ++k) {
    for (int between = 0; between < 2; ++between) {
      FrameReport frame;
      frame.frame_index = db.keyframes[k].frame_index + between;
      frame.keyframe = between == 0;
      frame.name = between == 0 ? db.keyframes[k].name : "between" + std::to_string(k);
      frame.camera_from_map = db.keyframes[k].camera_from_map;
      frame.features = 800;
      frame.observations = 400;
      frame.median_error_px = 0.3;
      frame.motion = {0.01, 100.0};
      report.frame_reports.push_back(frame);
      report.located.push_back(
          {frame.frame_index, frame.name, *frame.camera_from_map, frame.keyframe});
    }
  }
  report.frames = static_cast<int>(report.frame_reports.size());
  report.keyframes = static_cast<int>(db.keyframes.size());
  report.points = static_cast<int>(db.points.size());
  report.camera = db.camera;
  report.seconds = {{"reading", 1.5}, {"matching", 2.25}};
  return report;
}

void Unlocate(TrainReport& report, size_t first, size_t last) {
  for (size_t i = first; i <= last; ++i) {
    report.frame_reports[i].camera_from_map.reset();
    report.frame_reports[i].observations = 0;
    report.unlocated.push_back(report.frame_reports[i].name);
    std::erase_if(report.located, [&](const LocatedFrame& frame) {
      return frame.frame_index == report.frame_reports[i].frame_index;
    });
  }
}

std::vector<std::string> Said(const std::vector<CaptureAdvice>& advice) {
  std::vector<std::string> sentences;
  for (const CaptureAdvice& one : advice) {
    sentences.push_back(AdviceSentence(one).English());
  }
  return sentences;
}

std::vector<std::string> AdviceOf(const TrainReport& report,
                                  const vision::SceneDatabase& database,
                                  std::optional<double> metres_per_unit) {
  return Said(AnalyseCapture(report, database, metres_per_unit).advice);
}

std::string ValueOf(const std::string& html, const std::string& name) {
  std::smatch match;
  const std::regex pattern("data-" + name + "=\"([^\"]*)\"");
  EXPECT_TRUE(std::regex_search(html, match, pattern)) << name;
  return match.empty() ? "" : match[1].str();
}

std::vector<size_t> CountsOf(const std::string& html, const std::string& histogram) {
  const size_t begin = html.find("data-histogram=\"" + histogram + "\"");
  EXPECT_NE(begin, std::string::npos);
  const std::string svg = html.substr(begin, html.find("</svg>", begin) - begin);
  std::vector<size_t> counts;
  const std::regex pattern("data-count=\"([0-9]+)\"");
  for (std::sregex_iterator at(svg.begin(), svg.end(), pattern), end; at != end; ++at) {
    counts.push_back(std::stoul((*at)[1]));
  }
  return counts;
}

size_t Sum(const std::vector<size_t>& counts) {
  return std::accumulate(counts.begin(), counts.end(), size_t{0});
}

TEST(CaptureReport, NumbersAreThoseOfTheMapAndTheTraining) {
  vision::SceneDatabase db = MakeDatabase();
  db.mean_reprojection_error_px = 0.3125;
  TrainReport report = MakeReport(db);
  Unlocate(report, 5, 7);
  const std::string html = FormatCaptureReport(report, db, {.database_bytes = 123456});
  EXPECT_EQ(ValueOf(html, "frames"), "24");
  EXPECT_EQ(ValueOf(html, "located"), "21");
  EXPECT_EQ(ValueOf(html, "missing"), "3");
  EXPECT_EQ(ValueOf(html, "keyframes"), std::to_string(db.keyframes.size()));
  EXPECT_EQ(ValueOf(html, "points"), std::to_string(db.points.size()));
  EXPECT_EQ(ValueOf(html, "observations"), std::to_string(db.observations.size()));
  EXPECT_EQ(ValueOf(html, "error"), "0.3125");
  EXPECT_EQ(ValueOf(html, "bytes"), "123456");
  EXPECT_EQ(std::stod(ValueOf(html, "focal")), db.camera.Focal());
  EXPECT_THAT(html, HasSubstr("3.8 s"));  // Total time.
}

TEST(CaptureReport, NamesStretchesThatLookLikeOtherParts) {
  vision::SceneDatabase db = MakeDatabase();
  db.lookalikes.assign(db.points.size(), 1);
  const std::vector<CaptureAdvice> advice = AnalyseCapture(MakeReport(db), db, std::nullopt).advice;
  EXPECT_EQ(std::ranges::count(advice, CaptureAdvice::Kind::kLookalikes, &CaptureAdvice::kind), 1);
  db.lookalikes.assign(db.points.size(), 0);
  for (const CaptureAdvice& other : AnalyseCapture(MakeReport(db), db, std::nullopt).advice) {
    EXPECT_NE(other.kind, CaptureAdvice::Kind::kLookalikes);
  }
}

TEST(CaptureReport, SaysThatTwinsInUnorderedImagesMayBeTakenForOne) {
  vision::SceneDatabase db = MakeDatabase();
  TrainReport report = MakeReport(db);
  const auto said = [&] {
    const std::vector<CaptureAdvice> advice = AnalyseCapture(report, db, std::nullopt).advice;
    return advice.front().kind == CaptureAdvice::Kind::kUnordered;
  };
  report.ordered = false;
  EXPECT_FALSE(said());  // No part looks like another one.
  db.lookalikes.assign(db.points.size(), 1);
  EXPECT_TRUE(said());
  report.ordered = true;
  EXPECT_FALSE(said());
}

TEST(CaptureReport, HistogramsCountEveryObservationAndPoint) {
  vision::SceneDatabase db = MakeDatabase();
  for (size_t i = 0; i < 50; ++i) {
    db.observations[i].x += 2.5f;  // Belongs to the bin up to 3 pixels.
  }
  const std::string html = FormatCaptureReport(MakeReport(db), db, {});
  const std::vector<size_t> reprojection = CountsOf(html, "reprojection");
  EXPECT_EQ(Sum(reprojection), db.observations.size());
  EXPECT_EQ(reprojection[0], db.observations.size() - 50);
  EXPECT_EQ(reprojection[10], 50u);
  const std::vector<size_t> tracks = CountsOf(html, "tracks");
  EXPECT_EQ(tracks[5], db.points.size());  // All were observed by 12 images: the bin 11-20.
  EXPECT_EQ(Sum(tracks), db.points.size());
  EXPECT_EQ(Sum(CountsOf(html, "parallax")), db.points.size());
}

TEST(CaptureReport, ParallaxIsTheWidestAngleBetweenTwoObservations) {
  vision::SceneDatabase db = MakeDatabase();
  db.points = {Eigen::Vector3f::Zero()};
  db.observation_counts = {3};
  db.observations.clear();
  for (uint32_t k = 0; k < 3; ++k) {
    const double angle = 0.1 * k;
    db.keyframes[k].camera_from_map =
        LookAt({4.0 * std::sin(angle), 0.0, -4.0 * std::cos(angle)}, Eigen::Vector3d::Zero());
    db.observations.push_back({0, k, 1.0f, 1.0f, 1.0f});
  }
  db.normals.resize(1);
  db.session_masks.resize(1);
  const CaptureAnalysis analysis = AnalyseCapture({}, db, std::nullopt);
  ASSERT_EQ(analysis.point_parallax.size(), 1u);
  EXPECT_NEAR(analysis.point_parallax[0], 0.2, 1e-6);
}

TEST(CaptureReport, EscapesEveryName) {
  vision::SceneDatabase db = MakeDatabase();
  const std::string evil = "<script>alert(\"x\")</script>&'";
  for (vision::Keyframe& keyframe : db.keyframes) {
    keyframe.name = evil + keyframe.name;
  }
  TrainReport report = MakeReport(db);
  for (FrameReport& frame : report.frame_reports) {
    frame.name = evil;
  }
  for (LocatedFrame& frame : report.located) {
    frame.name = evil;
  }
  report.seconds.emplace_back(evil, 1.0);
  Unlocate(report, 4, 9);
  const std::string html =
      FormatCaptureReport(report, db, {.title = evil, .source = evil, .frame_image = [](int64_t) {
                                         return cv::Mat(40, 60, CV_8UC3, cv::Scalar(1, 2, 3));
                                       }});
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("alert(\"")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(&quot;x&quot;)&lt;/script&gt;&amp;&#39;"));
}

TEST(CaptureReport, HoldsEverythingWithinItself) {
  vision::SceneDatabase db = MakeDatabase();
  db.colours.assign(db.points.size(), {0.5f, 0.5f, 0.5f});
  TrainReport report = MakeReport(db);
  Unlocate(report, 4, 9);
  const std::string html = FormatCaptureReport(report, db, {.title = "Tavern"});
  for (const char* fetched : {"http:", "https:", "<script", "<link", "@import", "url(", "href"}) {
    EXPECT_THAT(html, Not(HasSubstr(fetched)));
  }
  size_t pictures = 0;
  for (size_t at = html.find("src="); at != std::string::npos; at = html.find("src=", at + 1)) {
    EXPECT_EQ(html.compare(at, 28, "src=\"data:image/jpeg;base64,"), 0);
    ++pictures;
  }
  EXPECT_GE(pictures, 3u);  // Frames between keyframes have no pictures.
}

TEST(CaptureReport, ClosesEveryElementThatItOpens) {
  vision::SceneDatabase db = MakeDatabase();
  db.colours.assign(db.points.size(), {0.5f, 0.5f, 0.5f});
  TrainReport report = MakeReport(db);
  Unlocate(report, 4, 9);
  const std::string html = FormatCaptureReport(report, db, {});
  static const std::set<std::string> kVoid = {"meta", "img", "br"};
  std::vector<std::string> open;
  const std::regex tag("<(/?)([a-z0-9]+)[^>]*?(/?)>");
  for (std::sregex_iterator at(html.begin(), html.end(), tag), end; at != end; ++at) {
    const std::string name = (*at)[2];
    if ((*at)[1].length() > 0) {
      ASSERT_FALSE(open.empty()) << name;
      EXPECT_EQ(open.back(), name);
      open.pop_back();
    } else if ((*at)[3].length() == 0 && !kVoid.contains(name)) {
      open.push_back(name);
    }
  }
  EXPECT_TRUE(open.empty());
}

TEST(CaptureReport, GivesTheSameBytesTwice) {
  const vision::SceneDatabase db = MakeDatabase();
  TrainReport report = MakeReport(db);
  Unlocate(report, 4, 9);
  EXPECT_EQ(FormatCaptureReport(report, db, {}), FormatCaptureReport(report, db, {}));
}

TEST(CaptureReport, TakesAMapWithoutATraining) {
  const vision::SceneDatabase db = MakeDatabase();  // Such as an imported map.
  EXPECT_THAT(FormatCaptureReport({}, db, {}), HasSubstr("</html>"));
}

TEST(CaptureReport, IsWrittenToAFileOrSaysWhyNot) {
  const vision::SceneDatabase db = MakeDatabase();
  const lararium::test::TemporaryFolder folder;
  const TrainReport report = MakeReport(db);
  ASSERT_TRUE(WriteCaptureReport(report, db, folder / "report.html", {}).ok());
  EXPECT_EQ(*ReadText(folder / "report.html"), FormatCaptureReport(report, db, {}));
  EXPECT_THAT(WriteCaptureReport(report, db, folder / "no/such.html", {}).message(),
              HasSubstr("such.html"));
  vision::SceneDatabase broken = db;
  broken.normals.clear();
  EXPECT_FALSE(WriteCaptureReport(report, broken, folder / "broken.html", {}).ok());
  EXPECT_FALSE(std::filesystem::exists(folder / "broken.html"));
}

TEST(CaptureAnalysis, TellsWhyFramesAreWeak) {
  const vision::SceneDatabase db = MakeDatabase();
  TrainReport report = MakeReport(db);
  auto& frames = report.frame_reports;
  Unlocate(report, 1, 1);  // Sharp, slow and rich, but it does not fit.
  Unlocate(report, 3, 4);
  frames[3].features = frames[4].features = 20;
  Unlocate(report, 6, 6);
  frames[6].motion.shift = 0.2;
  Unlocate(report, 8, 10);
  for (size_t i = 8; i <= 10; ++i) {
    frames[i].motion.sharpness = 10.0;
    frames[i].features = 20;  // An effect of the blur.
  }
  frames[12].observations = 20;  // Located with few points.
  const CaptureAnalysis analysis = AnalyseCapture(report, db, std::nullopt);
  const std::vector<std::tuple<size_t, size_t, WeakReason, bool>> expected = {
      {1, 1, WeakReason::kNotLocated, false}, {3, 4, WeakReason::kFewFeatures, false},
      {6, 6, WeakReason::kFastMotion, false}, {8, 10, WeakReason::kBlur, false},
      {12, 12, WeakReason::kFewPoints, true},
  };
  ASSERT_EQ(analysis.weak.size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) {
    const WeakFrames& weak = analysis.weak[i];
    EXPECT_EQ(std::tuple(weak.first, weak.last, weak.reason, weak.located), expected[i]) << i;
  }
  EXPECT_THAT(Said(analysis.advice),
              Contains(HasSubstr("frames 4.png to 5.png could not be located (blurred)")));
}

TEST(CaptureAnalysis, AsksForAWalkWhereThingsWereSeenFromOneSideOnly) {
  vision::SceneDatabase db = MakeDatabase();
  EXPECT_THAT(AdviceOf({}, db, std::nullopt), Not(Contains(HasSubstr("from one side only"))));
  const Eigen::Vector3d from = db.keyframes[0].camera_from_map.Center();
  for (size_t k = 0; k < db.keyframes.size(); ++k) {
    const Eigen::Vector3d step(0.01 * static_cast<double>(k), 0.0, 0.0);
    db.keyframes[k].camera_from_map = LookAt(from + step, Eigen::Vector3d::Zero());
  }
  EXPECT_THAT(AdviceOf({}, db, std::nullopt), Contains(HasSubstr("from one side only")));
  // If the scale is known, in metres: 15 degrees at 4 map units of 0.5 m each.
  EXPECT_THAT(AdviceOf({}, db, 0.5), Contains(HasSubstr("by about 0.5 m")));
}

TEST(CaptureAnalysis, WarnsOfAFocalLengthThatIsNotCertain) {
  const vision::SceneDatabase db = MakeDatabase();
  TrainReport report = MakeReport(db);
  report.intrinsics_estimated = true;
  report.focal_deviation_px = 0.001 * db.camera.Focal();
  EXPECT_THAT(AdviceOf(report, db, std::nullopt), Not(Contains(HasSubstr("focal length"))));
  report.focal_deviation_px = 0.02 * db.camera.Focal();
  EXPECT_THAT(AdviceOf(report, db, std::nullopt),
              Contains(HasSubstr("focal length is known to 2.0 %")));
}

TEST(CaptureAnalysis, WarnsOfExposureThatChangedWhileFilming) {
  vision::SceneDatabase db = MakeDatabase();
  db.keyframes[3].gain = {8.0f, 8.0f, 8.0f};
  EXPECT_THAT(AdviceOf({}, db, std::nullopt), Contains(HasSubstr("Exposure changed by 3.0 stops")));
  db.keyframes[3].session = 1;  // Another session may be brighter.
  EXPECT_THAT(AdviceOf({}, db, std::nullopt), Not(Contains(HasSubstr("Exposure"))));
}

TEST(CaptureAnalysis, ThePlanHasTheViewAheadAtItsTop) {
  const vision::SceneDatabase db = MakeDatabase();
  const PlanView plan = AnalyseCapture({}, db, std::nullopt).plan;
  EXPECT_NEAR(plan.right.dot(plan.ahead), 0.0, 1e-12);
  EXPECT_NEAR(plan.right.dot(plan.up), 0.0, 1e-12);
  for (const vision::Keyframe& keyframe : db.keyframes) {
    const Rigid3 map_from_camera = keyframe.camera_from_map.Inverse();
    EXPECT_GT(plan.up.dot(map_from_camera.rotation * -Eigen::Vector3d::UnitY()), 0.5);
    EXPECT_GT(plan.ahead.dot(map_from_camera.rotation * Eigen::Vector3d::UnitZ()), 0.0);
    // A point to the right of the camera lies to the right in the plan.
    const Eigen::Vector3d aside = map_from_camera * Eigen::Vector3d(1.0, 0.0, 3.0);
    const Eigen::Vector3d before = map_from_camera * Eigen::Vector3d(0.0, 0.0, 3.0);
    EXPECT_GT(plan(aside).x(), plan(before).x());
  }
}

TEST(CaptureAnalysis, VisitorsNearThePathAreLocated) {
  const vision::SceneDatabase db = MakeDatabase();
  const CaptureAnalysis analysis = AnalyseCapture({}, db, std::nullopt);
  ASSERT_GT(analysis.places.size(), 50u);
  for (const StandingPlace& place : analysis.places) {
    double nearest = 1e9;
    for (const vision::Keyframe& keyframe : db.keyframes) {
      const Eigen::Vector2d at = analysis.plan(keyframe.camera_from_map.Center());
      nearest = std::min(nearest, (at - place.center).norm());
    }
    if (nearest < analysis.cell) {
      EXPECT_LT(QualityOf(place.prediction), ViewpointQuality::kNone);
    }
  }
}

}  // namespace
}  // namespace lararium::train
