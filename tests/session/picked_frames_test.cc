#include "editor/jobs/picked_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/jobs/drawn_occluder.h"
#include "editor/session/frame_to_pick.h"
#include "tests/support/synthetic_world.h"

namespace lararium::editor {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

class PickedFramesTest : public testing::Test {
 protected:
  // A frame between two cameras of the arc.
  PreviewPicture Picture(int64_t frame, size_t camera) {
    PreviewPicture picture;
    picture.frame = frame;
    picture.name = std::to_string(frame) + ".png";
    picture.camera = map_->camera;
    picture.grey = cv::Mat(map_->camera.height, map_->camera.width, CV_8UC1, cv::Scalar(90));
    picture.camera_from_map = test::LookAt(0.5 * (world_.cameras_from_world[camera].Center() +
                                                  world_.cameras_from_world[camera + 1].Center()),
                                           Vector3d::Zero());
    return picture;
  }

  const test::SyntheticWorld world_ = test::MakeSyntheticWorld({});
  std::shared_ptr<const vision::SceneDatabase> map_ =
      std::make_shared<const vision::SceneDatabase>(test::MakeSceneDatabase(world_));
};

TEST_F(PickedFramesTest, CornersInFramesThatWereNoKeyframesAreLocatedOnceTheseAreKept) {
  const std::vector<Vector3d> face = {{-0.4, -0.2, 0.3}, {0.4, -0.2, 0.3}, {0.0, 0.3, 0.3}};
  OccluderDocument occluder;
  occluder.name = "counter";
  for (const auto& [frame, camera] : {std::pair(1001, 0), {1007, 9}}) {
    const FrameToPick picked =
        FindFrameToPick(Picture(frame, static_cast<size_t>(camera)), *map_, true);
    ASSERT_TRUE(picked.keyframe) << picked.problem;
    for (size_t corner = 0; corner < face.size(); ++corner) {
      SetCorner(occluder, corner, *picked.keyframe,
                *map_->camera.Project(picked.keyframe->camera_from_map * face[corner]));
    }
    EXPECT_FALSE(DrawOccluder(occluder, *map_, 1.0).ok());
    map_ = WithFrame(map_, *picked.keyframe);
  }
  const Result<DrawnOccluder> drawn = DrawOccluder(occluder, *map_, 1.0);
  ASSERT_TRUE(drawn.ok()) << drawn.message();
  EXPECT_LT(drawn->error_px, 1e-6);
  for (size_t corner = 0; corner < face.size(); ++corner) {
    EXPECT_LT((drawn->corners[corner].point_in_map - face[corner]).norm(), 1e-6) << corner;
  }
  EXPECT_TRUE(map_->Validate().ok());
}

TEST_F(PickedFramesTest, AKeyframeStaysTheMapsOwnAndItsMapTheSame) {
  const vision::Keyframe& known = map_->keyframes[3];
  const FrameToPick picked = FindFrameToPick(Picture(known.frame_index, 7), *map_, true);
  ASSERT_TRUE(picked.keyframe);
  EXPECT_EQ(picked.keyframe->camera_from_map.translation, known.camera_from_map.translation);
  EXPECT_EQ(WithFrame(map_, *picked.keyframe), map_);
  const auto more = WithFrame(map_, *FindFrameToPick(Picture(1001, 0), *map_, true).keyframe);
  EXPECT_EQ(more->keyframes.size(), map_->keyframes.size() + 1);
  EXPECT_EQ(more->keyframes.back().name, "1001.png");
}

TEST_F(PickedFramesTest, SaysWhyAFrameCannotBePickedIn) {
  const PreviewPicture picture = Picture(1001, 0);
  EXPECT_THAT(FindFrameToPick(picture, *map_, false).problem, HasSubstr("training recording"));
  EXPECT_FALSE(FindFrameToPick(Picture(map_->keyframes[3].frame_index, 0), *map_, false).keyframe)
      << "a frame of that number of another recording";
  PreviewPicture lost = picture;
  lost.camera_from_map.reset();
  EXPECT_THAT(FindFrameToPick(lost, *map_, true).problem, HasSubstr("does not locate"));
  PreviewPicture smaller = picture;
  smaller.camera = smaller.camera.Resized(320, 240);
  EXPECT_THAT(FindFrameToPick(smaller, *map_, true).problem, HasSubstr("not as it was"));
}

}  // namespace
}  // namespace lararium::editor
