#include "editor/document/missing_files.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "editor/text/text.h"
#include "shared/core/file.h"

namespace lararium::editor {

namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 5> kExtensions = {".wav", ".flac", ".ogg", ".oga", ".opus"};

// What a file is in the project: in English for errors, and in the language of the interface.
struct Role {
  std::string role;
  std::string shown;
};

// format: marked by TrLater(); it takes the name, or the name and the owner's name.
Role RoleOf(const char* format, const std::string& name, const std::string& owner = "") {
  return {Text(format, name.c_str(), owner.c_str()), Text(Tr(format), name.c_str(), owner.c_str())};
}

// Calls see(path, kind, role, remedy) for each file that a document refers to. Document may be
// const.
template <typename Document, typename See>
void ForEachFile(Document& document, const See& see) {
  const auto recording = [&](auto& source, const Role& role) {
    if (!source.empty()) {
      see(source.path,
          source.kind == SourceDocument::Kind::kImages ? FileKind::kImages : FileKind::kVideo, role,
          "put it back");
    }
  };
  for (auto& place : document.places) {
    recording(place.training, RoleOf(TrLater("the recording of \"%s\""), place.label()));
    recording(place.preview,
              RoleOf(TrLater("the recording for the preview of \"%s\""), place.label()));
    for (auto& session : place.added) {
      recording(session.source, RoleOf(TrLater("an added session of \"%s\""), place.label()));
    }
    for (auto& occluder : place.occluders) {
      see(occluder.file, FileKind::kModel, RoleOf(TrLater("the occluder \"%s\""), occluder.name),
          "put it back, or remove the occluder");
    }
    for (auto& probe : place.probes) {
      see(probe.file, FileKind::kProbe, RoleOf(TrLater("the light probe \"%s\""), probe.name),
          "put it back, or remove the light probe");
    }
  }
  for (auto& member : document.cast) {
    see(member.model, FileKind::kModel, RoleOf(TrLater("the figure of \"%s\""), member.label()),
        "put it back, or import \"" + member.name + "\" again");
    see(member.bone_map, FileKind::kBones,
        RoleOf(TrLater("the bone map of \"%s\""), member.label()),
        "put it back, or name the bones again");
    for (auto& clip : member.clips) {
      see(clip.file, FileKind::kClip,
          RoleOf(TrLater("the clip \"%s\" of \"%s\""), clip.name, member.label()),
          "put it back, or remove the clip \"" + clip.name + "\"");
    }
  }
  for (auto& object : document.objects) {
    see(object.file, FileKind::kModel, RoleOf(TrLater("the object \"%s\""), object.name),
        "put it back, or remove \"" + object.name + "\"");
  }
}

// Removes the common end of two paths; what remains are the folders before and after the move.
std::pair<fs::path, fs::path> MovedFolders(fs::path from, fs::path to) {
  if (from.filename() != to.filename()) {
    return {from.parent_path(), to.parent_path()};  // The file was renamed as well.
  }
  while (from.has_filename() && to.has_filename() && from.filename() == to.filename()) {
    from = from.parent_path();
    to = to.parent_path();
  }
  return {from, to};
}

// The new path of a file that moved along; empty: it does not exist.
fs::path MovedTo(const fs::path& moved, FileKind kind) {
  if (kind == FileKind::kSound) {
    return SoundFileIn(moved.parent_path(), moved.filename().string());
  }
  return FileExists(moved) ? moved : fs::path();
}

}  // namespace

std::span<const char* const> SoundExtensions() { return kExtensions; }

std::filesystem::path SoundFileIn(const std::filesystem::path& folder, const std::string& name) {
  for (const char* extension : kExtensions) {
    std::error_code ignored;
    const std::filesystem::path file = folder / (name + extension);
    if (std::filesystem::is_regular_file(file, ignored)) {
      return file;
    }
  }
  return {};
}

std::vector<MissingFile> MissingFiles(const ProjectPaths& paths,
                                      const ProjectDocument& document,
                                      std::span<const MissingSound> sounds) {
  std::vector<MissingFile> missing;
  ForEachFile(document, [&](const std::string& path, FileKind kind, const Role& role,
                            const std::string& remedy) {
    const bool known = std::any_of(missing.begin(), missing.end(),
                                   [&](const MissingFile& file) { return file.path == path; });
    if (!path.empty() && !known && !FileExists(paths.Resolve(path))) {
      missing.push_back({path, kind, role.role, role.shown, remedy});
    }
  });
  for (const MissingSound& sound : sounds) {
    const std::string path = "audio/" + sound.name;
    if (SoundFileIn(paths.folder / "audio", sound.name).empty()) {
      const Role role = RoleOf(TrLater("the sound \"%s\" (%s)"), sound.name, sound.who);
      missing.push_back(
          {path, FileKind::kSound, role.role, role.shown, "put " + path + ".wav there"});
    }
  }
  return missing;
}

std::vector<Relocation> SameMove(const ProjectPaths& paths,
                                 const std::vector<MissingFile>& missing,
                                 const Relocation& located) {
  const auto [old_folder, new_folder] = MovedFolders(paths.Resolve(located.from).lexically_normal(),
                                                     paths.Resolve(located.to).lexically_normal());
  std::vector<Relocation> moves;
  for (const MissingFile& file : missing) {
    const fs::path below =
        paths.Resolve(file.path).lexically_normal().lexically_relative(old_folder);
    if (file.path == located.from || below.empty() || *below.begin() == "..") {
      continue;
    }
    if (const fs::path moved = MovedTo(new_folder / below, file.kind); !moved.empty()) {
      moves.push_back({file.path, paths.Shorten(moved)});
    }
  }
  return moves;
}

void Relocate(const Relocation& relocation, ProjectDocument& document) {
  ForEachFile(document, [&](std::string& path, FileKind, const Role&, const std::string&) {
    if (path == relocation.from) {
      path = relocation.to;
    }
  });
}

void RelocateFolder(const std::string& from, const std::string& to, ProjectDocument& document) {
  ForEachFile(document, [&](std::string& path, FileKind, const Role&, const std::string&) {
    if (path.starts_with(from + "/")) {
      path.replace(0, from.size(), to);
    }
  });
}

std::vector<Status> FindMissingFiles(const ProjectPaths& paths, const ProjectDocument& document) {
  std::vector<Status> missing;
  const auto expect = [&](const fs::path& file, const std::string& remedy) {
    if (!FileExists(file)) {
      missing.push_back(Status::Error(file.string(), "was not found", remedy));
    }
  };
  expect(paths.Drama(), "write a drama, or take lua/template for a start");
  for (const PlaceDocument& place : document.places) {
    expect(paths.Scene(place.name), "train the place \"" + place.name + "\"");
  }
  for (const MissingFile& file : MissingFiles(paths, document)) {
    missing.push_back(Status::Error(paths.Resolve(file.path).string(),
                                    "was not found (" + file.role + ")",
                                    file.remedy + ", or locate it in the editor"));
  }
  return missing;
}

}  // namespace lararium::editor
