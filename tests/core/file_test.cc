#include "shared/core/file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "shared/core/free_space.h"
#include "tests/support/test_files.h"

namespace lararium {
namespace {

TEST(File, WritesWhatItReads) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "a", "text\0more").ok());
  ASSERT_TRUE(WriteFileAtomically(folder / "a", std::string_view("one\0two", 7)).ok());
  EXPECT_EQ(ReadText(folder / "a").value(), std::string("one\0two", 7));
  EXPECT_EQ(ReadBytes(folder / "a").value().size(), 7u);
}

TEST(File, AFailedWriteLeavesTheOldFileAndNoOther) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "a", "old").ok());
  // A folder at the target path makes the final rename fail.
  std::filesystem::create_directory(folder / "b");
  std::ofstream(folder / "b/keep") << "x";
  EXPECT_FALSE(WriteFileAtomically(folder / "b", "new").ok());
  EXPECT_EQ(ReadText(folder / "a").value(), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);
}

mode_t ModeOf(const std::filesystem::path& file) {
  struct stat info {};
  return ::stat(file.c_str(), &info) == 0 ? info.st_mode & 07777 : 0;
}

TEST(File, SavingWritesWhatASymbolicLinkNames) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "shared");
  ASSERT_TRUE(WriteFileAtomically(folder / "shared/lines", "old").ok());
  std::filesystem::create_symlink("shared/lines", folder / "relative");
  std::filesystem::create_symlink(folder / "relative", folder / "link");
  ASSERT_TRUE(WriteFileAtomically(folder / "link", "new").ok());
  EXPECT_EQ(ReadText(folder / "shared/lines").value(), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "relative"));
  // A link may name a file that is yet to be written.
  std::filesystem::create_symlink("shared/none", folder / "dangling");
  ASSERT_TRUE(WriteFileAtomically(folder / "dangling", "first").ok());
  EXPECT_EQ(ReadText(folder / "shared/none").value(), "first");
  std::filesystem::create_symlink("circle", folder / "circle");
  EXPECT_NE(WriteFileAtomically(folder / "circle", "x").message().find("circle"),
            std::string::npos);
}

TEST(File, SavingKeepsTheModeAndNewFilesFollowTheUmask) {
  const test::TemporaryFolder folder;
  const mode_t before = ::umask(0027);
  ASSERT_TRUE(WriteFileAtomically(folder / "new", "x").ok());
  EXPECT_EQ(ModeOf(folder / "new"), 0640u);
  ASSERT_EQ(::chmod((folder / "new").c_str(), 0604), 0);
  ASSERT_TRUE(WriteFileAtomically(folder / "new", "y").ok());
  EXPECT_EQ(ModeOf(folder / "new"), 0604u);
  ::umask(before);
}

TEST(File, WritesNamesThatLeaveNoRoomForASuffix) {
  const test::TemporaryFolder folder;
  const std::string name(255, 'n');
  ASSERT_TRUE(WriteFileAtomically(folder / name, "x").ok());
  EXPECT_EQ(ReadText(folder / name).value(), "x");
}

TEST(File, AnUnfinishedReplacementLeavesNothing) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "a", "old").ok());
  { ASSERT_TRUE(FileReplacement::Begin(folder / "a").ok()); }
  EXPECT_EQ(ReadText(folder / "a").value(), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(File, SaysBeforehandThatADiskIsTooSmall) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(RequireSpace(folder / "not/yet/there", 1).ok());
  EXPECT_FALSE(RequireSpace(folder / "not/yet/there", uint64_t{1} << 60).ok());
  const auto free = [&folder](std::optional<uint64_t> bytes) {
    return RequireSpace(folder.path(), 64'000'000, [=](const auto&) { return bytes; });
  };
  EXPECT_TRUE(free(64'000'000).ok());
  EXPECT_TRUE(free(std::nullopt).ok());
  EXPECT_NE(free(63'000'000).message().find("the disk is full: 63 MB are free and 64 MB are"),
            std::string::npos);
}

TEST(File, ErrorsNameTheFile) {
  const test::TemporaryFolder folder;
  EXPECT_NE(ReadText(folder / "none").message().find("none"), std::string::npos);
  EXPECT_NE(ReadText(folder.path()).message().find("not a regular file"), std::string::npos);
  EXPECT_FALSE(WriteFileAtomically(folder / "no/such", "x").ok());
}

TEST(File, RefusesWhatIsTooLarge) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "a", "12345").ok());
  EXPECT_TRUE(ReadText(folder / "a", 5).ok());
  EXPECT_FALSE(ReadText(folder / "a", 4).ok());
}

TEST(File, ReadsAPartThatItHas) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "a", "0123456789").ok());
  const std::vector<std::byte> part = ReadBytesAt(folder / "a", 3, 4).value();
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(part.data()), part.size()), "3456");
  EXPECT_TRUE(ReadBytesAt(folder / "a", 10, 0).ok());
  EXPECT_FALSE(ReadBytesAt(folder / "a", 3, 8).ok());
  EXPECT_FALSE(ReadBytesAt(folder / "a", 11, 0).ok());
  EXPECT_FALSE(ReadBytesAt(folder / "a", 3, ~size_t{0}).ok());
}

TEST(File, DoesNotHangOnAPipe) {
  const test::TemporaryFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_FALSE(ReadText(folder / "pipe").ok());
  EXPECT_FALSE(MappedFile::Open(folder / "pipe").ok());
}

TEST(MappedFile, ShowsTheBytesAndRefusesAnEmptyFile) {
  const test::TemporaryFolder folder;
  ASSERT_TRUE(WriteFileAtomically(folder / "a", "bytes").ok());
  Result<MappedFile> opened = MappedFile::Open(folder / "a");
  ASSERT_TRUE(opened.ok());
  const MappedFile file = *std::move(opened);
  EXPECT_EQ(std::string_view(reinterpret_cast<const char*>(file.bytes().data()), 5), "bytes");
  ASSERT_TRUE(WriteFileAtomically(folder / "b", "").ok());
  EXPECT_NE(MappedFile::Open(folder / "b").message().find("empty"), std::string::npos);
}

}  // namespace
}  // namespace lararium
