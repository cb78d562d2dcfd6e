#include "editor/document/missing_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string_view>
#include <vector>

#include "editor/session/workspace.h"
#include "shared/core/file.h"
#include "tests/audio/test_sounds.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

class MissingFilesTest : public testing::Test {
 protected:
  void Put(const fs::path& file) {
    fs::create_directories(file.parent_path());
    ASSERT_TRUE(WriteFileAtomically(file, std::string_view("content")).ok());
  }
  std::vector<std::string> Missing() {
    std::vector<std::string> names;
    for (const MissingFile& file : MissingFiles(paths_, document_)) {
      names.push_back(file.path);
    }
    return names;
  }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_ / "show.lararium"};
  std::string old_ = (folder_ / "old").string();
  ProjectDocument document_ = [this] {
    ProjectDocument document;
    PlaceDocument place;
    place.name = "tavern";
    place.training = {SourceDocument::Kind::kVideo, old_ + "/film/walk.mp4"};
    place.preview = place.training;
    place.added.push_back({{SourceDocument::Kind::kImages, old_ + "/film/evening"}, {}});
    OccluderDocument occluder;
    occluder.name = "counter";
    occluder.file = old_ + "/models/counter.glb";
    place.occluders.push_back(occluder);
    ProbeDocument probe;
    probe.name = "noon";
    probe.file = "probe.exr";
    place.probes.push_back(probe);
    document.places.push_back(place);
    CastDocument member;
    member.name = "keeper";
    member.model = old_ + "/models/keeper.glb";
    member.clips.push_back({"wave", old_ + "/clips/wave.bvh"});
    document.cast.push_back(member);
    ObjectDocument object;
    object.name = "jug";
    object.model = "jug";
    document.objects.push_back(object);
    return document;
  }();
};

TEST_F(MissingFilesTest, AreNamedOnceWithWhatTheyAre) {
  EXPECT_THAT(Missing(), ElementsAre(old_ + "/film/walk.mp4", old_ + "/film/evening",
                                     old_ + "/models/counter.glb", "probe.exr",
                                     old_ + "/models/keeper.glb", old_ + "/clips/wave.bvh"));
  const std::vector<MissingFile> missing = MissingFiles(paths_, document_);
  EXPECT_EQ(missing[0].role, "the recording of \"tavern\"");
  EXPECT_EQ(missing[1].kind, FileKind::kImages);
  EXPECT_EQ(missing[2].kind, FileKind::kModel);
  EXPECT_EQ(missing[5].role, "the clip \"wave\" of \"keeper\"");
}

TEST_F(MissingFilesTest, WhatIsThereIsNotMissing) {
  Put(old_ + "/film/walk.mp4");
  Put(paths_.folder / "probe.exr");
  fs::create_directories(old_ + "/film/evening");
  Put(old_ + "/models/counter.glb");
  Put(old_ + "/clips/wave.bvh");
  EXPECT_THAT(Missing(), ElementsAre(old_ + "/models/keeper.glb"));
}

TEST_F(MissingFilesTest, OthersOfTheMovedFolderAreOfferedWhereTheyAreThere) {
  const fs::path moved = folder_ / "new";
  Put(moved / "film/walk.mp4");
  Put(moved / "models/counter.glb");
  Put(moved / "clips/wave.bvh");
  fs::create_directories(moved / "film/evening");
  const Relocation located{old_ + "/film/walk.mp4", (moved / "film/walk.mp4").string()};
  EXPECT_THAT(
      SameMove(paths_, MissingFiles(paths_, document_), located),
      ElementsAre(Relocation{old_ + "/film/evening", (moved / "film/evening").string()},
                  Relocation{old_ + "/models/counter.glb", (moved / "models/counter.glb").string()},
                  Relocation{old_ + "/clips/wave.bvh", (moved / "clips/wave.bvh").string()}));
}

TEST_F(MissingFilesTest, AFileThatWasRenamedTooBringsThoseOfItsFolder) {
  const fs::path moved = folder_ / "elsewhere";
  Put(moved / "walk-2.mp4");
  fs::create_directories(moved / "evening");
  Put(moved / "models/counter.glb");
  const Relocation located{old_ + "/film/walk.mp4", (moved / "walk-2.mp4").string()};
  EXPECT_THAT(SameMove(paths_, MissingFiles(paths_, document_), located),
              ElementsAre(Relocation{old_ + "/film/evening", (moved / "evening").string()}));
}

TEST_F(MissingFilesTest, WhatMovedIntoTheProjectIsNamedFromThere) {
  Put(paths_.folder / "film/walk.mp4");
  fs::create_directories(paths_.folder / "film/evening");
  const Relocation located{old_ + "/film/walk.mp4", "film/walk.mp4"};
  EXPECT_THAT(SameMove(paths_, MissingFiles(paths_, document_), located),
              ElementsAre(Relocation{old_ + "/film/evening", "film/evening"}));
}

TEST_F(MissingFilesTest, LocatingOneNamesItWhereverItIsUsedAndCanBeUndone) {
  ASSERT_TRUE(CreateProject(paths_, "Show").ok());
  ASSERT_TRUE(SaveProject(paths_, document_).ok());
  const std::shared_ptr<Log> log = MakeSilentLog();
  const auto workspace = Workspace::Open(paths_, *log);
  ASSERT_TRUE(workspace.ok()) << workspace.message();
  (*workspace)->project().Edit(Sentence("locate"), [&](ProjectDocument& document) {
    Relocate({old_ + "/film/walk.mp4", "walk.mp4"}, document);
    Relocate({old_ + "/clips/wave.bvh", "wave.bvh"}, document);
  });
  const ProjectDocument& now = (*workspace)->project().document();
  EXPECT_EQ(now.places[0].training.path, "walk.mp4");
  EXPECT_EQ(now.places[0].preview.path, "walk.mp4");
  EXPECT_EQ(now.cast[0].clips[0].file, "wave.bvh");
  EXPECT_EQ(now.places[0].occluders[0].file, old_ + "/models/counter.glb");
  (*workspace)->project().Undo();
  EXPECT_EQ((*workspace)->project().document().places[0].training.path, old_ + "/film/walk.mp4");
  EXPECT_EQ((*workspace)->project().document().cast[0].clips[0].file, old_ + "/clips/wave.bvh");
}

// A quarter of a second of silence.
std::vector<std::byte> Silence() { return test::Encode(std::vector<float>(12'000), 1); }

TEST_F(MissingFilesTest, SoundsThatAPlaceAnObjectOrTheDramaNamesAreMissed) {
  ASSERT_TRUE(CreateProject(paths_, "Show").ok());
  document_ = {};
  document_.places.emplace_back().name = "bar";
  document_.places[0].acoustics.ambience.emplace_back().sound = "crowd";
  document_.places[0].acoustics.ambience.emplace_back().sound = "room";  // A built-in sound.
  const std::vector<MissingSound> sounds = FindMissingSounds(paths_, document_, R"(
    function main()
      sound("bell"):play{}   -- sound("not this one")
      sound 'gong':play{}
      mysound("nor this")
      sound(name):play{}
      sound("crowd"):stop()
      sound("brazier"):play{}
    end)");
  ASSERT_EQ(sounds.size(), 3u);
  EXPECT_EQ(sounds[0].name, "crowd");
  EXPECT_EQ(sounds[0].who, "place 'bar'");
  EXPECT_EQ(sounds[1].name, "bell");
  EXPECT_EQ(sounds[1].who, "drama.lua:3");
  EXPECT_EQ(sounds[2].name, "gong");
  const std::vector<MissingFile> missing = MissingFiles(paths_, document_, sounds);
  ASSERT_EQ(missing.size(), 3u);
  EXPECT_EQ(missing[1].path, "audio/bell");
  EXPECT_EQ(missing[1].kind, FileKind::kSound);
  EXPECT_EQ(missing[1].role, "the sound \"bell\" (drama.lua:3)");
}

TEST_F(MissingFilesTest, ALocatedSoundIsCopiedAndOthersOfItsFolderAreOffered) {
  ASSERT_TRUE(CreateProject(paths_, "Show").ok());
  document_ = {};
  fs::create_directories(folder_ / "recordings");
  ASSERT_TRUE(WriteFileAtomically(folder_ / "recordings/big bell.wav", Silence()).ok());
  ASSERT_TRUE(WriteFileAtomically(folder_ / "recordings/gong.wav", Silence()).ok());
  const std::vector<MissingSound> sounds = {{"bell", "drama.lua:3"}, {"gong", "drama.lua:4"}};
  const std::vector<MissingFile> missing = MissingFiles(paths_, document_, sounds);
  const Relocation located{"audio/bell", (folder_ / "recordings/big bell.wav").string()};
  EXPECT_THAT(SameMove(paths_, missing, located),
              ElementsAre(Relocation{"audio/gong", (folder_ / "recordings/gong.wav").string()}));
  ASSERT_TRUE(BringInSound(paths_, "bell", located.to).ok());
  EXPECT_TRUE(fs::exists(paths_.folder / "audio/bell.wav"));
  EXPECT_EQ(MissingFiles(paths_, document_, sounds).size(), 1u);
  EXPECT_TRUE(FindMissingSounds(paths_, document_, "sound('bell'):play{}").empty());
}

TEST_F(MissingFilesTest, WhatIsNoRecordingIsNotBroughtIn) {
  ASSERT_TRUE(CreateProject(paths_, "Show").ok());
  Put(folder_ / "noise.wav");
  EXPECT_THAT(BringInSound(paths_, "bell", folder_ / "noise.wav").message(),
              testing::HasSubstr("noise.wav"));
  EXPECT_THAT(BringInSound(paths_, "bell", folder_ / "noise.txt").message(),
              testing::HasSubstr("is not a sound file"));
  EXPECT_THAT(BringInSound(paths_, "../bell", folder_ / "noise.wav").message(),
              testing::HasSubstr("cannot be the name"));
  EXPECT_FALSE(fs::exists(paths_.folder / "audio/bell.wav"));
}

}  // namespace
}  // namespace lararium::editor
