#include "web/tracker/posted_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lararium::web {
namespace {

vision::CameraEstimate Camera(double focal) {
  vision::CameraEstimate camera;
  camera.model = {.width = 64, .height = 48, .fx = focal, .fy = focal, .cx = 31.5, .cy = 23.5};
  camera.readout = {0.25, -0.5};
  camera.covariance(vision::kFocal, vision::kRadial1) = 1e-3;
  return camera;
}

SearchAnswer Answer(uint32_t number) {
  SearchAnswer answer;
  answer.number = number;
  answer.located.map = 1;
  vision::Location& location = answer.located.location;
  location.camera_from_map.emplace();
  location.camera_from_map->translation = {1.0, 2.0, 1.0 / 3.0};
  location.camera = Camera(70.0);
  location.matches = 40;
  location.inliers = 30;
  location.covariance(5, 4) = 1e-9;
  location.expected_error_px = 0.125;
  location.confidence = 0.9f;
  answer.points = {{7, 0.5f, {10.25f, 11.0f}}, {9, 0.75f, {12.0f, 13.5f}}};
  return answer;
}

vision::CameraGuess Guess() {
  return {Camera(50.0), {Camera(60.0).model, Camera(80.0).model}, geometry::Rigid3()};
}

TEST(SearchMessage, CarriesAQuestionExactly) {
  const SearchQuestion question{3, Guess()};
  const auto parsed = ParseQuestion(Numbers(question));
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  EXPECT_EQ(parsed->number, 3u);
  EXPECT_EQ(parsed->guess.prior.model, question.guess.prior.model);
  EXPECT_EQ(parsed->guess.prior.covariance, question.guess.prior.covariance);
  EXPECT_EQ(parsed->guess.candidates, question.guess.candidates);
  EXPECT_TRUE(parsed->guess.predicted.has_value());
}

TEST(SearchMessage, CarriesAnAnswerExactly) {
  const auto parsed = ParseAnswer(Numbers(Answer(4)));
  ASSERT_TRUE(parsed.ok()) << parsed.message();
  const vision::Location& location = parsed->located.location;
  EXPECT_EQ(parsed->number, 4u);
  EXPECT_EQ(parsed->located.map, 1u);
  ASSERT_TRUE(location.camera_from_map.has_value());
  EXPECT_EQ(location.camera_from_map->translation, Eigen::Vector3d(1.0, 2.0, 1.0 / 3.0));
  EXPECT_EQ(location.camera.readout, Eigen::Vector2d(0.25, -0.5));
  EXPECT_EQ(location.covariance(5, 4), 1e-9);
  EXPECT_EQ(location.confidence, 0.9f);
  ASSERT_EQ(parsed->points.size(), 2u);
  EXPECT_EQ(parsed->points[1].point, 9u);
  EXPECT_EQ(parsed->points[1].pixel, Eigen::Vector2f(12.0f, 13.5f));
}

TEST(SearchMessage, RefusesWhatIsCutOrNoNumberOfItsKind) {
  const std::vector<double> numbers = Numbers(Answer(4));
  for (size_t size = 0; size < numbers.size(); ++size) {
    EXPECT_FALSE(ParseAnswer(std::span(numbers).first(size)).ok()) << size;
  }
  for (const double odd : {-1.0, 1e12, std::numeric_limits<double>::quiet_NaN()}) {
    std::vector<double> damaged = numbers;
    damaged[1] = odd;  // the index of the map
    EXPECT_FALSE(ParseAnswer(damaged).ok()) << odd;
  }
}

TEST(PostedSearch, TakesTheAnswerToItsQuestion) {
  PostedSearch search({100, 10});
  search.Begin(cv::Mat(48, 64, CV_8UC1), Guess());
  const auto question = ParseQuestion(search.question());
  ASSERT_TRUE(question.ok());
  search.Posted();
  EXPECT_TRUE(search.question().empty());
  EXPECT_TRUE(search.busy());
  EXPECT_FALSE(search.Take(false).has_value());
  ASSERT_TRUE(search.Answer(Numbers(Answer(question->number))).ok());
  const auto located = search.Take(false);
  ASSERT_TRUE(located.has_value());
  EXPECT_EQ(located->location.inliers, 30);
  EXPECT_EQ(search.points().size(), 2u);
  EXPECT_FALSE(search.busy());
}

TEST(PostedSearch, IgnoresAnswersToDroppedQuestions) {
  PostedSearch search({100, 10});
  search.Begin(cv::Mat(48, 64, CV_8UC1), Guess());
  const uint32_t dropped = ParseQuestion(search.question())->number;
  search.Drop();
  EXPECT_TRUE(search.Answer(Numbers(Answer(dropped))).ok());
  search.Begin(cv::Mat(48, 64, CV_8UC1), Guess());
  EXPECT_TRUE(search.Answer(Numbers(Answer(dropped))).ok());
  EXPECT_FALSE(search.Take(false).has_value());
}

TEST(PostedSearch, RefusesPointsAndMapsThatDoNotExist) {
  for (const std::vector<size_t>& points : {std::vector<size_t>{100, 9}, {100}}) {
    PostedSearch search(points);
    search.Begin(cv::Mat(48, 64, CV_8UC1), Guess());
    const Status status = search.Answer(Numbers(Answer(1)));
    EXPECT_FALSE(status.ok());
    EXPECT_NE(status.message().find("open the same maps in both workers"), std::string::npos);
    EXPECT_FALSE(search.Take(false).has_value());
  }
}

}  // namespace
}  // namespace lararium::web
