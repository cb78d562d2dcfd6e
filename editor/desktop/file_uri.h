#pragma once

#include <filesystem>
#include <string_view>

#include "shared/core/status.h"

namespace lararium::editor {

// The absolute path of a file URI (RFC 8089): "file:///home/a/Gr%C3%B6%C3%9Fe.mp4". Fails for other
// schemes and other hosts, for what is not well formed, and for names that are not UTF-8, because a
// project could not store them.
Result<std::filesystem::path> PathOfUri(std::string_view uri);

}  // namespace lararium::editor
