#include "editor/desktop/file_uri.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <string>

namespace lararium::editor {
namespace {

using ::testing::HasSubstr;

std::string PathOf(const std::string& uri) {
  const auto path = PathOfUri(uri);
  return path.ok() ? path->string() : path.message();
}

TEST(FileUri, IsDecodedToAPath) {
  EXPECT_EQ(PathOf("file:///home/a/b.mp4"), "/home/a/b.mp4");
  EXPECT_EQ(PathOf("file:/home/a/b.mp4"), "/home/a/b.mp4");
  EXPECT_EQ(PathOf("FILE://localhost/a%20b"), "/a b");
  EXPECT_EQ(PathOf("file:///Gr%C3%B6%c3%9fe/%25"), "/Größe/%");
  EXPECT_EQ(PathOf("file:///Größe"), "/Größe");
  std::array<char, 256> host = {};
  ASSERT_EQ(gethostname(host.data(), host.size() - 1), 0);
  EXPECT_EQ(PathOf("file://" + std::string(host.data()) + "/a"), "/a");
}

TEST(FileUri, OfAnotherSchemeOrHostIsRefused) {
  EXPECT_THAT(PathOf("https://example.org/a.mp4"), HasSubstr("is not a file of this computer"));
  EXPECT_THAT(PathOf("smb://museum/a.mp4"), HasSubstr("is not a file of this computer"));
  EXPECT_THAT(PathOf(""), HasSubstr("is not a file of this computer"));
  EXPECT_THAT(PathOf("file://museum/a.mp4"), HasSubstr("is a file of another computer"));
}

TEST(FileUri, ThatIsNotWellFormedIsRefused) {
  for (const char* uri : {"file:", "file:a", "file://", "file:///a%", "file:///a%4", "file:///a%4g",
                          "file:///a%-1", "file:///a%00b"}) {
    EXPECT_THAT(PathOf(uri), HasSubstr("is not a well-formed address")) << uri;
  }
  EXPECT_THAT(PathOf("file:///%F6"), HasSubstr("not UTF-8"));
  EXPECT_LT(PathOf("http:" + std::string(100'000, '\n')).size(), 500u);
}

}  // namespace
}  // namespace lararium::editor
