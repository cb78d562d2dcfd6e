#include "shared/human/texture_pool.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace lararium::human {
namespace {

std::shared_ptr<const Texture> Make(const std::string& name, size_t size) {
  return std::make_shared<const Texture>(
      Texture{name, std::vector<std::byte>(size, std::byte{0x89})});
}

TEST(TexturePool, EqualTexturesBecomeOne) {
  TexturePool pool;
  std::vector first = {Make("eyes", 10), Make("wool", 10)};
  std::vector second = {Make("wool", 10), Make("wool", 11), Make("eyes", 10)};
  const std::vector before = second;
  pool.Share(first);
  pool.Share(second);
  EXPECT_EQ(second[0], first[1]);
  EXPECT_EQ(second[1], before[1]);
  EXPECT_EQ(second[2], first[0]);
}

TEST(TexturePool, KeepsNothingThatNobodyHas) {
  TexturePool pool;
  std::vector textures = {Make("eyes", 10)};
  const std::weak_ptr<const Texture> known = textures[0];
  pool.Share(textures);
  textures.clear();
  EXPECT_TRUE(known.expired());
  textures = {Make("eyes", 10)};
  const std::vector before = textures;
  pool.Share(textures);
  EXPECT_EQ(textures, before);
}

}  // namespace
}  // namespace lararium::human
