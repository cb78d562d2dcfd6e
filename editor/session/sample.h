#pragma once

// The sample that comes with the editor: a drama, and beside it the project of its place with the
// films. A folder of the sample has both, because the drama's project refers to those films.

#include <filesystem>

#include "shared/core/progress.h"
#include "shared/core/status.h"

namespace lararium::editor {

// The drama's project in a folder of the sample.
std::filesystem::path SampleProject(const std::filesystem::path& sample);

// The shipped sample of a program in the given folder: the installed one, else what ./demo made in
// the checkout, else the scenes of the checkout, which are not trained. Empty where there is none.
std::filesystem::path ShippedSample(const std::filesystem::path& program);

// Whether the sample has the map of its place.
bool IsTrained(const std::filesystem::path& sample);

// The folder of the user's own copy: sample, sample-2, ... in a folder. It is made, or completed
// after an interruption, where it does not exist. An existing copy keeps all its files; it only
// gets the map and the baked people where it has none and the shipped sample has them. A copy of
// another version of the sample stays as it is, and a new one is made beside it.
Result<std::filesystem::path> OwnSample(const std::filesystem::path& shipped,
                                        const std::filesystem::path& folder,
                                        Progress& progress);

// Whether a project belongs to a copy that OwnSample() made in the folder.
bool IsOwnSample(const std::filesystem::path& project, const std::filesystem::path& folder);

}  // namespace lararium::editor
