#include "shared/show/lod_streamer.h"

#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>

#include <chrono>
#include <glm/geometric.hpp>
#include <sstream>
#include <thread>
#include <utility>

#include "shared/show/show.h"
#include "tests/show/small_show.h"
#include "tests/stage/test_props.h"

namespace lararium::show {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A person as read from a file with levels of 0, 10 and 40 mm.
DrawnPerson Person(float finest) {
  human::Human human = *test::SmallContent().cast[0].human;
  human::SkinnedMesh& mesh = human.meshes.emplace_back();
  mesh.error = finest >= 0.04f ? 0.04f : finest >= 0.01f ? 0.01f : 0.0f;
  return {std::make_shared<const human::Human>(std::move(human)), nullptr};
}

CastMember Member(float finest) {
  CastMember member;
  member.name = "one";
  member.human = Person(finest).human;
  member.finest = finest;
  return member;
}

class FinerCastTest : public ::testing::Test {
 protected:
  void Create(float first, float second = 0.04f) {
    const std::vector<CastMember> cast = {Member(first), Member(second)};
    finer_.emplace(
        [this](size_t who, float finest) -> Result<DrawnPerson> {
          asked_.emplace_back(who, finest);
          if (broken_) {
            return Status::Error("one.larhuman", "was changed");
          }
          return Person(finest);
        },
        cast, log_);
  }

  std::optional<LodStreamer::Person> Wait() {
    for (int i = 0; i < 1000; ++i) {
      if (auto person = finer_->Take()) {
        return person;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(broken_ ? 0 : 2));
    }
    return std::nullopt;
  }

  std::ostringstream said_;
  Log log_{"test", std::make_shared<spdlog::sinks::ostream_sink_st>(said_)};
  std::vector<std::pair<size_t, float>> asked_;
  bool broken_ = false;
  std::optional<LodStreamer> finer_;
};

TEST_F(FinerCastTest, NobodyIsReadAgainWhoIsFineEnough) {
  Create(0.01f);
  finer_->Want(0, 0.01f);
  finer_->Want(0, 0.5f);
  finer_->Want(1, 0.04f);
  EXPECT_FALSE(finer_->Take());
  EXPECT_TRUE(asked_.empty());
}

TEST_F(FinerCastTest, WhoComesNearerIsReadFinerThanWantedUntilThereIsNoMore) {
  Create(0.04f);
  finer_->Want(0, 0.02f);
  finer_->Want(1, 0.02f);  // Only one is read at a time.
  EXPECT_NE(finer_->reading(), LodStreamer::Reading::kNobody);
  while (finer_->reading() == LodStreamer::Reading::kSomebody) {
    std::this_thread::yield();
  }
  EXPECT_EQ(finer_->reading(), LodStreamer::Reading::kDone);
  std::optional<LodStreamer::Person> person = Wait();
  ASSERT_TRUE(person);
  EXPECT_EQ(finer_->reading(), LodStreamer::Reading::kNobody);
  EXPECT_EQ(person->cast, 0u);
  EXPECT_EQ(person->figure.human->meshes.back().error, 0.01f);
  ASSERT_EQ(asked_.size(), 1u);
  EXPECT_LT(asked_[0].second, 0.02f);

  finer_->Want(0, 0.02f);
  EXPECT_FALSE(finer_->Take());
  finer_->Want(1, 0.02f);
  person = Wait();
  ASSERT_TRUE(person);
  EXPECT_EQ(person->cast, 1u);

  finer_->Want(0, 0.001f);
  person = Wait();
  ASSERT_TRUE(person);
  EXPECT_EQ(person->figure.human->meshes.back().error, 0.0f);
  finer_->Want(0, 1e-6f);
  EXPECT_FALSE(finer_->Take());
  EXPECT_EQ(asked_.size(), 3u);
}

TEST_F(FinerCastTest, WhoCannotBeReadStaysAndTheLogSaysWhyOnce) {
  broken_ = true;
  Create(0.04f);
  finer_->Want(0, 0.02f);
  while (said_.str().empty()) {
    EXPECT_FALSE(finer_->Take());
  }
  EXPECT_THAT(said_.str(), HasSubstr("one.larhuman: was changed"));
  finer_->Want(0, 0.02f);
  EXPECT_FALSE(Wait());
  EXPECT_EQ(asked_.size(), 1u);
}

TEST_F(FinerCastTest, AWholeCastHasNoMore) {
  LodStreamer whole({}, std::vector<CastMember>{Member(0.04f)}, log_);
  whole.Want(0, 0.001f);
  EXPECT_FALSE(whole.Take());
}

// A person with a sheet that is lit.
human::Human Lit() {
  human::Human human = *test::SmallContent().cast[0].human;
  human.meshes.resize(1);
  human::SkinnedMesh& mesh = human.meshes[0];
  mesh = {};
  mesh.name = "sheet";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  mesh.normals.assign(4, glm::vec3(0.0f, 0.0f, 1.0f));
  mesh.albedo.assign(4, glm::vec3(0.5f));
  mesh.joints.assign(4, {0, 0, 0, 0});
  mesh.weights.assign(4, glm::vec4(1.0f, 0.0f, 0.0f, 0.0f));
  mesh.indices = {0, 1, 2, 2, 1, 3};
  mesh.coarser = {{0.05f, {0, 1, 2}}};
  human::LightTransfer& light = human.light;
  light.count = 9;
  light.key_poses = {human.skeleton.rest};
  light.receivers = {{0, {0.5f, 0.5f, 0.1f}}};
  light.meshes.resize(1);
  light.meshes[0].receivers.assign(4, {0, 0, 0, 0});
  light.meshes[0].weights.assign(4, {255, 0, 0, 0});
  for (int i = 0; i < 4 * 3 * 9; ++i) {
    light.meshes[0].coefficients.push_back(static_cast<int8_t>(i * 37 % 127));
  }
  light.meshes[0].scale.assign(4, 0.01f);
  return human;
}

vision::TrackedFrame FrameAt(int64_t index) {
  geometry::Frame frame;
  frame.index = index;
  frame.capture_time = static_cast<double>(index) / 30.0;
  vision::TrackedFrame tracked = test::FakePoses().Track(frame);
  tracked.camera = {64, 48, 60.0, 60.0, 31.5, 23.5};
  return tracked;
}

// A show whose cast was read again equals a show that read all detail at the beginning.
TEST(ShowWithFinerCast, IsThenAsIfAllHadBeenReadAtOnce) {
  const std::vector<std::byte> whole = human::SerializeHuman(Lit());
  human::TexturePool textures;
  const ReadPerson read = [&](size_t, float finest) -> Result<DrawnPerson> {
    LARARIUM_ASSIGN_OR_RETURN(human::Human human, human::ParseHuman(whole, "here", finest));
    return MakeDrawnPerson(std::move(human), textures);
  };
  const std::shared_ptr<Log> silent = MakeSilentLog();
  const auto create = [&](float finest) {
    ShowContent content = test::SmallContent();
    content.places[0].stage.probes.emplace_back().light.sky[0] = glm::vec3(1.0f);
    content.cast = {MakeCastMember(*human::ParseHuman(whole, "here", finest), finest, textures)};
    content.cast[0].name = "one";
    content.finer = finest > 0.0f ? read : ReadPerson();
    return Show::Create(std::move(content), {}, *silent);
  };
  auto coarse = create(1.0f);
  auto fine = create(0.0f);
  ASSERT_TRUE(coarse.ok()) << coarse.message();
  ASSERT_TRUE(fine.ok());
  (*coarse)->detail().SetSeenAround(true);
  (*fine)->detail().SetSeenAround(true);
  StagedFrame by_coarse;
  StagedFrame by_fine;
  for (int64_t i = 0; i < 3000; ++i) {
    const vision::TrackedFrame tracked = FrameAt(i);
    (*coarse)->StageFrame(tracked, tracked.frame.capture_time, by_coarse);
    (*fine)->StageFrame(tracked, tracked.frame.capture_time, by_fine);
    ASSERT_EQ(by_coarse.people.actors.size(), 1u);
    const StagedActor& actor = by_coarse.people.actors[0];
    EXPECT_EQ(actor.light_count, actor.figure->meshes[0].positions.size());
    if (actor.light_count == 4) {
      EXPECT_EQ(actor.detail, by_fine.people.actors[0].detail);
      EXPECT_EQ(by_coarse.light.on_people, by_fine.light.on_people);
      EXPECT_EQ(by_coarse.people.skin, by_fine.people.skin);
      return;
    }
    ASSERT_EQ(actor.light_count, 3u);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  FAIL() << "nobody became finer";
}

// A show of which a person comes while it plays equals a show with all people from the beginning.
TEST(ShowWithArrivingCast, IsTheSameDramaAndThenTheSamePicture) {
  human::TexturePool textures;
  const std::shared_ptr<Log> silent = MakeSilentLog();
  const auto member = [&](bool whole) {
    human::Human human = Lit();
    if (!whole) {
      human.meshes.clear();
      human.light = {};
    }
    return MakeCastMember(std::move(human), 0.0f, textures);
  };
  const auto table = [](bool whole) {
    stage::Prop prop = test::MakeTable();
    if (whole) {
      prop.light.count = 9;
      prop.light.key_poses.resize(1, std::vector<human::JointTransform>(1));
      prop.light_shown = {1};
      prop.light.receivers = {{0, {0.0f, 1.0f, 0.0f}}};
      prop.light.meshes = {{std::vector<std::array<uint16_t, 4>>(8),
                            std::vector<std::array<uint8_t, 4>>(8, {255, 0, 0, 0}),
                            std::vector<int8_t>(8 * 27, 40),
                            std::vector<float>(8, 0.01f),
                            {}}};
    }
    auto model = *stage::ObjectModel::Create(std::move(prop), "table");
    StageObject object{"table", model, {}};
    object.light = TakeLight(model->light());
    return object;
  };
  const auto create = [&](bool whole) {
    ShowContent content = test::SmallContent();
    content.places[0].stage.probes.emplace_back().light.sky[0] = glm::vec3(1.0f);
    content.cast = {member(whole)};
    content.cast[0].name = "one";
    content.objects = {table(whole)};
    return Show::Create(std::move(content), {}, *silent);
  };
  auto arriving = create(false);
  auto all = create(true);
  ASSERT_TRUE(arriving.ok()) << arriving.message();
  ASSERT_TRUE(all.ok()) << all.message();
  (*arriving)->detail().SetSeenAround(true);
  (*all)->detail().SetSeenAround(true);
  StagedFrame by_arriving;
  StagedFrame by_all;
  constexpr int64_t kArrives = 12;
  for (int64_t i = 0; i < 2 * kArrives; ++i) {
    if (i == kArrives) {
      (*arriving)->SetPerson(0, member(true));
      (*arriving)->SetObjects({table(true)});
    }
    const vision::TrackedFrame tracked = FrameAt(i);
    (*arriving)->StageFrame(tracked, tracked.frame.capture_time, by_arriving);
    (*all)->StageFrame(tracked, tracked.frame.capture_time, by_all);
    ASSERT_EQ(by_arriving.people.actors.size(), 1u);
    EXPECT_EQ(by_arriving.people.actors[0].stage_from_actor,
              by_all.people.actors[0].stage_from_actor);
    EXPECT_EQ(by_arriving.people.skin, by_all.people.skin);
    EXPECT_EQ(by_arriving.light.on_people.size(), i < kArrives ? 0u : 4u);
    EXPECT_EQ(by_arriving.things.objects.size(), 1u);
    EXPECT_EQ(by_arriving.light.on_things.size(), i < kArrives ? 0u : 8u);
  }
  // Light that hardly changes is not computed again.
  for (size_t v = 0; v < by_all.light.on_people.size(); ++v) {
    EXPECT_LT(glm::distance(by_arriving.light.on_people[v], by_all.light.on_people[v]), 0.01f) << v;
  }
  EXPECT_EQ(by_arriving.light.on_things, by_all.light.on_things);
  EXPECT_EQ(by_arriving.people.actors[0].detail, by_all.people.actors[0].detail);
  EXPECT_EQ((*arriving)->content().cast[0].name, "one");
}

}  // namespace
}  // namespace lararium::show
