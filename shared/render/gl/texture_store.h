#pragma once

// The textures of all models on the GPU. Equal files are stored once (people share eyes, teeth and
// fabrics), at the requested resolution. If a higher resolution is requested later, textures are
// decoded again in the background, one at a time. Private to render.

#include <array>
#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "shared/core/status.h"
#include "shared/human/material.h"
#include "shared/render/gl/gl_object.h"
#include "shared/render/gl/texture_image.h"

namespace lararium::render {

struct TextureSource {
  std::shared_ptr<const human::Texture> texture;
  TextureUse use = TextureUse::kColour;
  std::string place;  // name of the texture in errors
};

class StoredTexture {
 public:
  uint32_t id() const { return texture_.id(); }

 private:
  friend class TextureStore;

  TextureSource source_;
  GlTexture texture_;
  int halvings_ = 0;  // the requested number when it was decoded
};

class TextureStore {
 public:
  // halvings: how often width and height of textures are halved (DecodeForUse).
  explicit TextureStore(int halvings) : halvings_(halvings) {}

  // Returns textures in the order of the sources. Fails if one of them cannot be decoded.
  Result<std::vector<std::shared_ptr<const StoredTexture>>> Load(
      std::span<const TextureSource> sources);

  // Changes the requested number. The next updates replace textures that are coarser. Finer ones
  // are kept, because making them coarser would cost as much time as it saves.
  void Refine(int halvings);
  // Call this before each picture. Uploads a texture that has been decoded since the last call, and
  // starts decoding the next one.
  void Update();

 private:
  // Identifies a file: use, size and two hashes, so that different files never have the same key in
  // practice.
  using Key = std::array<uint64_t, 4>;
  static Key KeyOf(const TextureSource& source);

  struct Finer {
    std::shared_ptr<StoredTexture> texture;
    Result<cv::Mat> image;
    int halvings;
  };

  std::shared_ptr<StoredTexture> Find(const Key& key) const;
  std::shared_ptr<StoredTexture> FindCoarse() const;

  int halvings_;
  std::map<Key, std::weak_ptr<StoredTexture>> textures_;
  bool any_coarse_ = false;
  std::future<Finer> decoding_;
};

}  // namespace lararium::render
