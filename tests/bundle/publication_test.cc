#include "shared/bundle/publication.h"

#include <gmock/gmock.h>

#include "shared/bundle/bundle_parts.h"
#include "shared/bundle/bundle_writer.h"
#include "shared/bundle/publishing.h"
#include "shared/core/file.h"
#include "tests/bundle/example_show.h"
#include "tests/support/test_files.h"

namespace lararium::bundle {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

class PublicationTest : public ::testing::Test {
 protected:
  static std::span<const std::byte> Bytes(std::string_view text) {
    return std::as_bytes(std::span(text));
  }

  fs::path Write(const std::string& name, const std::string& drama) const {
    const fs::path file = around_ / name;
    const Status written = WriteBundle(file, test::ExampleManifest(),
                                       {{"drama.lua", Bytes(drama)},
                                        {"places/0/scene.larscene", Bytes(scene_)},
                                        {"places/0/occluder0.larmesh", Bytes(std::string_view())},
                                        {"cast/0.larhuman", Bytes("x")}},
                                       &key_);
    EXPECT_TRUE(written.ok()) << written.message();
    return file;
  }
  Publication PublishDrama(const std::string& drama, uint64_t time) const {
    return Publish(Write("unpublished.larshow", drama), folder_, key_, time).value();
  }
  std::vector<std::string> Files() const {
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      files.push_back(entry.path().filename().string());
    }
    return files;
  }
  Result<Publication> Newest() const {
    return ParsePublication(*ReadText(folder_ / "newest.json"), key_.public_key(), "newest.json");
  }

  test::TemporaryFolder around_;
  fs::path folder_ = around_ / "served";
  std::string scene_ = std::string(5000, 's');
  SecretKey key_ = MakeSecretKey();
};

TEST_F(PublicationTest, IsReadAsItWasWritten) {
  const Publication publication{7, {1, 2, 3}, 500, 70'000};
  EXPECT_EQ(*ParsePublication(FormatPublication(publication, key_), key_.public_key(), "x"),
            publication);
}

TEST_F(PublicationTest, IsRefusedIfItIsAlteredOrOfAnotherKey) {
  const std::string text = FormatPublication({7, {1, 2, 3}, 500, 70'000}, key_);
  const auto other = ParsePublication(text, MakeSecretKey().public_key(), "newest.json");
  EXPECT_THAT(other.message(), HasSubstr("newest.json: is not signed with the trusted key"));
  for (size_t i = 0; i < text.size(); ++i) {
    std::string altered = text;
    altered[i] ^= 1;
    const auto read = ParsePublication(altered, key_.public_key(), "newest.json");
    // Hexadecimal digits may be written in two ways.
    EXPECT_TRUE(!read.ok() || read->serial == 7) << altered;
  }
}

TEST_F(PublicationTest, ASignatureOfAManifestIsNoSignatureOfAPublication) {
  const Signature signed_bytes = Sign(Bytes("{}"), key_);
  const auto signature = std::as_bytes(std::span(signed_bytes));
  EXPECT_TRUE(Verifies(Bytes("{}"), signature, key_.public_key()));
  EXPECT_FALSE(Verifies(Bytes("{}"), signature, key_.public_key(), Signed::kPublication));
}

TEST_F(PublicationTest, EachShowHasAHigherSerialAndTheOneBeforeStays) {
  const Publication first = PublishDrama("-- 1", 1000);
  const Publication second = PublishDrama("-- 2", 900);  // The clock was set back.
  const Publication third = PublishDrama("-- 3", 2000);
  EXPECT_EQ(first.serial, 1000u);
  EXPECT_EQ(second.serial, 1001u);
  EXPECT_EQ(third.serial, 2000u);
  EXPECT_EQ(*Newest(), third);
  EXPECT_THAT(Files(), UnorderedElementsAre("newest.json", second.file(), third.file()));
}

TEST_F(PublicationTest, TheSameShowAgainIsNoNewOne) {
  const Publication first = PublishDrama("-- 1", 1000);
  EXPECT_EQ(PublishDrama("-- 1", 2000), first);
  EXPECT_THAT(Files(), UnorderedElementsAre("newest.json", first.file()));
}

TEST_F(PublicationTest, AFolderOfAnotherKeyStaysAsItIs) {
  PublishDrama("-- 1", 1000);
  const fs::path bundle = Write("unpublished.larshow", "-- 2");
  const auto published = Publish(bundle, folder_, MakeSecretKey(), 2000);
  EXPECT_THAT(published.message(), HasSubstr("published with another key"));
  EXPECT_EQ(Newest()->serial, 1000u);
}

TEST_F(PublicationTest, ABundleIsPutTogetherFromAFormerOneAndWhatIsNew) {
  const Bundle former =
      Bundle::Open(Write("former.larshow", "-- a drama of another length")).value();
  const Publication publication = PublishDrama("-- 1", 1000);
  const std::vector<std::byte> whole = *ReadBytes(folder_ / publication.file());
  const uint64_t head = HeadSize(publication.manifest_size);
  const ShowManifest manifest = ReadHead(std::span(whole).first(head), publication, "show").value();
  std::vector<std::byte> made(whole.begin(), whole.begin() + static_cast<ptrdiff_t>(head));
  uint64_t fetched = 0;
  const std::vector<BundlePart> parts = PartsOf(publication, manifest, &former).value();
  for (const BundlePart& part : parts) {
    ASSERT_EQ(part.begin, made.size());
    if (part.header.empty()) {
      made.insert(made.end(), &whole[part.begin], &whole[part.begin] + (part.end - part.begin));
      fetched += part.end - part.begin;
    } else {
      made.insert(made.end(), part.header.begin(), part.header.end());
      made.insert(made.end(), part.content.begin(), part.content.end());
    }
    ASSERT_EQ(part.end, made.size());
  }
  EXPECT_EQ(made, whole);
  EXPECT_LT(fetched, 1000u);  // The drama and the archive's directory, not the map.
}

TEST_F(PublicationTest, WithoutAFormerBundleTheRestIsOnePart) {
  const Publication publication = PublishDrama("-- 1", 1000);
  const std::vector<std::byte> whole = *ReadBytes(folder_ / publication.file());
  const uint64_t head = HeadSize(publication.manifest_size);
  const ShowManifest manifest = ReadHead(std::span(whole).first(head), publication, "show").value();
  const auto parts = PartsOf(publication, manifest, nullptr).value();
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].begin, head);
  EXPECT_EQ(parts[0].end, whole.size());
}

TEST_F(PublicationTest, AHeadOfAnotherShowAndASizeThatIsTooSmallAreErrors) {
  Publication publication = PublishDrama("-- 1", 1000);
  std::vector<std::byte> head = *ReadBytes(folder_ / publication.file());
  head.resize(HeadSize(publication.manifest_size));
  const ShowManifest manifest = ReadHead(head, publication, "show").value();
  publication.size = 100;
  EXPECT_THAT(PartsOf(publication, manifest, nullptr).message(), HasSubstr("too small"));
  publication.manifest[0] ^= 1;
  EXPECT_THAT(ReadHead(head, publication, "show").message(),
              HasSubstr("show: does not begin with the manifest that was published"));
}

}  // namespace
}  // namespace lararium::bundle
