#include "editor/jobs/bundle_summary.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "editor/jobs/lines.h"
#include "shared/bundle/bundle_writer.h"
#include "shared/core/check.h"
#include "tests/support/test_files.h"

namespace lararium::editor {
namespace {

void WriteBytes(const std::filesystem::path& file, size_t bytes) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << std::string(bytes, 'x');
}

class ForecastShowTest : public testing::Test {
 protected:
  ForecastShowTest() { CHECK(CreateProject(paths_, "A show").ok()); }

  test::TemporaryFolder folder_;
  ProjectPaths paths_{folder_ / "show.lararium"};
  ProjectDocument document_;
};

TEST_F(ForecastShowTest, CountsWhatIsBakedAndWhatIsNot) {
  document_.places.resize(2);
  document_.places[0].name = "yard";
  document_.places[1].name = "hall";
  document_.objects.resize(1);
  document_.objects[0].name = "cup";
  WriteBytes(paths_.Scene("yard"), 5000);
  WriteBytes(paths_.Prop("cup"), 700);
  const BundleSummary contents = ForecastShow(paths_, document_, {});
  EXPECT_EQ(contents.row(ContentKind::kPlaces).count, 2);
  EXPECT_EQ(contents.row(ContentKind::kPlaces).unbaked, 1);
  EXPECT_EQ(contents.row(ContentKind::kPlaces).bytes, 5000u);
  EXPECT_EQ(contents.row(ContentKind::kObjects).bytes, 700u);
  EXPECT_EQ(contents.row(ContentKind::kPeople).count, 0);
  EXPECT_GE(contents.bytes(), 5700u);
}

TEST_F(ForecastShowTest, AMapWeighsNoMoreThanItsPointsMay) {
  document_.places.resize(1);
  document_.places[0].name = "yard";
  WriteBytes(paths_.Scene("yard"), 3'000'000);
  const auto bytes = [&](int points) {
    return ForecastShow(paths_, document_, {.max_points = points}).row(ContentKind::kPlaces).bytes;
  };
  EXPECT_EQ(bytes(100'000), 3'000'000u);
  EXPECT_LT(bytes(500), 1'000'000u);
}

TEST(ReadBundleSummary, EveryMemberCountsOnceWhereItBelongs) {
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
  const Result<BundleSummary> contents = ReadBundleSummary(folder / "a.larshow");
  ASSERT_TRUE(contents.ok()) << contents.message();
  EXPECT_EQ(contents->row(ContentKind::kPlaces).bytes, 2000u);
  EXPECT_EQ(contents->row(ContentKind::kObjects).bytes, 100u);
  EXPECT_EQ(contents->row(ContentKind::kObjects).count, 2);
  EXPECT_EQ(contents->row(ContentKind::kTexts).bytes, 100u);
  EXPECT_EQ(contents->bytes(), 2200u);
  EXPECT_FALSE(contents->is_signed);
}

}  // namespace
}  // namespace lararium::editor
