#pragma once

// Offscreen pictures of people and things in a studio, to judge a figure or a model before it is
// added, and the contact sheet of a cast.

#include "editor/text/command_result.h"
#include "shared/core/status.h"

namespace lararium::editor {

struct PortraitOptions {
  // At least one: people (.larhuman), things (.larprop), or models of other programs.
  std::vector<std::filesystem::path> files;
  bool thing = false;         // Models of other programs are imported as things, not as people.
  std::filesystem::path out;  // A file .png or .jpg.
  // One of front, side, back, bust, face, three-quarter. Empty: people from the front, things from
  // the side and above.
  std::string view;
  std::vector<std::string> shapes;  // NAME or NAME=weight of a face shape.
  std::string clip;                 // Empty: the person stands.
  double time = 0.0;                // Seconds into the clip.
  double walk = 0.0;                // Seconds of walking; the picture shows the last moment.
  int width = 720;                  // Pixels for each person.
  int height = 1080;
  // Shows every person from several sides, and each face shape of the first one.
  bool sheet = false;
};

// Writes the picture; what an import guessed or left out are warnings. Errors name the file, view,
// shape or clip that does not exist.
Result<CommandResult> RunPortrait(const PortraitOptions& options);

}  // namespace lararium::editor
