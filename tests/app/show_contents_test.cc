#include "editor/app/show_contents.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "editor/app/lines.h"
#include "shared/bundle/bundle_writer.h"
#include "tests/support/test_files.h"

namespace lararium::app {
namespace {

void WriteBytes(const std::filesystem::path& file, size_t bytes) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << std::string(bytes, 'x');
}

TEST(ForecastShow, CountsWhatIsBakedAndWhatIsNot) {
  const test::TemporaryFolder folder;
  const ProjectPaths paths{folder / "show.lararium"};
  ASSERT_TRUE(CreateProject(paths, "A show").ok());
  ProjectDocument document;
  document.places.resize(2);
  document.places[0].name = "yard";
  document.places[1].name = "hall";
  document.objects.resize(1);
  document.objects[0].name = "cup";
  WriteBytes(paths.Scene("yard"), 5000);
  WriteBytes(paths.Prop("cup"), 700);
  const ShowContents contents = ForecastShow(paths, document, {});
  EXPECT_EQ(contents.row(ContentKind::kPlaces).count, 2);
  EXPECT_EQ(contents.row(ContentKind::kPlaces).unbaked, 1);
  EXPECT_EQ(contents.row(ContentKind::kPlaces).bytes, 5000u);
  EXPECT_EQ(contents.row(ContentKind::kObjects).bytes, 700u);
  EXPECT_EQ(contents.row(ContentKind::kPeople).count, 0);
  EXPECT_GE(contents.bytes(), 5700u);
}

TEST(ForecastShow, AMapWeighsNoMoreThanItsPointsMay) {
  const test::TemporaryFolder folder;
  const ProjectPaths paths{folder / "show.lararium"};
  ASSERT_TRUE(CreateProject(paths, "A show").ok());
  ProjectDocument document;
  document.places.resize(1);
  document.places[0].name = "yard";
  WriteBytes(paths.Scene("yard"), 3'000'000);
  const auto bytes = [&](int points) {
    return ForecastShow(paths, document, {.max_points = points}).row(ContentKind::kPlaces).bytes;
  };
  EXPECT_EQ(bytes(100'000), 3'000'000u);
  EXPECT_LT(bytes(500), 1'000'000u);
}

TEST(ReadShowContents, EveryMemberCountsOnceWhereItBelongs) {
  const test::TemporaryFolder folder;
  bundle::ShowManifest manifest;
  manifest.title = "A show";
  manifest.drama = "drama.lua";
  manifest.places.resize(1);
  manifest.places[0].name = "yard";
  manifest.places[0].scene = "yard.larscene";
  manifest.objects = {{"cup", "cup.larprop", {}}, {"other", "cup.larprop", {}}};
  const std::vector<std::byte> small(100);
  const std::vector<std::byte> large(2000);
  const Status written = bundle::WriteBundle(folder / "a.larshow", manifest,
                                             {{"drama.lua", std::span<const std::byte>(small)},
                                              {"yard.larscene", std::span<const std::byte>(large)},
                                              {"cup.larprop", std::span<const std::byte>(small)}});
  ASSERT_TRUE(written.ok()) << written.message();
  const Result<ShowContents> contents = ReadShowContents(folder / "a.larshow");
  ASSERT_TRUE(contents.ok()) << contents.message();
  EXPECT_EQ(contents->row(ContentKind::kPlaces).bytes, 2000u);
  EXPECT_EQ(contents->row(ContentKind::kObjects).bytes, 100u);
  EXPECT_EQ(contents->row(ContentKind::kObjects).count, 2);
  EXPECT_EQ(contents->row(ContentKind::kTexts).bytes, 100u);
  EXPECT_EQ(contents->bytes(), 2200u);
  EXPECT_FALSE(contents->is_signed);
}

}  // namespace
}  // namespace lararium::app
