#pragma once

// What a project states about the origin and the certainty of its people, objects and lines:
// paradata.json (docs/file-formats.md).

#include <string>
#include <vector>

#include "editor/document/project.h"
#include "shared/core/json.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"
#include "shared/stage/paradata.h"

namespace lararium::editor {

// The path of the file, which is optional.
std::filesystem::path ParadataFile(const ProjectPaths& paths);

// Returns an empty value where the project has no such file.
Result<stage::Paradata> LoadParadata(const ProjectPaths& paths);

// A part of a project that a claim can be about.
struct ProjectSubject {
  stage::Subject subject = stage::Subject::kPerson;
  std::string name;
  bool needs_claim = true;  // False for a sound of the library: not every project uses it.
};
// Sorted by kind, then in the order of the project.
std::vector<ProjectSubject> ListSubjects(const ProjectPaths& paths,
                                         const ProjectDocument& document);

struct ParadataReport {
  std::vector<Sentence> problems;  // Claims about unknown subjects; letters that the font lacks.
  std::vector<Sentence> warnings;  // Subjects without a certainty; sources that no claim cites.
  Json json;                       // {"attested": count, ..., "without": {kind: [names]}}
};
ParadataReport CheckParadata(const ProjectPaths& paths, const ProjectDocument& document);

}  // namespace lararium::editor
