#include "shared/render/gl/texture_store.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <optional>
#include <utility>

#include "shared/core/background.h"
#include "shared/core/parallel.h"
#include "shared/render/gl/surface_texture.h"

namespace lararium::render {
namespace {

// FNV-1a hash over words of 8 bytes. Two seeds give two hashes.
uint64_t Hash(std::span<const std::byte> bytes, uint64_t seed) {
  constexpr uint64_t kPrime = 0x100000001b3;
  uint64_t hash = seed;
  size_t at = 0;
  for (; at + sizeof(uint64_t) <= bytes.size(); at += sizeof(uint64_t)) {
    uint64_t word = 0;
    std::memcpy(&word, &bytes[at], sizeof(word));
    hash = (hash ^ word) * kPrime;
    hash ^= hash >> 29;
  }
  for (; at < bytes.size(); ++at) {
    hash = (hash ^ std::to_integer<uint64_t>(bytes[at])) * kPrime;
  }
  return hash;
}

Result<cv::Mat> Decode(const TextureSource& source, int halvings) {
  return DecodeForUse(source.texture->encoded, source.use, halvings, source.place);
}

}  // namespace

TextureStore::Key TextureStore::KeyOf(const TextureSource& source) {
  const std::span<const std::byte> encoded = source.texture->encoded;
  return {static_cast<uint64_t>(source.use), encoded.size(), Hash(encoded, 0xcbf29ce484222325),
          Hash(encoded, 0x9e3779b97f4a7c15)};
}

std::shared_ptr<StoredTexture> TextureStore::Find(const Key& key) const {
  const auto found = textures_.find(key);
  return found == textures_.end() ? nullptr : found->second.lock();
}

Result<std::vector<std::shared_ptr<const StoredTexture>>> TextureStore::Load(
    std::span<const TextureSource> sources) {
  std::vector<Key> keys;
  std::vector<std::shared_ptr<const StoredTexture>> loaded;
  std::vector<size_t> missing;
  for (size_t i = 0; i < sources.size(); ++i) {
    keys.push_back(KeyOf(sources[i]));
    loaded.push_back(Find(keys.back()));
    if (loaded.back() == nullptr) {
      missing.push_back(i);
    }
  }
  // Only a few at a time, because decoded images take megabytes each.
  constexpr size_t kAtOnce = 4;
  for (size_t begin = 0; begin < missing.size(); begin += kAtOnce) {
    std::array<std::optional<Result<cv::Mat>>, kAtOnce> images;
    const size_t count = std::min(kAtOnce, missing.size() - begin);
    ParallelFor(count,
                [&](size_t i) { images[i] = Decode(sources[missing[begin + i]], halvings_); });
    for (size_t i = 0; i < count; ++i) {
      const size_t at = missing[begin + i];
      LARARIUM_ASSIGN_OR_RETURN(cv::Mat image, std::move(*images[i]));
      auto stored = std::make_shared<StoredTexture>();
      stored->source_ = sources[at];
      stored->texture_ = CreateSurfaceTexture(std::move(image), sources[at].use);
      stored->halvings_ = halvings_;
      textures_[keys[at]] = stored;
      loaded[at] = std::move(stored);
    }
  }
  return loaded;
}

void TextureStore::Refine(int halvings) {
  if (halvings < halvings_) {
    halvings_ = halvings;
    any_coarse_ = true;
  }
}

std::shared_ptr<StoredTexture> TextureStore::FindCoarse() const {
  for (const auto& [key, texture] : textures_) {
    std::shared_ptr<StoredTexture> stored = texture.lock();
    if (stored != nullptr && stored->halvings_ > halvings_) {
      return stored;
    }
  }
  return nullptr;
}

void TextureStore::Update() {
  if (!any_coarse_) {
    return;
  }
  if (decoding_.valid()) {
    if (decoding_.wait_for(std::chrono::seconds(0)) == std::future_status::timeout) {
      return;
    }
    Finer finer = decoding_.get();
    StoredTexture& stored = *finer.texture;
    stored.halvings_ = finer.halvings;
    if (finer.image.ok()) {  // decoding succeeded before, so it does now
      stored.texture_ = CreateSurfaceTexture(std::move(finer.image).value(), stored.source_.use);
    }
  }
  std::shared_ptr<StoredTexture> coarse = FindCoarse();
  any_coarse_ = coarse != nullptr;
  if (any_coarse_) {
    decoding_ = std::async(BackgroundLaunch(),
                           [texture = std::move(coarse), halvings = halvings_]() mutable -> Finer {
                             Result<cv::Mat> image = Decode(texture->source_, halvings);
                             return {std::move(texture), std::move(image), halvings};
                           });
  }
}

}  // namespace lararium::render
