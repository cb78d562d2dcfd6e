// The camera view with a recording.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "editor/session/preview.h"
#include "tests/show/small_show.h"
#include "tests/vision/poster.h"

namespace lararium::editor {
namespace {

using Picture = std::shared_ptr<const PreviewPicture>;

// A camera in front of a poster.
class PosterRecording : public capture::FrameSource {
 public:
  explicit PosterRecording(cv::Mat poster) : poster_(std::move(poster)) {}

  Result<std::optional<geometry::Frame>> Next() override {
    return std::optional(test::PhotographPoster(poster_, test::PosterPose(0.0, 0.0, 1.5), next_++));
  }
  Status Seek(int64_t index) override {
    next_ = index;
    return Status();
  }
  std::optional<int64_t> frame_count() const override { return 10; }
  int width() const override { return test::kPosterCamera.width; }
  int height() const override { return test::kPosterCamera.height; }
  double frames_per_second() const override { return 30.0; }
  bool live() const override { return false; }
  std::string FrameName(int64_t index) const override { return capture::NumberedFrameName(index); }

 private:
  cv::Mat poster_;
  int64_t next_ = 0;
};

// A person that consists of a sheet: four corners in full detail, otherwise three.
human::Human Sheet(bool full) {
  human::Human human = *test::SmallContent().cast[0].human;
  human::SkinnedMesh& mesh = human.meshes.emplace_back();
  mesh.name = "sheet";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.indices = {0, 1, 2};
  mesh.error = full ? 0.0f : 0.5f;
  if (full) {
    mesh.positions.emplace_back(1, 1, 0);
    mesh.indices.insert(mesh.indices.end(), {2, 1, 3});
  }
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
  mesh.albedo.assign(mesh.positions.size(), glm::vec3(0.5f));
  mesh.joints.assign(mesh.positions.size(), {0, 0, 0, 0});
  mesh.weights.assign(mesh.positions.size(), glm::vec4(1.0f, 0.0f, 0.0f, 0.0f));
  return human;
}

class PreviewTest : public testing::Test {
 protected:
  PreviewTest() : poster_(test::MakePoster()) {
    content_ = test::SmallContent();
    content_.places.resize(1);
    content_.places[0].map = test::MapOfPoster(poster_);
    content_.places[0].stage.map_from_stage = {};
    content_.cast = {show::MakeCastMember(Sheet(false), 0.5f, textures_)};
    content_.cast[0].name = "one";
    content_.finer = [this](size_t, float) -> Result<show::DrawnPerson> {
      while (!may_read_) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      ++read_;
      if (missing_) {
        return Status::Error("one.larhuman", "is gone");
      }
      return show::MakeDrawnPerson(Sheet(true), textures_);
    };
  }

  ~PreviewTest() override { may_read_ = true; }

  void Start() {
    preview_ = std::make_unique<Preview>(
        [this]() -> Result<std::unique_ptr<capture::FrameSource>> {
          return std::unique_ptr<capture::FrameSource>(new PosterRecording(poster_));
        },
        std::move(content_), *log_);
  }

  void Ask(int64_t frame, double time = 0.0) {
    PreviewRequest request;
    request.frame = frame;
    request.time = time;
    preview_->Request(std::move(request));
  }

  // The next picture within a time limit; the default is 20 seconds.
  Picture Next(int milliseconds = 20000) {
    for (int waited = 0; waited < milliseconds && !preview_->failed(); waited += 2) {
      if (auto picture = preview_->TakePicture()) {
        return *picture;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return nullptr;
  }

  static size_t CornersOf(const PreviewPicture& picture) {
    return picture.actors.size() == 1 ? picture.actors[0].human->meshes.back().positions.size() : 0;
  }

  cv::Mat poster_;
  human::TexturePool textures_;
  std::atomic<bool> may_read_ = false;
  std::atomic<int> read_ = 0;
  bool missing_ = false;
  show::ShowContent content_;
  std::shared_ptr<Log> log_ = MakeSilentLog();
  std::unique_ptr<Preview> preview_;  // The last member, because its thread uses the others.
};

TEST_F(PreviewTest, APictureThatStandsIsDrawnAgainOnceWhoIsNearWasReadInMoreDetail) {
  Start();
  Ask(3, 0.5);
  const Picture first = Next();
  ASSERT_NE(first, nullptr);
  EXPECT_EQ(CornersOf(*first), 3u);
  may_read_ = true;
  const Picture again = Next();
  ASSERT_NE(again, nullptr);
  EXPECT_EQ(CornersOf(*again), 4u);
  EXPECT_EQ(again->frame, 3);
  EXPECT_EQ(again->time, 0.5);
  EXPECT_EQ(read_, 1);
  EXPECT_EQ(Next(200), nullptr) << "nothing has changed since";
}

TEST_F(PreviewTest, WhatIsAskedForDoesNotWaitForDetail) {
  Start();
  Ask(1);
  ASSERT_NE(Next(), nullptr);
  Ask(2);
  const Picture second = Next();
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(second->frame, 2);
  EXPECT_EQ(CornersOf(*second), 3u);
}

TEST_F(PreviewTest, WhoCannotBeReadAgainStaysAsTheyAre) {
  may_read_ = true;
  missing_ = true;
  Start();
  Ask(1);
  ASSERT_NE(Next(), nullptr);
  while (Next(200) != nullptr) {  // The picture is drawn again at most once.
  }
  Ask(2);
  const Picture second = Next();
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(CornersOf(*second), 3u);
  EXPECT_EQ(read_, 1);
}

}  // namespace
}  // namespace lararium::editor
