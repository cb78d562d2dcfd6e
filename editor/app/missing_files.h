#pragma once

// Files that a project names and that are not where it says: which they are, and naming them
// where they are now.

#include <span>
#include <string>
#include <vector>

#include "editor/app/project.h"
#include "editor/app/sounds.h"

namespace lararium::app {

enum class FileKind { kVideo, kImages, kModel, kProbe, kClip, kBones, kSound };

struct MissingFile {
  // As the document has it; of a sound, which has a name alone: audio/NAME, without an extension.
  std::string path;
  FileKind kind = FileKind::kVideo;
  std::string role;    // what it is in the project: "the recording of \"tavern\""
  std::string shown;   // the same in the language of the interface
  std::string remedy;  // other than locating it
};

// In the order of the document, each path once; then those of the sounds that are still missing.
std::vector<MissingFile> MissingFiles(const ProjectPaths& paths,
                                      const ProjectDocument& document,
                                      std::span<const MissingSound> sounds = {});

// One file that has moved; both as documents have them.
struct Relocation {
  std::string from;
  std::string to;

  friend bool operator==(const Relocation&, const Relocation&) = default;
};

// Of the other missing files those which made the same move: /old/x/a.mp4 is now /new/x/a.mp4,
// so /old/y/b.glb may be /new/y/b.glb; of a sound the other missing ones in its folder. Only what
// is there.
std::vector<Relocation> SameMove(const ProjectPaths& paths,
                                 const std::vector<MissingFile>& missing,
                                 const Relocation& located);

// Names the new path wherever the document has the old one.
void Relocate(const Relocation& relocation, ProjectDocument& document);

// The same of all that lies in a folder; both as documents have them.
void RelocateFolder(const std::string& from, const std::string& to, ProjectDocument& document);

}  // namespace lararium::app
