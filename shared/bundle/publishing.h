#pragma once

// Publishes shows in a folder that a web server serves to players (publication.h).

#include <cstdint>
#include <filesystem>

#include "shared/bundle/publication.h"
#include "shared/bundle/signature.h"
#include "shared/core/status.h"

namespace lararium::bundle {

// A folder may be published in if it does not exist or its newest.json, if there is one, is signed
// with the key.
Status CheckPublishing(const std::filesystem::path& folder, const PublicKey& key);

// Moves a bundle on the same disk, which is signed with the key, into the folder and names it as
// the newest show. The serial is the time (seconds since 1970), or one more than that of the show
// before. The bundle before stays, because players may be fetching it; older ones are removed. A
// show that is the newest already keeps its serial. On failure the newest show stays as it was.
Result<Publication> Publish(const std::filesystem::path& bundle,
                            const std::filesystem::path& folder,
                            const SecretKey& key,
                            uint64_t time);

}  // namespace lararium::bundle
