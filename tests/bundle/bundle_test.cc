#include "shared/bundle/bundle.h"

#include <gmock/gmock.h>
#include <zip.h>

#include <filesystem>
#include <fstream>

#include "shared/bundle/bundle_writer.h"
#include "tests/bundle/example_show.h"
#include "tests/bundle/zip_archive.h"
#include "tests/support/test_files.h"

namespace lararium::bundle {
namespace {

using test::MakeZip;
using test::ZipEntry;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::span<const std::byte> Bytes(std::string_view text) { return std::as_bytes(std::span(text)); }

std::string Text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

class BundleTest : public ::testing::Test {
 protected:
  // The example show's members, of various sizes.
  std::vector<MemberContent> Members() const {
    return {{"drama.lua", Bytes("function main() end\n")},
            {"places/0/scene.larscene", Bytes(scene_)},
            {"places/0/occluder0.larmesh", Bytes(std::string_view())},
            {"cast/0.larhuman", Bytes("x")}};
  }

  // The content of a good bundle.
  std::string GoodFile() {
    EXPECT_TRUE(WriteBundle(path_, test::ExampleManifest(), Members()).ok());
    return *ReadText(path_);
  }

  // The same show as hand-made entries.
  std::vector<ZipEntry> GoodEntries() const {
    ShowManifest manifest = test::ExampleManifest();
    std::vector<ZipEntry> entries(1);
    for (const MemberContent& member : Members()) {
      const auto bytes = std::get<std::span<const std::byte>>(member.content);
      manifest.members.push_back({member.name, bytes.size(), ComputeSha256(bytes)});
      entries.push_back({member.name, Text(bytes)});
    }
    entries[0] = {"manifest.json", FormatShowManifest(manifest)};
    return entries;
  }

  // Returns the error of opening a file with this content; "" if it opens.
  std::string Open(std::string_view content) {
    std::filesystem::remove(path_);  // Replacing a file would force a flush.
    std::ofstream(path_, std::ios::binary) << content;
    const auto opened = Bundle::Open(path_);
    if (!opened.ok()) {
      EXPECT_THAT(opened.message(), HasSubstr(path_.string()));
      EXPECT_THAT(opened.message(), HasSubstr("; ")) << "a remedy";
    }
    return opened.ok() ? "" : opened.message();
  }

  test::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_ / "show.larshow";
  std::string scene_ = std::string(1000, 's') + "end";
};

TEST_F(BundleTest, GivesBackWhatWasWritten) {
  GoodFile();
  const auto opened = Bundle::Open(path_);
  ASSERT_TRUE(opened.ok()) << opened.message();
  EXPECT_EQ(opened->manifest().title, "The thermopolium");
  EXPECT_EQ(opened->manifest().members.size(), 4u);
  for (const MemberContent& member : Members()) {
    const auto bytes = opened->member(member.name);
    ASSERT_TRUE(bytes.ok());
    EXPECT_EQ(Text(*bytes), Text(std::get<std::span<const std::byte>>(member.content)));
    EXPECT_EQ(reinterpret_cast<uintptr_t>(bytes->data()) % 64, 0u);
  }
  EXPECT_FALSE(opened->member("nothing").ok());
}

TEST_F(BundleTest, AMemberIsReadAgainOnlyWhileItIsWhatItWas) {
  const std::string good = GoodFile();
  std::vector<StoredMember> members;
  {
    const auto opened = Bundle::Open(path_);
    ASSERT_TRUE(opened.ok()) << opened.message();
    EXPECT_FALSE(opened->stored("nothing").ok());
    for (const MemberContent& member : Members()) {
      members.push_back(*opened->stored(member.name));
      EXPECT_EQ(Text(*members.back().Read()), Text(*opened->member(member.name)));
    }
  }
  const StoredMember& member = members.back();
  ASSERT_GT(member.size, 0u);
  std::string changed = good;
  changed[member.offset] ^= 1;
  std::ofstream(path_, std::ios::binary) << changed;
  EXPECT_THAT(member.Read().message(), HasSubstr(member.name));
  std::ofstream(path_, std::ios::binary) << good.substr(0, member.offset);
  EXPECT_FALSE(member.Read().ok());
  std::filesystem::remove(path_);
  EXPECT_THAT(member.Read().message(), HasSubstr(path_.string()));
}

TEST_F(BundleTest, TheSameContentGivesTheSameBytes) {
  const std::string first = GoodFile();
  EXPECT_EQ(GoodFile(), first);
  EXPECT_EQ(MakeZip(GoodEntries()), first) << "the writer and the format differ";
}

TEST_F(BundleTest, MembersCanComeFromFiles) {
  const std::filesystem::path file = folder_ / "scene";
  ASSERT_TRUE(WriteFileAtomically(file, scene_).ok());
  std::vector<MemberContent> members = Members();
  members[1].content = file;
  const std::string expected = GoodFile();
  ASSERT_TRUE(WriteBundle(path_, test::ExampleManifest(), members).ok());
  EXPECT_EQ(*ReadText(path_), expected);
  members[1].content = folder_ / "missing";
  EXPECT_THAT(WriteBundle(path_, test::ExampleManifest(), members).message(), HasSubstr("missing"));
}

TEST_F(BundleTest, ItsNameMayHaveAllTheBytesThatNamesOfFilesHave) {
  const std::filesystem::path longest = folder_ / (std::string(247, 'n') + ".larshow");
  ASSERT_EQ(longest.filename().string().size(), 255u);
  const Status written = WriteBundle(longest, test::ExampleManifest(), Members());
  ASSERT_TRUE(written.ok()) << written.message();
  EXPECT_EQ(*ReadText(longest), GoodFile());
}

TEST_F(BundleTest, IsAZipThatOthersRead) {
  GoodFile();
  zip_t* archive = zip_open(path_.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, nullptr);
  ASSERT_NE(archive, nullptr);
  EXPECT_EQ(zip_get_num_entries(archive, 0), 5);
  EXPECT_STREQ(zip_get_name(archive, 0, 0), "manifest.json");
  zip_discard(archive);
}

TEST_F(BundleTest, EveryChangedByteIsNoticed) {
  const std::string good = GoodFile();
  for (size_t i = 0; i < good.size(); ++i) {
    for (const char flip : {'\x01', '\x20', '\xff'}) {
      std::string changed = good;
      changed[i] = static_cast<char>(changed[i] ^ flip);
      EXPECT_NE(Open(changed), "") << "byte " << i << " of " << good.size();
    }
  }
}

TEST_F(BundleTest, EveryTruncationIsNoticed) {
  const std::string good = GoodFile();
  for (size_t size = 0; size < good.size(); ++size) {
    EXPECT_NE(Open(good.substr(0, size)), "") << size;
  }
}

TEST_F(BundleTest, EveryInsertedOrAppendedByteIsNoticed) {
  const std::string good = GoodFile();
  for (size_t at = 0; at <= good.size(); at += 7) {
    EXPECT_NE(Open(good.substr(0, at) + '\0' + good.substr(at)), "") << at;
  }
  EXPECT_NE(Open(good + '\0'), "");
  EXPECT_NE(Open(good + good), "");
}

TEST_F(BundleTest, ErrorsSayWhatTheFileIs) {
  EXPECT_THAT(Open(""), HasSubstr("empty"));
  EXPECT_THAT(Open("P"), HasSubstr("not a bundle"));
  EXPECT_THAT(Open("#!/bin/sh\necho no zip at all, but long enough\n"), HasSubstr("not a bundle"));
  EXPECT_THAT(Open(GoodFile().substr(0, 500)), HasSubstr("its end is missing"));
  EXPECT_FALSE(Bundle::Open(folder_ / "missing").ok());
  EXPECT_FALSE(Bundle::Open(folder_.path()).ok());
}

TEST_F(BundleTest, HostileArchivesAreRefused) {
  const auto with = [&](size_t index, auto change) {
    std::vector<ZipEntry> entries = GoodEntries();
    change(entries.at(index));
    return Open(MakeZip(entries));
  };
  EXPECT_EQ(Open(MakeZip(GoodEntries())), "");
  for (const char* name : {"../x", "/etc/x", "a\\b", "a//b", "", "a/"}) {
    EXPECT_THAT(with(1, [&](ZipEntry& e) { e.name = name; }),
                HasSubstr(std::string("the member name '") + name + "' is not allowed"));
  }
  EXPECT_THAT(with(2, [](ZipEntry& e) { e.name = "drama.lua"; }),
              HasSubstr("two members are called 'drama.lua'"));
  EXPECT_THAT(with(1, [](ZipEntry& e) { e.method = 8; }), HasSubstr("compressed"));
  EXPECT_THAT(with(1, [](ZipEntry& e) { e.flags = 1; }), HasSubstr("encrypted"));
  EXPECT_THAT(with(1, [](ZipEntry& e) { e.flags = 8; }),
              HasSubstr("entry of 'drama.lua' is wrong"));
  EXPECT_THAT(with(4, [](ZipEntry& e) { e.claimed_size = 0xfffffff0; }), HasSubstr("cut short"));
  EXPECT_THAT(with(2, [](ZipEntry& e) { e.claimed_size = 10; }), HasSubstr("is wrong"));
  EXPECT_THAT(with(2, [](ZipEntry& e) { e.claimed_offset = 0; }), HasSubstr("is wrong"));
  EXPECT_THAT(with(4, [](ZipEntry& e) { e.in_directory = false; }),
              HasSubstr("belong to no member"));
  EXPECT_THAT(with(2, [](ZipEntry& e) { e.in_directory = false; }), HasSubstr("is wrong"));
  EXPECT_THAT(Open(MakeZip(GoodEntries(), 60000)), HasSubstr("more than 16384 members"));
  EXPECT_THAT(Open(MakeZip(GoodEntries(), 4000)), HasSubstr("directory is too short"));
  EXPECT_THAT(Open(MakeZip({})), HasSubstr("has no members"));
}

TEST_F(BundleTest, TheManifestAndTheMembersMustAgree) {
  std::vector<ZipEntry> entries = GoodEntries();
  entries.push_back({"extra", "data"});
  EXPECT_THAT(Open(MakeZip(entries)), HasSubstr("does not list 'extra'"));

  entries = GoodEntries();
  entries.pop_back();
  EXPECT_THAT(Open(MakeZip(entries)), HasSubstr("'cast/0.larhuman' is not in its place"));

  entries = GoodEntries();
  std::swap(entries[1], entries[2]);
  EXPECT_THAT(Open(MakeZip(entries)), HasSubstr("is not in its place"));

  entries = GoodEntries();
  entries[1].data += ' ';
  EXPECT_THAT(Open(MakeZip(entries)), HasSubstr("bytes instead of"));

  entries = GoodEntries();
  entries[1].data[0] = 'F';
  EXPECT_THAT(Open(MakeZip(entries)), HasSubstr("'drama.lua' was changed"));

  entries = GoodEntries();
  std::swap(entries[0], entries[1]);
  EXPECT_THAT(Open(MakeZip(entries)), HasSubstr("does not begin with a manifest"));
}

TEST_F(BundleTest, FailedWritingLeavesTheOldFile) {
  const std::string good = GoodFile();
  std::vector<MemberContent> members = Members();
  members[0].name = "../drama.lua";
  EXPECT_FALSE(WriteBundle(path_, test::ExampleManifest(), members).ok());
  members = Members();
  members.pop_back();
  EXPECT_THAT(WriteBundle(path_, test::ExampleManifest(), members).message(),
              AllOf(HasSubstr("cast/0.larhuman"), HasSubstr("not listed")));
  EXPECT_EQ(*ReadText(path_), good);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
  EXPECT_FALSE(WriteBundle(folder_ / "no/folder/x", test::ExampleManifest(), Members()).ok());
}

TEST(Sha256, KnowsThePublishedDigest) {
  // FIPS 180-4's example "abc".
  const std::string_view digest =
      "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  EXPECT_EQ(FormatSha256(ComputeSha256(Bytes("abc"))), digest);
  EXPECT_EQ(ParseSha256(digest), ComputeSha256(Bytes("abc")));
  EXPECT_EQ(ParseSha256(std::string(64, 'g')), std::nullopt);
}

}  // namespace
}  // namespace lararium::bundle
