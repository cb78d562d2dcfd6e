#pragma once

#include <filesystem>
#include <string>

namespace lararium::editor {

// A text that changes when the file changes: modification time, size and inode. The resolution of
// the time is a few milliseconds, but a program that replaces the file gives it a new inode.
// "none": the file does not exist.
std::string FileStamp(const std::filesystem::path& file);

}  // namespace lararium::editor
