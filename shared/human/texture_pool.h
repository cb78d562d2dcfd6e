#pragma once

// Keeps equal textures of several models in memory only once: people share eyes, teeth and fabrics,
// and a reloaded person reuses the textures that are still loaded.

#include <memory>
#include <mutex>
#include <vector>

#include "shared/human/material.h"

namespace lararium::human {

class TexturePool {
 public:
  // Replaces each texture by an equal one that is still in use, if there is one. None may be
  // nullptr. Thread-safe.
  void Share(std::vector<std::shared_ptr<const Texture>>& textures);

 private:
  std::mutex mutex_;
  std::vector<std::weak_ptr<const Texture>> known_;
};

}  // namespace lararium::human
