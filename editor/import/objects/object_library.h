#pragma once

// The library of objects that every project can name: a folder with one folder for each object.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"

namespace lararium::import {

// The library that comes with the editor.
std::filesystem::path ObjectLibrary();

// The names of the folders in a library, sorted.
std::vector<std::string> LibraryObjectNames(const std::filesystem::path& library = ObjectLibrary());

// The file that ImportObject reads for the object: NAME/NAME.glb or a model of another kind of
// this name, otherwise NAME/NAME.object.json of a real object. Fails if the library has no such
// object or its folder has no such file.
Result<std::filesystem::path> FindLibraryObject(
    std::string_view name, const std::filesystem::path& library = ObjectLibrary());

}  // namespace lararium::import
