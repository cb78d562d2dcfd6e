#pragma once

// Equal textures of several models in memory once: people share eyes, teeth and fabrics, and
// whoever is read again has what they had.

#include <memory>
#include <mutex>
#include <vector>

#include "shared/human/material.h"

namespace lararium::human {

class TexturePool {
 public:
  // What is equal to a texture that somebody still has becomes that one. None may be nullptr. From
  // any thread.
  void Share(std::vector<std::shared_ptr<const Texture>>& textures);

 private:
  std::mutex mutex_;
  std::vector<std::weak_ptr<const Texture>> known_;
};

}  // namespace lararium::human
