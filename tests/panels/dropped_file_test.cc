#include "editor/panels/dialogs/dropped_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "tests/support/test_files.h"

namespace lararium::panels {
namespace {

using Kind = DroppedFile::Kind;
namespace fs = std::filesystem;

class DroppedFileTest : public ::testing::Test {
 protected:
  fs::path Make(const std::string& name) {
    const fs::path file = folder_ / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "{}";
    return file;
  }
  static DroppedFile Drop(const std::vector<fs::path>& paths) { return ClassifyDrop(paths); }

  test::TemporaryFolder folder_;
};

TEST_F(DroppedFileTest, IsKnownByWhatItIs) {
  EXPECT_EQ(Drop({Make("a.MP4")}).kind, Kind::kVideo);
  EXPECT_EQ(Drop({Make("a.glb")}).kind, Kind::kModel);
  EXPECT_EQ(Drop({Make("a.vrm")}).kind, Kind::kFigure);
  EXPECT_EQ(Drop({Make("a.hdr")}).kind, Kind::kProbe);
  EXPECT_EQ(Drop({Make("a.exr")}).kind, Kind::kProbe);
  EXPECT_EQ(Drop({Make("a.txt")}).kind, Kind::kOther);
  EXPECT_EQ(Drop({folder_ / "nothing.mp4"}).kind, Kind::kOther);
  EXPECT_EQ(Drop({}).kind, Kind::kOther);
}

TEST_F(DroppedFileTest, AProjectIsItsFolderOrItsFile) {
  const fs::path file = Make("house.lararium/project.json");
  Make("house.lararium/picture.jpg");
  for (const fs::path& dropped : {file, file.parent_path()}) {
    EXPECT_EQ(Drop({dropped}).kind, Kind::kProject);
    EXPECT_EQ(Drop({dropped}).file, file.parent_path());
  }
}

TEST_F(DroppedFileTest, ImagesAreTheirFolder) {
  const fs::path a = Make("frames/1.png");
  const fs::path b = Make("frames/2.JPG");
  for (const std::vector<fs::path>& dropped :
       {std::vector<fs::path>{a.parent_path()}, {a}, {a, b}}) {
    EXPECT_EQ(Drop(dropped).kind, Kind::kImages);
    EXPECT_EQ(Drop(dropped).file, a.parent_path());
  }
  fs::create_directories(folder_ / "empty");
  EXPECT_EQ(Drop({folder_ / "empty"}).kind, Kind::kOther);
}

TEST_F(DroppedFileTest, SeveralThingsAreNone) {
  EXPECT_EQ(Drop({Make("a.mp4"), Make("b.mp4")}).kind, Kind::kOther);
  EXPECT_EQ(Drop({Make("a/1.png"), Make("b/1.png")}).kind, Kind::kOther);
  EXPECT_EQ(Drop({Make("a/1.png"), Make("a/b.mp4")}).kind, Kind::kOther);
}

TEST_F(DroppedFileTest, ANameThatAProjectCannotStoreIsNone) {
  EXPECT_EQ(Drop({Make("\xF6.mp4")}).kind, Kind::kOther);
  EXPECT_EQ(Drop({Make("\xF6/1.png")}).kind, Kind::kOther);
  EXPECT_EQ(Drop({"https://example.org/a.mp4"}).kind, Kind::kOther);
}

}  // namespace
}  // namespace lararium::panels
