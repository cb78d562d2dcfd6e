#pragma once

// Offscreen pictures of people in a studio, to judge a figure, and the contact sheet of a cast.

#include "editor/text/command_result.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct PortraitOptions {
  std::vector<std::filesystem::path> humans;  // Files .larhuman, at least one.
  std::filesystem::path out;                  // A file .png or .jpg.
  std::string view = "front";       // One of front, side, back, bust, face, three-quarter.
  std::vector<std::string> shapes;  // NAME or NAME=weight of a face shape.
  std::string clip;                 // Empty: the person stands.
  double time = 0.0;                // Seconds into the clip.
  double walk = 0.0;                // Seconds of walking; the picture shows the last moment.
  int width = 720;                  // Pixels for each person.
  int height = 1080;
  // Shows every person from several sides, and each face shape of the first one.
  bool sheet = false;
};

// Writes the picture. Errors name the file, view, shape or clip that does not exist.
Result<CommandResult> RunPortrait(const PortraitOptions& options);

}  // namespace lararium::editor
