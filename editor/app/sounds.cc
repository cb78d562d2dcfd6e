#include "editor/app/sounds.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "editor/app/baking.h"
#include "editor/bake/sound_synthesis.h"
#include "shared/core/file.h"
#include "shared/stage/object_use.h"

namespace lararium::app {
namespace {

constexpr std::array<std::string_view, 5> kExtensions = {".wav", ".flac", ".ogg", ".oga", ".opus"};

}  // namespace

std::vector<SoundFile> FindSounds(const ProjectPaths& paths) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(paths.folder / "audio", ignored)) {
    const std::string extension = entry.path().extension().string();
    if (entry.is_regular_file(ignored) &&
        std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end()) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::map<std::string, SoundFile> sounds;
  for (const std::filesystem::path& file : files) {
    const std::string name = file.stem().string();
    sounds.insert({name, {name, file, false}});
  }
  for (const bake::BuiltInSound& sound : bake::BuiltInSounds()) {
    const std::string name(sound.name);
    sounds.insert({name, {name, paths.Sound(name), true}});
  }
  std::vector<SoundFile> found;
  for (auto& [name, sound] : sounds) {
    found.push_back(std::move(sound));
  }
  return found;
}

Result<std::vector<audio::SoundData>> LoadSounds(const ProjectPaths& paths) {
  std::vector<audio::SoundData> sounds;
  for (const SoundFile& sound : FindSounds(paths)) {
    std::error_code ignored;
    if (sound.built_in && !std::filesystem::exists(sound.file, ignored)) {
      continue;
    }
    LARARIUM_ASSIGN_OR_RETURN(auto bytes, ReadBytes(sound.file, audio::SoundReader::kMaxBytes));
    const auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
    sounds.push_back({sound.name, *owner, owner});
  }
  return sounds;
}

std::vector<Status> FindSilences(const ProjectPaths& paths, const ProjectDocument& document) {
  std::set<std::string> known;
  for (const SoundFile& sound : FindSounds(paths)) {
    known.insert(sound.name);
  }
  std::vector<Status> problems;
  const auto expect = [&](const std::string& who, const std::string& sound) {
    if (!sound.empty() && !known.contains(sound)) {
      problems.push_back(Status::Error(who, "there is no sound '" + sound + "'",
                                       "add audio/" + sound + ".wav to the project"));
    }
  };
  for (const PlaceDocument& place : document.places) {
    for (const stage::Ambience& ambience : place.acoustics.ambience) {
      expect("place '" + place.name + "'", ambience.sound);
    }
  }
  for (const ObjectDocument& object : document.objects) {
    Result<stage::Prop> prop = LoadBakedProp(paths, object);
    if (!prop.ok()) {
      continue;
    }
    const std::string who = "object '" + object.name + "'";
    const auto model = stage::ObjectModel::Create(std::move(*prop), who);
    if (!model.ok()) {
      continue;
    }
    for (const stage::ObjectAction& action : (*model)->use().actions) {
      expect(who, action.sound.name);
    }
    for (const stage::StateSound& sound : (*model)->use().sounds) {
      expect(who, sound.name);
    }
  }
  return problems;
}

}  // namespace lararium::app
