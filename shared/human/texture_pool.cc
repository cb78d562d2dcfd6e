#include "shared/human/texture_pool.h"

#include <algorithm>

namespace lararium::human {

void TexturePool::Share(std::vector<std::shared_ptr<const Texture>>& textures) {
  const std::lock_guard lock(mutex_);
  std::erase_if(known_, [](const auto& known) { return known.expired(); });
  for (std::shared_ptr<const Texture>& texture : textures) {
    const auto same = std::find_if(known_.begin(), known_.end(), [&](const auto& known) {
      const std::shared_ptr<const Texture> other = known.lock();
      return other != nullptr && *other == *texture;
    });
    if (same == known_.end()) {
      known_.push_back(texture);
    } else if (std::shared_ptr<const Texture> other = same->lock()) {
      texture = std::move(other);
    }
  }
}

}  // namespace lararium::human
