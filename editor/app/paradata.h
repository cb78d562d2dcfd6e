#pragma once

// What a project says of where its people, things and lines come from and how certain they
// are: paradata.json (docs/file-formats.md).

#include <string>
#include <vector>

#include "editor/app/project.h"
#include "shared/core/json.h"
#include "shared/core/sentence.h"
#include "shared/core/status.h"
#include "shared/stage/paradata.h"

namespace lararium::app {

// May be missing.
std::filesystem::path ParadataFile(const ProjectPaths& paths);

// Empty where the project has none.
Result<stage::Paradata> LoadParadata(const ProjectPaths& paths);

// Something of a project that claims may be about.
struct ProjectSubject {
  stage::Subject subject = stage::Subject::kPerson;
  std::string name;
  bool needs_claim = true;  // false: a built-in sound, which a project may not use
};
// By kind, in the order of the project.
std::vector<ProjectSubject> ListSubjects(const ProjectPaths& paths,
                                         const ProjectDocument& document);

struct ParadataReport {
  std::vector<Sentence> problems;  // claims about what is not there, letters that lack
  std::vector<Sentence> warnings;  // what is without certainty, sources that nothing names
  Json json;                       // "attested": count, ..., "without": {kind: [names]}
};
ParadataReport CheckParadata(const ProjectPaths& paths, const ProjectDocument& document);

}  // namespace lararium::app
