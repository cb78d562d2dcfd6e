#pragma once

// People as files have them, read once for all who show them at the same time: the preview that
// is seen, the one that is made ready to follow it, the drama that is run dry.

#include <filesystem>
#include <vector>

#include "shared/core/status.h"
#include "shared/show/show_content.h"

namespace lararium::app {

// Any detail will do: for those who draw nobody.
inline constexpr float kAnyDetail = 1.0f;  // metres, as errors count (human::ErrorShare)

// The person, without a name, whom somebody holds already in at least that detail (as
// human::ParseHuman takes it), as long as the file has not changed since; else read from it.
// Nobody is kept whom no one holds. On any thread.
Result<show::CastMember> SharePerson(const std::filesystem::path& file, float finest);

// Reads people of a cast again in more detail, as long as their files are still what they were
// when this was made. Somebody without a file is never asked for.
show::ReadPerson ReadsAgain(const std::vector<std::filesystem::path>& files);

}  // namespace lararium::app
