#include "tests/show/small_show.h"

#include <memory>

namespace lararium::test {
namespace {

human::Human OneJoint() {
  human::Human human;
  human.name = "one";
  human.skeleton.names = {"humanoid_root"};
  human.skeleton.parents = {human::Skeleton::kNoParent};
  human.skeleton.rest.resize(1);
  human.skeleton.joint_from_actor = {glm::mat4(1.0f)};
  human::Clip turn;
  turn.name = "turn";
  turn.duration = 1.0f;
  turn.keys_per_second = 2.0f;
  turn.keys.resize(3);
  for (size_t key = 0; key < turn.keys.size(); ++key) {
    turn.keys[key].translation.y = 0.5f * static_cast<float>(key);
  }
  human.clips = {turn};
  return human;
}

stage::Place Place(const char* name, double map_units_per_metre, float light) {
  stage::Place place;
  place.name = name;
  place.map_from_stage.scale = map_units_per_metre;
  place.probes.emplace_back().light.sky[0] = glm::vec3(light);
  return place;
}

}  // namespace

show::ShowContent SmallContent() {
  show::ShowContent content;
  content.title = "small";
  content.cast = {{"one", std::make_shared<const human::Human>(OneJoint())}};
  content.places = {{Place("bar", 2.0, 1.0f), nullptr}, {Place("yard", 0.5, 3.0f), nullptr}};
  content.drama_file = "drama.lua";
  content.drama = R"(
    track{actor = "one", clips = {
      {at = 0, clip = "turn", length = 1, from = {x = 0, z = 0}, to = {x = 1, z = 0}},
    }}
  )";
  return content;
}

Result<std::optional<geometry::Frame>> FakeSource::Next() {
  if (next_ == fail_at_) {
    return Status::Error("fake", "broken");
  }
  if (next_ == count_) {
    return std::optional<geometry::Frame>();
  }
  geometry::Frame frame;
  frame.index = next_;
  frame.capture_time = 7.0 + static_cast<double>(next_) / 30.0;
  frame.bgr = cv::Mat::zeros(height(), width(), CV_8UC3);
  frame.grey = cv::Mat::zeros(height(), width(), CV_8UC1);
  ++next_;
  return std::optional(frame);
}

Status FakeSource::Seek(int64_t index) {
  next_ = index;
  return Status();
}

vision::TrackedFrame FakePoses::Track(const geometry::Frame& frame) {
  seen_.push_back(frame.index);
  vision::TrackedFrame tracked;
  tracked.frame = frame;
  if (lost_every_ == 0 || frame.index % lost_every_ != 0) {
    tracked.state = vision::TrackState::kTracking;
    tracked.camera_from_map = geometry::Rigid3{Eigen::Quaterniond::Identity(), {0.0, 0.0, 4.0}};
    tracked.inliers = 10;
  }
  return tracked;
}

}  // namespace lararium::test
