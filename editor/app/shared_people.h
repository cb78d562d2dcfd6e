#pragma once

// People as files have them, read once for all who show them at the same time: the preview that
// is seen, the one that is made ready to follow it, the drama that is run dry, the studio.

#include <filesystem>
#include <memory>

#include "shared/core/status.h"
#include "shared/human/human.h"
#include "shared/show/person_light.h"

namespace lararium::app {

struct SharedPerson {
  std::shared_ptr<const human::Human> human;
  std::shared_ptr<const show::UnpackedLight> light;  // what was taken out of it
};

// The person whom somebody holds already, as long as the file has not changed since; else read from
// it. Nobody is kept whom no one holds. On any thread.
Result<SharedPerson> SharePerson(const std::filesystem::path& file);

}  // namespace lararium::app
