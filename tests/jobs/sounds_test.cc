#include "editor/jobs/sounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "shared/audio/sound_file.h"
#include "shared/core/file.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;

std::vector<std::string> Names(const std::vector<SoundFile>& sounds) {
  std::vector<std::string> names;
  for (const SoundFile& sound : sounds) {
    names.push_back(sound.name);
  }
  return names;
}

TEST(FindSounds, OffersTheLibraryToAnEmptyProject) {
  const test::TemporaryFolder folder;
  const std::vector<SoundFile> sounds = FindSounds(ProjectPaths{folder.path()});
  EXPECT_THAT(Names(sounds),
              ElementsAre("brazier", "door", "grind", "lid", "pour", "room", "street"));
  const auto loaded = LoadSounds(ProjectPaths{folder.path()});
  ASSERT_TRUE(loaded.ok()) << loaded.message();
  ASSERT_EQ(loaded->size(), sounds.size());
  for (const audio::SoundData& sound : *loaded) {
    const auto reader = audio::SoundReader::Open(sound.bytes, sound.name);
    ASSERT_TRUE(reader.ok()) << reader.message();
  }
}

TEST(FindSounds, PrefersTheProjectsOwnFileToThatOfTheLibrary) {
  const test::TemporaryFolder folder;
  const fs::path own = folder.path() / "audio" / "door.wav";
  fs::create_directories(own.parent_path());
  ASSERT_TRUE(WriteFileAtomically(own, std::vector<std::byte>(4)).ok());
  for (const SoundFile& sound : FindSounds(ProjectPaths{folder.path()})) {
    EXPECT_EQ(sound.of_library, sound.name != "door") << sound.name;
    EXPECT_EQ(sound.name == "door", sound.file == own) << sound.file;
  }
}

}  // namespace
}  // namespace lararium::editor
