#include "editor/panels/widgets/file_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "editor/panels/widgets/file_kinds.h"
#include "tests/support/test_files.h"

namespace lararium::panels {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

std::vector<std::string> NamesOf(const std::vector<FileEntry>& entries) {
  std::vector<std::string> names;
  for (const FileEntry& entry : entries) {
    names.push_back(entry.name);
  }
  return names;
}

FileEntry File(const std::string& name, uint64_t bytes = 0, int64_t changed = 0) {
  return {name, false, false, bytes, changed};
}

FileEntry Folder(const std::string& name) { return {name, true, false, 0, 0}; }

TEST(FileList, HasFoldersAndTheFilesOfItsKind) {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.mp4", "B.MP4", "c.txt", ".hidden.mp4", "d.mp4.part"}) {
    std::ofstream(folder / name) << "12345";
  }
  std::ofstream(folder.path() / "\xF6.mp4") << "not UTF-8";
  std::filesystem::create_directories(folder / "house.lararium");
  std::ofstream(folder.path() / "house.lararium" / "project.json") << "{}";
  std::filesystem::create_directories(folder / "takes");
  std::string problem;
  const auto entries = ListFolder(folder.path(), SpecOf(FileType::kVideo).extensions, problem);
  EXPECT_THAT(NamesOf(entries), UnorderedElementsAre("a.mp4", "B.MP4", "house.lararium", "takes"));
  EXPECT_EQ(problem, "");
  for (const FileEntry& entry : entries) {
    EXPECT_EQ(entry.folder, !HasExtension(entry.name, SpecOf(FileType::kVideo).extensions));
    EXPECT_EQ(entry.project, entry.name == "house.lararium");
    EXPECT_EQ(entry.bytes, entry.folder ? 0u : 5u);
    EXPECT_GT(entry.changed, 1'600'000'000);
  }
  EXPECT_EQ(ListFolder(folder.path(), {}, problem).size(), 6u);
}

TEST(FileList, SaysWhyAFolderCannotBeRead) {
  const test::TemporaryFolder folder;
  std::string problem;
  EXPECT_THAT(ListFolder(folder / "nothing", {}, problem), IsEmpty());
  EXPECT_THAT(problem, Not(IsEmpty()));
}

TEST(FileList, IsSortedByEachColumnWithFoldersFirst) {
  std::vector<FileEntry> entries = {File("take10", 3, 20), File("Take2", 9, 30), File("a", 9, 10),
                                    Folder("z")};
  SortEntries(FileColumn::kName, false, entries);
  EXPECT_THAT(NamesOf(entries), ElementsAre("z", "a", "Take2", "take10"));
  SortEntries(FileColumn::kName, true, entries);
  EXPECT_THAT(NamesOf(entries), ElementsAre("z", "take10", "Take2", "a"));
  SortEntries(FileColumn::kSize, false, entries);
  EXPECT_THAT(NamesOf(entries), ElementsAre("z", "take10", "a", "Take2"));
  SortEntries(FileColumn::kSize, true, entries);
  EXPECT_THAT(NamesOf(entries), ElementsAre("z", "a", "Take2", "take10"));
  SortEntries(FileColumn::kChanged, true, entries);
  EXPECT_THAT(NamesOf(entries), ElementsAre("z", "Take2", "take10", "a"));
}

TEST(FileList, SizesAreReadable) {
  EXPECT_EQ(SizeText(0), "0 B");
  EXPECT_EQ(SizeText(999), "999 B");
  EXPECT_EQ(SizeText(1'400), "1.4 kB");
  EXPECT_EQ(SizeText(999'600), "1.0 MB");
  EXPECT_EQ(SizeText(48'200'000), "48 MB");
  EXPECT_EQ(SizeText(7'000'000'000'000'000), "7000 TB");
}

TEST(TypeAhead, FindsWhatBeginsWithTheTypedLetters) {
  const std::vector<FileEntry> entries = {File("atrium"), File("Bar"), File("basilica"),
                                          File("Größe")};
  TypeAhead ahead;
  EXPECT_EQ(ahead.Type("b", 0.0, entries, std::nullopt), 1u);
  EXPECT_EQ(ahead.Type("A", 0.2, entries, 1), 1u);
  EXPECT_EQ(ahead.Type("s", 0.4, entries, 1), 2u);
  EXPECT_EQ(ahead.Type("x", 0.6, entries, 2), std::nullopt);
  // After a pause another name begins.
  EXPECT_EQ(ahead.Type("g", 5.0, entries, 2), 3u);
  EXPECT_EQ(ahead.Type("r", 5.1, entries, 3), 3u);
  EXPECT_EQ(ahead.Type("ö", 5.2, entries, 3), 3u);
}

TEST(TypeAhead, TheSameLetterAgainGoesOnToTheNext) {
  const std::vector<FileEntry> entries = {File("bar"), File("basilica"), File("cella")};
  TypeAhead ahead;
  EXPECT_EQ(ahead.Type("b", 0.0, entries, std::nullopt), 0u);
  EXPECT_EQ(ahead.Type("b", 0.2, entries, 0), 1u);
  EXPECT_EQ(ahead.Type("b", 0.4, entries, 1), 0u);
  EXPECT_EQ(ahead.Type("c", 5.0, {}, std::nullopt), std::nullopt);
}

}  // namespace
}  // namespace lararium::panels
