#include "editor/cli/object_commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "editor/import/objects/object_library.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

using testing::HasSubstr;

class ObjectCommands : public testing::Test {
 protected:
  ObjectCommands() {
    EXPECT_TRUE(CreateProject(paths_, "Tavern").ok());
    ProjectDocument document = *LoadProject(paths_);
    document.places.emplace_back().name = "bar";
    EXPECT_TRUE(SaveProject(paths_, document).ok());
  }

  Result<CommandResult> Object(ObjectOptions options) {
    options.project = paths_.folder;
    return RunObject(options);
  }
  Result<CommandResult> Sound(SoundOptions options) {
    options.project = paths_.folder;
    return RunSound(options);
  }
  ProjectDocument Saved() { return *LoadProject(paths_); }

  const test::TemporaryFolder folder_;
  const ProjectPaths paths_{folder_ / "tavern.lararium"};
  const std::string model_ = import::LibraryObjectNames().front();
};

TEST_F(ObjectCommands, AThingIsAddedPlacedAndRemoved) {
  const auto added = Object({.add = "jug", .model = model_, .at = {1, 0.9, -2}});
  ASSERT_TRUE(added.ok()) << added.message();
  EXPECT_THAT(added->text,
              HasSubstr("jug: " + model_ + ", from the library; at 1.000,0.900,-2.000"));
  ASSERT_TRUE(Object({.set = "jug", .heading = 45.0}).ok());
  EXPECT_EQ(Saved().objects[0].position, Eigen::Vector3d(1, 0.9, -2)) << "as it was";
  EXPECT_EQ(Saved().objects[0].heading, 45.0);
  ASSERT_TRUE(Object({.set = "jug", .file = paths_.folder / "models" / "jug.glb"}).ok());
  EXPECT_EQ(Saved().objects[0].file, "models/jug.glb");
  EXPECT_EQ(Saved().objects[0].model, "") << "it is one or the other";
  ASSERT_TRUE(Object({.remove = "jug"}).ok());
  EXPECT_THAT(Object({})->text, HasSubstr("no objects"));
}

TEST_F(ObjectCommands, WhatNoThingIsCalledIsTold) {
  ASSERT_TRUE(Object({.add = "jug", .model = model_}).ok());
  const Json before = FormatProject(Saved());
  EXPECT_THAT(Object({.add = "jug", .model = model_}).status().message(), HasSubstr("already"));
  EXPECT_THAT(Object({.set = "mug", .heading = 1.0}).status().message(),
              HasSubstr("no object \"mug\"; it has jug"));
  EXPECT_THAT(Object({.remove = "mug"}).status().message(), HasSubstr("no object \"mug\""));
  EXPECT_EQ(FormatProject(Saved()), before);
}

TEST_F(ObjectCommands, APlaceSoundsAsIsSaid) {
  ASSERT_TRUE(Sound({.reverb = "vault", .reverb_gain = -3.0}).ok());
  ASSERT_TRUE(Sound({.ambience = "fire", .gain = -6.0, .at = {1, 0, -2}}).ok());
  ASSERT_TRUE(Sound({.ambience = "street"}).ok());
  stage::Acoustics acoustics = Saved().places[0].acoustics;
  EXPECT_EQ(acoustics.reverb, stage::Reverb::kVault);
  EXPECT_EQ(acoustics.reverb_db, -3.0f);
  ASSERT_EQ(acoustics.ambience.size(), 2u);
  EXPECT_EQ(acoustics.ambience[0].gain_db, -6.0f);
  EXPECT_EQ(acoustics.ambience[0].position, glm::vec3(1, 0, -2));
  ASSERT_TRUE(Sound({.ambience = "fire", .gain = 0.0}).ok());
  EXPECT_EQ(Saved().places[0].acoustics.ambience[0].position, glm::vec3(1, 0, -2)) << "as it was";
  ASSERT_TRUE(Sound({.remove_ambience = "street"}).ok());
  ASSERT_TRUE(Sound({.remove_ambience = "fire"}).ok());
  EXPECT_TRUE(Saved().places[0].acoustics.ambience.empty());
  EXPECT_EQ(Saved().places[0].acoustics.reverb, stage::Reverb::kVault);
}

TEST_F(ObjectCommands, ASoundIsBroughtInAndOneThatIsMissingIsTold) {
  ASSERT_TRUE(Sound({.ambience = "sea"}).ok());
  EXPECT_THAT(Sound({})->text, HasSubstr("asks for the sound \"sea\", which is not there"));
  EXPECT_THAT(Sound({.bring = "sea", .file = folder_ / "none.wav"}).status().message(),
              HasSubstr("none.wav"));
}

TEST_F(ObjectCommands, WhatNoPlaceCanSoundLikeIsRefused) {
  const Json before = FormatProject(Saved());
  EXPECT_THAT(Sound({.reverb = "cave"}).status().message(), HasSubstr("choose one of none"));
  EXPECT_THAT(Sound({.reverb_gain = 100.0}).status().message(), HasSubstr("reverb_db"));
  EXPECT_THAT(Sound({.remove_ambience = "sea"}).status().message(),
              HasSubstr("not an ambient sound"));
  EXPECT_THAT(Sound({.place = "moon", .reverb = "hall"}).status().message(),
              HasSubstr("no place \"moon\""));
  EXPECT_EQ(FormatProject(Saved()), before);
}

}  // namespace
}  // namespace lararium::editor
