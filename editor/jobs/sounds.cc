#include "editor/jobs/sounds.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "editor/document/document_fields.h"
#include "editor/jobs/baking.h"
#include "shared/core/file.h"
#include "shared/core/lower_case.h"
#include "shared/core/program.h"
#include "shared/stage/object_use.h"

namespace lararium::editor {
namespace {

bool IsWordLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

bool IsSound(std::string_view extension) {
  return std::find(SoundExtensions().begin(), SoundExtensions().end(), extension) !=
         SoundExtensions().end();
}

// The files of a folder that are not hidden, sorted.
std::vector<std::filesystem::path> FilesOf(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.is_regular_file(ignored) && !entry.path().filename().string().starts_with('.')) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The name in a call such as sound("bell"), whose brackets are optional in Lua. rest: the text
// after the word sound. Empty where there is no literal name.
std::string NameInCall(std::string_view rest) {
  const auto skip = [&](std::string_view these) {
    rest.remove_prefix(std::min(rest.find_first_not_of(these), rest.size()));
  };
  skip(" \t");
  rest.remove_prefix(rest.starts_with('(') ? 1 : 0);
  skip(" \t");
  if (!rest.starts_with('"') && !rest.starts_with('\'')) {
    return "";
  }
  const size_t end = rest.find(rest.front(), 1);
  return end == std::string_view::npos ? "" : std::string(rest.substr(1, end - 1));
}

// Calls see(name, line) for each sound that a script names by a literal. Line comments are skipped.
template <typename See>
void ForEachNamedSound(std::string_view script, const See& see) {
  constexpr std::string_view kWord = "sound";
  int number = 1;
  for (size_t begin = 0; begin < script.size(); ++number) {
    const size_t end = std::min(script.find('\n', begin), script.size());
    std::string_view line = script.substr(begin, end - begin);
    line = line.substr(0, line.find("--"));
    begin = end + 1;
    for (size_t at = line.find(kWord); at != std::string_view::npos;
         at = line.find(kWord, at + 1)) {
      const std::string name = NameInCall(line.substr(at + kWord.size()));
      if (!name.empty() && (at == 0 || !IsWordLetter(line[at - 1]))) {
        see(name, number);
      }
    }
  }
}

// The files in the folder of sounds that no sound is played from.
std::vector<Status> FindUnusedFiles(const ProjectPaths& paths) {
  constexpr std::string_view kNotPlayed[] = {".mp3", ".m4a", ".aac", ".aif", ".aiff",
                                             ".wma", ".caf", ".mp4", ".mov"};
  std::map<std::string, std::filesystem::path> used;
  for (const SoundFile& sound : FindSounds(paths)) {
    used[sound.name] = sound.of_library ? std::filesystem::path() : sound.file;
  }
  std::vector<Status> unused;
  for (const std::filesystem::path& file : FilesOf(paths.folder / "audio")) {
    const std::string extension = LowerCase(file.extension().string());
    const std::filesystem::path& taken = used[file.stem().string()];
    if (IsSound(extension) && taken != file) {
      unused.push_back(Status::Error(
          file.string(), taken.filename().string() + " is the sound of that name", "rename one"));
    } else if (taken.empty() && std::find(std::begin(kNotPlayed), std::end(kNotPlayed),
                                          extension) != std::end(kNotPlayed)) {
      unused.push_back(Status::Error(file.string(), "is not played as a sound",
                                     "save it as WAV, FLAC, Ogg or Opus"));
    }
  }
  return unused;
}

}  // namespace

Status BringInSound(const ProjectPaths& paths,
                    const std::string& name,
                    const std::filesystem::path& file) {
  const std::string extension = LowerCase(file.extension().string());
  if (!IsPlainName(name)) {
    return Status::Error("the sound '" + name + "'", "cannot be the name of a file",
                         "use letters, digits, '_' and '-'");
  }
  if (!IsSound(extension)) {
    return Status::Error(file.string(), "is not a sound file", "use .wav, .flac, .ogg or .opus");
  }
  LARARIUM_ASSIGN_OR_RETURN(const auto bytes, ReadBytes(file, audio::SoundReader::kMaxBytes));
  LARARIUM_RETURN_IF_ERROR(audio::SoundReader::Open(bytes, file.string()).status());
  std::error_code error;
  std::filesystem::create_directories(paths.folder / "audio", error);
  return WriteFileAtomically(paths.folder / "audio" / (name + extension), bytes);
}

std::vector<SoundFile> FindSounds(const ProjectPaths& paths) {
  std::map<std::string, SoundFile> sounds;
  const auto add = [&](const std::filesystem::path& folder, bool of_library) {
    for (const std::filesystem::path& file : FilesOf(folder)) {
      const std::string name = file.stem().string();
      if (IsSound(LowerCase(file.extension().string()))) {
        sounds.insert({name, {name, file, of_library}});
      }
    }
  };
  add(paths.folder / "audio", false);
  add(ShippedData("lararium/library/sounds", "scenes/library/sounds"), true);
  std::vector<SoundFile> found;
  for (auto& [name, sound] : sounds) {
    found.push_back(std::move(sound));
  }
  return found;
}

Result<std::vector<audio::SoundData>> LoadSounds(const ProjectPaths& paths) {
  std::vector<audio::SoundData> sounds;
  for (const SoundFile& sound : FindSounds(paths)) {
    LARARIUM_ASSIGN_OR_RETURN(auto bytes, ReadBytes(sound.file, audio::SoundReader::kMaxBytes));
    const auto owner = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
    sounds.push_back({sound.name, *owner, owner});
  }
  return sounds;
}

std::vector<MissingSound> FindMissingSounds(const ProjectPaths& paths,
                                            const ProjectDocument& document,
                                            std::string_view script) {
  std::set<std::string> known;
  for (const SoundFile& sound : FindSounds(paths)) {
    known.insert(sound.name);
  }
  std::vector<MissingSound> missing;
  const auto expect = [&](const std::string& who, const std::string& sound) {
    if (!sound.empty() && known.insert(sound).second) {
      missing.push_back({sound, who});
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
  ForEachNamedSound(script, [&](const std::string& sound, int line) {
    expect(paths.Drama().filename().string() + ":" + std::to_string(line), sound);
  });
  return missing;
}

std::vector<Status> FindSilences(const ProjectPaths& paths, const ProjectDocument& document) {
  std::vector<Status> problems = FindUnusedFiles(paths);
  for (const MissingSound& sound : FindMissingSounds(paths, document, "")) {
    problems.push_back(Status::Error(sound.who, "there is no sound '" + sound.name + "'",
                                     "add audio/" + sound.name +
                                         ".wav to the project, or locate it in the "
                                         "editor"));
  }
  return problems;
}

}  // namespace lararium::editor
