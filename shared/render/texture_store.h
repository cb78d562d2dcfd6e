#pragma once

// The textures of the models that there are, on the GPU: those of equal files once (people share
// eyes, teeth and fabrics), and no finer than is wanted. Where finer ones are wanted they are
// decoded beside drawing, one after the other. Private to render.

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
#include "shared/render/gl_object.h"
#include "shared/render/texture_image.h"

namespace lararium::render {

struct TextureSource {
  std::shared_ptr<const human::Texture> texture;
  TextureUse use = TextureUse::kColour;
  std::string place;  // what errors call it
};

class StoredTexture {
 public:
  uint32_t id() const { return texture_.id(); }

 private:
  friend class TextureStore;

  TextureSource source_;
  GlTexture texture_;
  int halvings_ = 0;  // that were wanted when it was decoded
};

class TextureStore {
 public:
  // halvings: how often textures are half as wide and high (DecodeForUse).
  explicit TextureStore(int halvings) : halvings_(halvings) {}

  // In the order of the sources. Fails where one cannot be decoded.
  Result<std::vector<std::shared_ptr<const StoredTexture>>> Load(
      std::span<const TextureSource> sources);

  // Textures become finer with the next updates where they are coarser than that. None becomes
  // coarser: that would take as long as what it saves.
  void Refine(int halvings);
  // Before a picture: uploads one that has been decoded since, and lets the next be decoded.
  void Update();

 private:
  // What files are told apart by: use, size, and two hashes, by which no two files agree by chance.
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
