#include "shared/bundle/web_folder.h"

#include <gmock/gmock.h>
#include <zlib.h>

#include <fstream>
#include <map>

#include "shared/bundle/bundle.h"
#include "shared/core/file.h"
#include "tests/bundle/example_show.h"
#include "tests/support/test_files.h"

namespace lararium::bundle {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string Unpack(std::string_view packed, size_t size) {
  std::string bytes(size, '\0');
  z_stream stream = {};
  EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(size);
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  inflateEnd(&stream);
  return bytes;
}

class WebFolderTest : public ::testing::Test {
 protected:
  static std::span<const std::byte> Bytes(std::string_view text) {
    return std::as_bytes(std::span(text));
  }

  Result<WebFolderReport> Write(const std::string& drama = "function main() end\n") {
    drama_ = drama;
    return WriteWebFolder(folder_, test::ExampleManifest(),
                          {{"drama.lua", Bytes(drama_)},
                           {"places/0/scene.larscene", Bytes(scene_)},
                           {"places/0/occluder0.larmesh", Bytes(std::string_view())},
                           {"cast/0.larhuman", Bytes("x")}},
                          {{"index.html", Bytes("<!doctype html>")},
                           {"tracker/module.wasm", Bytes(std::string_view(program_))}},
                          key_);
  }

  Result<Bundle> Open(std::string_view manifest, std::string_view signature) const {
    return Bundle::FromManifest(manifest, Bytes(signature), key_.public_key(), "show");
  }
  std::string Manifest() const { return *ReadText(folder_ / "show/manifest.json"); }
  std::string Signature() const { return *ReadText(folder_ / "show/manifest.sig"); }

  static Piece PieceOf(std::string_view bytes) {
    Piece piece(bytes.size());
    std::copy_n(Bytes(bytes).begin(), bytes.size(), piece.bytes().begin());
    return piece;
  }
  // The content of a member, from its own file.
  std::string Read(const Member& member) const {
    const std::string file = *ReadText(folder_ / "show" / FormatSha256(member.sha256));
    EXPECT_EQ(file.size(), member.packed > 0 ? member.packed : member.size);
    return member.packed > 0 ? Unpack(file, member.size) : file;
  }
  std::map<std::string, std::string> Files() const {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      if (entry.is_regular_file()) {
        files[entry.path().lexically_relative(folder_).string()] = *ReadText(entry.path());
      }
    }
    return files;
  }
  // Nothing may be left beside the folder.
  size_t EntriesBeside() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(around_.path()), {}));
  }

  test::TemporaryFolder around_;
  fs::path folder_ = around_ / "web";
  std::string drama_;
  std::string scene_ = std::string(5000, 's') + "end";
  std::string program_ = std::string(3000, 'p');
  SecretKey key_ = MakeSecretKey();
};

TEST_F(WebFolderTest, EveryMemberIsAFileThatIsNamedByItsHash) {
  const auto report = Write();
  ASSERT_TRUE(report.ok()) << report.message();
  auto opened = Open(Manifest(), Signature());
  ASSERT_TRUE(opened.ok()) << opened.message();
  ASSERT_EQ(opened->manifest().members.size(), 4u);
  for (const Member& member : opened->manifest().members) {
    EXPECT_FALSE(opened->member(member.name).ok()) << "it has not arrived";
    ASSERT_TRUE(opened->Add(member.name, PieceOf(Read(member))).ok()) << member.name;
  }
  const auto scene = *opened->member("places/0/scene.larscene");
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(scene.data()), scene.size()), scene_);
  EXPECT_EQ(reinterpret_cast<uintptr_t>(scene.data()) % 64, 0u);
  EXPECT_LT(report->members.at("places"), 200u) << "it is compressed";
  opened->Remove("places/0/scene.larscene");
  EXPECT_FALSE(opened->Has("places/0/scene.larscene"));
  EXPECT_TRUE(opened->Has("drama.lua"));
}

TEST_F(WebFolderTest, AnAlteredPieceIsRefused) {
  ASSERT_TRUE(Write().ok());
  auto opened = Open(Manifest(), Signature());
  ASSERT_TRUE(opened.ok());
  std::string altered = scene_;
  altered[17] ^= 1;
  const auto says = AllOf(HasSubstr("'places/0/scene.larscene' was changed"), HasSubstr("; "));
  EXPECT_THAT(opened->Add("places/0/scene.larscene", PieceOf(altered)).message(), says);
  EXPECT_THAT(opened->Add("places/0/scene.larscene", PieceOf(scene_ + " ")).message(), says);
  EXPECT_FALSE(opened->Has("places/0/scene.larscene"));
  EXPECT_THAT(opened->Add("other", PieceOf("x")).message(), HasSubstr("does not list 'other'"));
}

TEST_F(WebFolderTest, AManifestThatTheKeyDoesNotSignIsRefused) {
  ASSERT_TRUE(Write().ok());
  std::string altered = Manifest();
  altered[altered.find("thermopolium")] = 'T';
  EXPECT_THAT(Open(altered, Signature()).message(), HasSubstr("or was altered"));
  EXPECT_THAT(Open(Manifest(), "").message(), HasSubstr("not signed"));
  const SecretKey other = MakeSecretKey();
  EXPECT_THAT(
      Bundle::FromManifest(Manifest(), Bytes(Signature()), other.public_key(), "show").message(),
      HasSubstr("not signed with the trusted key"));
}

TEST_F(WebFolderTest, ThePageHasItsHashesInTheManifestToo) {
  ASSERT_TRUE(Write().ok());
  const auto opened = Open(Manifest(), Signature());
  ASSERT_TRUE(opened.ok());
  const std::map<std::string, std::string> files = Files();
  ASSERT_EQ(opened->manifest().page.size(), 3u);
  for (const Member& file : opened->manifest().page) {
    ASSERT_TRUE(files.contains(file.name)) << file.name;
    EXPECT_EQ(ComputeSha256(Bytes(files.at(file.name))), file.sha256) << file.name;
  }
  EXPECT_EQ(Unpack(files.at("tracker/module.wasm"), program_.size()), program_);
  EXPECT_EQ(ParsePublicKey(files.at("museum.pub"), "key")->bytes, key_.public_key().bytes);
}

TEST_F(WebFolderTest, AnUpdateReplacesTheFolderAndKeepsTheNamesOfWhatDidNotChange) {
  ASSERT_TRUE(Write().ok());
  const std::map<std::string, std::string> before = Files();
  ASSERT_TRUE(Write().ok());
  EXPECT_EQ(Files(), before) << "equal content gives equal files";
  ASSERT_TRUE(Write("function main() walk() end\n").ok());
  std::map<std::string, std::string> after = Files();
  EXPECT_EQ(after.size(), before.size());
  size_t shared = 0;
  for (const auto& [name, content] : before) {
    shared += after.contains(name) && after[name] == content ? 1 : 0;
  }
  EXPECT_EQ(shared, before.size() - 3) << "all but manifest, signature and drama";
  EXPECT_EQ(EntriesBeside(), 1u);
}

TEST_F(WebFolderTest, WhatOthersHaveWrittenIsNeitherLostNorMixed) {
  fs::create_directory(folder_);
  ASSERT_TRUE(Write().ok()) << "an empty folder is taken";
  std::ofstream(folder_ / "show/notes.txt") << "mine";
  EXPECT_THAT(Write("other").message(), HasSubstr("'show/notes.txt' is no part of the show in it"));
  EXPECT_EQ(*ReadText(folder_ / "show/notes.txt"), "mine");
  fs::remove_all(folder_);
  fs::create_directory(folder_);
  std::ofstream(folder_ / "thesis.txt") << "mine";
  EXPECT_THAT(Write().message(), AllOf(HasSubstr("is not a show for browsers"), HasSubstr("; ")));
  fs::remove_all(folder_);
  std::ofstream(folder_) << "a file";
  EXPECT_FALSE(Write().ok());
  EXPECT_EQ(*ReadText(folder_), "a file");
  EXPECT_EQ(EntriesBeside(), 1u);
}

TEST_F(WebFolderTest, ALinkToAFolderStays) {
  fs::create_directory(around_ / "real");
  fs::create_directory_symlink(around_ / "real", folder_);
  ASSERT_TRUE(Write().ok());
  EXPECT_TRUE(fs::is_symlink(folder_));
  EXPECT_TRUE(FileExists(around_ / "real/index.html"));
}

TEST_F(WebFolderTest, ABrokenShowLeavesTheFolderAsItWas) {
  ASSERT_TRUE(Write().ok());
  const std::map<std::string, std::string> before = Files();
  const auto failed =
      WriteWebFolder(folder_, test::ExampleManifest(), {{"drama.lua", Bytes("x")}}, {}, key_);
  EXPECT_THAT(failed.message(), HasSubstr("is used but not listed"));
  EXPECT_EQ(Files(), before);
  EXPECT_EQ(EntriesBeside(), 1u);
}

}  // namespace
}  // namespace lararium::bundle
