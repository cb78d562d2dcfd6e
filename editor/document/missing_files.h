#pragma once

// Files that the project refers to but that do not exist: lists them, and updates the project when
// the user locates them.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "editor/document/project.h"

namespace lararium::editor {

enum class FileKind { kVideo, kImages, kModel, kProbe, kClip, kBones, kSound };

struct MissingFile {
  // The path in the document. A sound has only a name: audio/NAME, without an extension.
  std::string path;
  FileKind kind = FileKind::kVideo;
  std::string role;    // The file's role in the project: "the recording of \"tavern\"".
  std::string shown;   // The role in the language of the interface.
  std::string remedy;  // The remedy other than locating the file.
};

// A sound that the project uses but that does not exist.
struct MissingSound {
  std::string name;
  std::string who;  // The first that uses it: "object 'door'", "place 'bar'", "drama.lua:12".
};

// In the order of the document, each path once; the missing sounds follow.
std::vector<MissingFile> MissingFiles(const ProjectPaths& paths,
                                      const ProjectDocument& document,
                                      std::span<const MissingSound> sounds = {});

// A file that has moved. Both paths are as the document writes them.
struct Relocation {
  std::string from;
  std::string to;

  friend bool operator==(const Relocation&, const Relocation&) = default;
};

// The other missing files that moved together with the located one: if /old/x/a.mp4 is now
// /new/x/a.mp4, then /old/y/b.glb may be /new/y/b.glb. For a sound: the other missing sounds that
// are in its new folder. Returns only files that exist.
std::vector<Relocation> SameMove(const ProjectPaths& paths,
                                 const std::vector<MissingFile>& missing,
                                 const Relocation& located);

// Replaces the old path by the new one everywhere in the document.
void Relocate(const Relocation& relocation, ProjectDocument& document);

// Updates all paths inside a folder. Both paths are as the document writes them.
void RelocateFolder(const std::string& from, const std::string& to, ProjectDocument& document);

// The file of a sound in a folder, with any extension of SoundExtensions(); empty where there is
// none.
std::filesystem::path SoundFileIn(const std::filesystem::path& folder, const std::string& name);

// With the dot, lower case.
std::span<const char* const> SoundExtensions();

}  // namespace lararium::editor
