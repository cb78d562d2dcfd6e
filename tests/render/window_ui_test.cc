#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "shared/render/gl/render_target.h"
#include "shared/render/gl/window.h"

namespace lararium::render {
namespace {

#define REQUIRE_DISPLAY()                                                               \
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) { \
    GTEST_SKIP() << "needs a display (xvfb-run)";                                       \
  }                                                                                     \
  static_assert(true, "")

std::array<uint8_t, 3> WindowPixel(int x, int y) {
  std::array<uint8_t, 4> rgba = {};
  glReadPixels(x, y, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  return {rgba[0], rgba[1], rgba[2]};
}

class GraphicsUi : public ::testing::TestWithParam<GraphicsApi> {};

TEST_P(GraphicsUi, OpensAndShowsATargetBetweenBlackBars) {
  REQUIRE_DISPLAY();
  auto opened =
      Window::Create({.title = "test", .width = 400, .height = 200, .graphics = GetParam()});
  ASSERT_TRUE(opened.ok()) << opened.message();
  Window window = std::move(opened).value();
  EXPECT_EQ(CurrentGraphicsApi(), GetParam());
  window.PollEvents();
  const Window::Size size = window.framebuffer_size();
  ASSERT_EQ(size.width, 400);
  ASSERT_EQ(size.height, 200);
  EXPECT_GT(window.content_scale(), 0.0f);

  const auto target = RenderTarget::Create(100, 100);
  ASSERT_TRUE(target.ok()) << target.message();
  glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer());
  glClearColor(0.0f, 1.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 0, 100, 50);  // the upper half of the picture
  glClearColor(1.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
  target->Present(size.width, size.height);
  using Rgb = std::array<uint8_t, 3>;
  EXPECT_EQ(WindowPixel(50, 100), (Rgb{0, 0, 0}));
  EXPECT_EQ(WindowPixel(350, 100), (Rgb{0, 0, 0}));
  EXPECT_EQ(WindowPixel(200, 150), (Rgb{255, 0, 0}));
  EXPECT_EQ(WindowPixel(200, 50), (Rgb{0, 255, 0}));
  window.SwapBuffers();
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

INSTANTIATE_TEST_SUITE_P(Apis,
                         GraphicsUi,
                         ::testing::Values(GraphicsApi::kOpenGl33, GraphicsApi::kOpenGlEs30));

TEST(WindowUi, TakesOpenGl33WhereAllIsWelcome) {
  REQUIRE_DISPLAY();
  const auto window = Window::Create({.visible = false, .graphics = std::nullopt});
  ASSERT_TRUE(window.ok()) << window.message();
  EXPECT_EQ(CurrentGraphicsApi(), GraphicsApi::kOpenGl33);
}

TEST(WindowUi, ClosesOnRequestAndKeepsItsCallbacksWhenMoved) {
  REQUIRE_DISPLAY();
  auto opened = Window::Create({.width = 320, .height = 240, .visible = false});
  ASSERT_TRUE(opened.ok()) << opened.message();
  Window window = std::move(opened).value();
  window.SetCallbacks(
      {.key = {}, .character = {}, .mouse_button = {}, .cursor = {}, .scroll = {}, .resize = {}});
  window.SetTitle("another title");
  EXPECT_FALSE(window.ShouldClose());
  glfwSetWindowShouldClose(glfwGetCurrentContext(), GLFW_TRUE);
  window.WaitEvents(0.01);
  EXPECT_TRUE(window.ShouldClose());
}

TEST(WindowUi, NamesTheMonitorThatIsMissing) {
  REQUIRE_DISPLAY();
  const auto window = Window::Create({.monitor = 17});
  ASSERT_FALSE(window.ok());
  EXPECT_NE(window.message().find("monitor 17"), std::string::npos);
}

}  // namespace
}  // namespace lararium::render
