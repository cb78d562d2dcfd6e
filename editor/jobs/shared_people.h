#pragma once

// People loaded from files and shared by all users at the same time: the visible preview, the next
// preview that is being prepared, and the dry run of the drama.

#include <filesystem>
#include <vector>

#include "shared/core/status.h"
#include "shared/show/show_content.h"

namespace lararium::editor {

// The coarsest detail, for callers that do not draw.
inline constexpr float kAnyDetail = 1.0f;  // Metres of geometric error (human::ErrorShare).

// Returns the person without a name. Shares one that is already loaded in at least this detail
// (finest as in human::ParseHuman) if its file has not changed; otherwise reads the file. People
// that are no longer used are freed. Thread-safe.
Result<show::CastMember> SharePerson(const std::filesystem::path& file, float finest);

// Returns a function that reads people of a cast again in more detail. It fails where a file has
// changed since ReadsAgain() was called. It must not be called for a person without a file.
show::ReadPerson ReadsAgain(const std::vector<std::filesystem::path>& files);

}  // namespace lararium::editor
