#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "shared/render/graphics_context.h"
#include "shared/render/window.h"

namespace lararium::render {
namespace {

TEST(GraphicsContext, NamesItsDevice) {
  const auto context = CreateOffscreenContext();
  ASSERT_TRUE(context.ok()) << context.message();
  EXPECT_NE(GraphicsDeviceName(), "unknown");
  EXPECT_FALSE(GraphicsDeviceName().empty());
}

TEST(GraphicsContext, TellsSoftwareFromCards) {
  EXPECT_TRUE(DrawsOnProcessor("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(DrawsOnProcessor("softpipe"));
  EXPECT_FALSE(DrawsOnProcessor("Mesa Intel(R) UHD Graphics 620 (KBL GT2)"));
  EXPECT_FALSE(DrawsOnProcessor("unknown"));
}

TEST(GraphicsContext, MovesAndComesBackAfterAnother) {
  auto first = CreateOffscreenContext();
  ASSERT_TRUE(first.ok()) << first.message();
  OffscreenContext moved = std::move(first).value();
  {
    const auto second = CreateOffscreenContext();
    ASSERT_TRUE(second.ok()) << second.message();
  }
  EXPECT_TRUE(moved.MakeCurrent().ok());
  EXPECT_NE(GraphicsDeviceName(), "unknown");
}

TEST(Window, SaysWhatToDoWithoutADisplay) {
  if (std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr) {
    GTEST_SKIP() << "there is a display";
  }
  const auto window = Window::Create({});
  ASSERT_FALSE(window.ok());
  EXPECT_THAT(window.message(), ::testing::HasSubstr("run without a window"));
}

}  // namespace
}  // namespace lararium::render
