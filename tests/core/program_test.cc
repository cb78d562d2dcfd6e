#include "shared/core/program.h"

#include <gtest/gtest.h>

#include "tests/support/test_files.h"

namespace lararium {
namespace {

TEST(ShippedData, IsTheInstalledOneElseThatOfTheCheckout) {
  const test::TemporaryFolder checkout;
  const std::filesystem::path prefix = checkout / "build/release";
  const auto find = [&] { return ShippedData("lararium/sample", "scenes", prefix / "bin"); };
  EXPECT_EQ(find(), checkout / "scenes");
  std::filesystem::create_directories(prefix / "share/lararium/sample");
  EXPECT_EQ(find(), prefix / "share/lararium/sample");
}

}  // namespace
}  // namespace lararium
