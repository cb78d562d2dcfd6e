#include "shared/bundle/signature.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "shared/bundle/bundle.h"
#include "shared/bundle/bundle_writer.h"
#include "tests/bundle/example_show.h"
#include "tests/support/test_files.h"

namespace lararium::bundle {
namespace {

using ::testing::HasSubstr;

std::span<const std::byte> TextBytes(std::string_view text) {
  return std::as_bytes(std::span(text));
}

class SignatureTest : public ::testing::Test {
 protected:
  std::vector<MemberContent> Members() const {
    return {{"drama.lua", TextBytes("function main() end\n")},
            {"places/0/scene.larscene", TextBytes("scene")},
            {"places/0/occluder0.larmesh", TextBytes("mesh")},
            {"cast/0.larhuman", TextBytes("x")}};
  }
  std::string Write(const SecretKey* key) {
    EXPECT_TRUE(WriteBundle(path_, test::ExampleManifest(), Members(), key).ok());
    return *ReadText(path_);
  }
  std::string Open(std::string_view content, const std::optional<PublicKey>& trusted) {
    std::filesystem::remove(path_);
    std::ofstream(path_, std::ios::binary) << content;
    const auto opened = Bundle::Open(path_, {trusted});
    return opened.ok() ? "" : opened.message();
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "show.larshow";
  SecretKey museum_ = MakeSecretKey();
  SecretKey stranger_ = MakeSecretKey();
};

TEST_F(SignatureTest, OnlyWhatTheMuseumSignedIsOpenedWhereItsKeyIsPinned) {
  const std::string by_museum = Write(&museum_);
  const std::string by_stranger = Write(&stranger_);
  const std::string by_nobody = Write(nullptr);
  const PublicKey key = museum_.public_key();
  EXPECT_EQ(Open(by_museum, key), "");
  EXPECT_THAT(Open(by_stranger, key), HasSubstr("not signed with the trusted key"));
  EXPECT_THAT(Open(by_nobody, key), HasSubstr("is not signed"));
  for (const std::string& any : {by_museum, by_stranger, by_nobody}) {
    EXPECT_EQ(Open(any, std::nullopt), "");
  }
}

TEST_F(SignatureTest, EveryChangedByteOfASignedBundleIsRefused) {
  const std::string good = Write(&museum_);
  const PublicKey key = museum_.public_key();
  for (size_t i = 0; i < good.size(); ++i) {
    std::string changed = good;
    changed[i] = static_cast<char>(changed[i] ^ 0x10);
    EXPECT_NE(Open(changed, key), "") << "byte " << i;
  }
}

TEST_F(SignatureTest, TheSignatureOfAnotherShowDoesNotServe) {
  const std::string good = Write(&museum_);
  const size_t at = good.find("manifest.sig");
  ASSERT_NE(at, std::string::npos);
  ShowManifest manifest = test::ExampleManifest();
  manifest.title = "Another show";
  ASSERT_TRUE(WriteBundle(path_, manifest, Members(), &stranger_).ok());
  std::string other = *ReadText(path_);
  // Replaces the new signature by the old one, with the CRC-32 that the archive has for it.
  const auto signature_of = [](const std::string& file) {
    const size_t name = file.find("manifest.sig");
    size_t data = name + 12;
    data += 2 + static_cast<unsigned char>(file[data + 2]) + 2;  // the extra field
    return data;
  };
  other.replace(signature_of(other), 64, good, signature_of(good), 64);
  EXPECT_NE(Open(other, museum_.public_key()), "");
}

TEST_F(SignatureTest, KeysComeBackFromTheirFiles) {
  const std::filesystem::path secret = folder_ / "museum.key";
  const std::filesystem::path open = folder_ / "museum.pub";
  ASSERT_TRUE(SaveSecretKey(secret, museum_).ok());
  ASSERT_TRUE(SavePublicKey(open, museum_.public_key()).ok());
  EXPECT_EQ(LoadSecretKey(secret)->bytes, museum_.bytes);
  EXPECT_EQ(*LoadPublicKey(open), museum_.public_key());
  EXPECT_EQ(std::filesystem::status(secret).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_THAT(SaveSecretKey(secret, stranger_).message(), HasSubstr("never replaced"));
  EXPECT_THAT(LoadPublicKey(secret).message(), HasSubstr("is not a public key"));
  EXPECT_THAT(LoadSecretKey(open).message(), HasSubstr("is not a secret key"));
}

TEST_F(SignatureTest, WhatIsNoKeyIsRefused) {
  const std::filesystem::path path = folder_ / "bad.pub";
  for (const std::string& text : {std::string(), std::string("lararium public key 1 "),
                                  "lararium public key 1 " + std::string(64, 'g'),
                                  "lararium public key 1 " + std::string(66, '0'),
                                  "lararium public key 2 " + std::string(64, '0'),
                                  std::string(5000, '0'), std::string("\0\0", 2)}) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
    EXPECT_FALSE(LoadPublicKey(path).ok()) << text;
  }
  EXPECT_FALSE(LoadPublicKey(folder_ / "missing").ok());
}

TEST(Signature, HoldsForItsOwnBytesAlone) {
  const SecretKey key = MakeSecretKey();
  const auto bytes = std::as_bytes(std::span("manifest"));
  const Signature signature = Sign(bytes, key);
  EXPECT_TRUE(Verifies(bytes, std::as_bytes(std::span(signature)), key.public_key()));
  EXPECT_FALSE(Verifies(bytes.first(3), std::as_bytes(std::span(signature)), key.public_key()));
  EXPECT_FALSE(Verifies(bytes, {}, key.public_key()));
}

}  // namespace
}  // namespace lararium::bundle
