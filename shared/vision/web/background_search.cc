#include "shared/vision/background/joined_search.h"

namespace lararium::vision {

// In a browser there are no threads that share memory; a search in a second worker is another
// BackgroundSearch.
std::unique_ptr<BackgroundSearch> MakeBackgroundSearch(Relocalizer& relocalizer, int /*threads*/) {
  return std::make_unique<JoinedSearch>(relocalizer);
}

}  // namespace lararium::vision
