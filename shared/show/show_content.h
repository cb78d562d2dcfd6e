#pragma once

// All that one show needs at one place, ready to run.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shared/bundle/bundle.h"
#include "shared/core/status.h"
#include "shared/human/human.h"
#include "shared/stage/place.h"
#include "shared/vision/scene_database.h"

namespace lararium::show {

struct CastMember {
  std::string name;  // as the drama calls the actor
  std::shared_ptr<const human::Human> human;
};

struct ShowContent {
  std::string title;
  std::shared_ptr<const vision::SceneDatabase> database;
  stage::Place place;
  std::vector<CastMember> cast;
  std::string drama;       // Lua source
  std::string drama_file;  // what messages call it
};

// The content of a bundle at the named place, or at its first one. Every member
// is checked by its own reader.
Result<ShowContent> LoadShowContent(const bundle::Bundle& bundle, std::string_view place = {});

}  // namespace lararium::show
