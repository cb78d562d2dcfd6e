#include <epoxy/gl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/resource.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <thread>
#include <vector>

#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/window.h"

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

TEST(GraphicsContext, IsWhatWasAskedFor) {
  for (const GraphicsApi api : {GraphicsApi::kOpenGl33, GraphicsApi::kOpenGlEs30}) {
    const auto context = CreateOffscreenContext(api);
    ASSERT_TRUE(context.ok()) << context.message();
    EXPECT_EQ(CurrentGraphicsApi(), api);
  }
  const auto context = CreateOffscreenContext(std::nullopt);
  ASSERT_TRUE(context.ok()) << context.message();
  EXPECT_EQ(CurrentGraphicsApi(), GraphicsApi::kOpenGl33);
}

// Tries to create a context with a driver that lacks features. It runs in a process of its own,
// because Mesa reads the variables only once. Exits with 0 and prints the API's name, or with 1 and
// prints the error.
void TryWithout(const char* variable, const char* value, GraphicsChoice choice) {
  ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/usr/share/glvnd/egl_vendor.d/50_mesa.json", 1);
  ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  ::setenv(variable, value, 1);
  const auto context = CreateOffscreenContext(choice);
  std::cerr << (context.ok() ? Name(CurrentGraphicsApi()) : context.message());
  std::exit(context.ok() ? 0 : 1);  // NOLINT(concurrency-mt-unsafe): the only thread
}

TEST(PoorDriver, WithoutOpenGl33DrawsInEsUnlessThatIsRefused) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  constexpr const char* kVariable = "MESA_GL_VERSION_OVERRIDE";
  EXPECT_EXIT(TryWithout(kVariable, "3.1", std::nullopt), ::testing::ExitedWithCode(0),
              "OpenGL ES 3.0");
  EXPECT_EXIT(TryWithout(kVariable, "3.1", GraphicsApi::kOpenGl33), ::testing::ExitedWithCode(1),
              "the driver has no OpenGL 3.3");
}

TEST(PoorDriver, InEsNeedsFloatsToDrawInto) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  constexpr const char* kVariable = "MESA_EXTENSION_OVERRIDE";
  constexpr const char* kBoth = "-GL_EXT_color_buffer_float -GL_EXT_color_buffer_half_float";
  EXPECT_EXIT(TryWithout(kVariable, kBoth, GraphicsApi::kOpenGlEs30), ::testing::ExitedWithCode(1),
              "neither GL_EXT_color_buffer_float nor");
}

// Copies one texture into another and writes into that, many times.
void DrawInTurns() {
  constexpr int kPictures = 2000;
  constexpr int kSide = 256;
  const auto context = CreateOffscreenContext();
  const std::vector<uint8_t> pixels(size_t{kSide} * kSide * 4);
  for (int picture = 0; context.ok() && picture < kPictures; ++picture) {
    const DrawingTurn turn(*context);
    std::array<GLuint, 2> textures = {};
    std::array<GLuint, 2> framebuffers = {};
    glGenTextures(2, textures.data());
    glGenFramebuffers(2, framebuffers.data());
    for (const size_t i : {0, 1}) {
      glBindTexture(GL_TEXTURE_2D, textures[i]);
      glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, kSide, kSide, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                   pixels.data());
      glBindFramebuffer(GL_FRAMEBUFFER, framebuffers[i]);
      glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, textures[i], 0);
      glClear(GL_COLOR_BUFFER_BIT);
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffers[0]);
    glBlitFramebuffer(0, 0, 200, 200, 10, 10, 250, 240, GL_COLOR_BUFFER_BIT, GL_LINEAR);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, 8, 8, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
    glDeleteFramebuffers(2, framebuffers.data());
    glDeleteTextures(2, textures.data());
  }
}

// Freed memory is filled, so that a driver which reads it crashes.
[[noreturn]] void DrawInTwoThreads() {
  ::mallopt(M_PERTURB, 165);
  {
    const std::jthread other(DrawInTurns);
    DrawInTurns();
  }
  std::exit(0);  // NOLINT(concurrency-mt-unsafe): the only thread
}

TEST(DrawingTurn, LetsTwoThreadsDrawWithAnyDriver) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(DrawInTwoThreads(), ::testing::ExitedWithCode(0), "");
}

#ifndef LARARIUM_SANITIZED  // Sanitizers need more addresses than the limit leaves.
// Exits with 1 and prints the error if a context that gets little memory is refused.
void TryWithLittleMemory() {
  constexpr rlim_t kTooLittle = 500'000'000;
  const rlimit addresses = {kTooLittle, kTooLittle};
  const bool limited = ::setrlimit(RLIMIT_AS, &addresses) == 0;
  const auto context = CreateOffscreenContext(std::nullopt);
  std::cerr << context.status().message();
  std::exit(limited && !context.ok() ? 1 : 0);  // NOLINT(concurrency-mt-unsafe): the only thread
}

TEST(PoorDriver, IsNotStartedWithoutMemory) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(TryWithLittleMemory(), ::testing::ExitedWithCode(1),
              "^graphics: this program may not use 400 MB more memory[^\n]*$");
}
#endif

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
