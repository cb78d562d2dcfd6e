#pragma once

// What is selected in the project.

#include <string>

namespace lararium::panels {

struct Selection {
  enum class Kind {
    kProject,
    kPlace,
    kStage,
    kPicks,
    kNudge,
    kOccluder,
    kProbe,
    kActor,
    kObject,
    kCheckPoint
  };
  Kind kind = Kind::kStage;
  std::string name;  // The name of a probe, occluder, check point, actor or object.

  friend bool operator==(const Selection&, const Selection&) = default;
};

}  // namespace lararium::panels
