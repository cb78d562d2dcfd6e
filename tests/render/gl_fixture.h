#pragma once

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "shared/geometry/triangle_mesh.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"

namespace lararium::render {

// If the environment has LARARIUM_GRAPHICS=gles, tests draw with OpenGL ES 3.0
// (lararium_gles_test).
inline GraphicsApi TestedGraphics() {
  const char* name = std::getenv("LARARIUM_GRAPHICS");
  return name != nullptr && std::string_view(name) == "gles" ? GraphicsApi::kOpenGlEs30
                                                             : GraphicsApi::kOpenGl33;
}

// The parallelogram with a corner and the sides u and v from there.
inline geometry::TriangleMesh Quad(const glm::vec3& corner,
                                   const glm::vec3& u,
                                   const glm::vec3& v) {
  return {.positions = {corner, corner + u, corner + u + v, corner + v},
          .normals = {},
          .indices = {0, 1, 2, 0, 2, 3}};
}

// A test that draws off screen, and fails if the driver reports any OpenGL error.
class GlTest : public ::testing::Test {
 protected:
  void SetUp() override { Open(TestedGraphics()); }
  void TearDown() override {
    if (context_) {
      EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }
  }

  // Replaces the current context.
  void Open(GraphicsApi api) {
    context_.reset();
    ::setenv("MESA_GLES_VERSION_OVERRIDE", "3.0", 1);  // Mesa would accept ES 3.2
    auto context = CreateOffscreenContext(api);
    ASSERT_TRUE(context.ok()) << context.message();
    context_.emplace(std::move(context).value());
    ASSERT_EQ(CurrentGraphicsApi(), api);
    if (epoxy_has_gl_extension("GL_KHR_debug")) {
      const bool desktop = epoxy_is_desktop_gl();
      (desktop ? glDebugMessageCallback : glDebugMessageCallbackKHR)(&FailOnError, nullptr);
      glEnable(GL_DEBUG_OUTPUT);
    }
  }

  static RenderTarget MakeTarget(int width, int height) {
    auto target = RenderTarget::Create(width, height);
    EXPECT_TRUE(target.ok()) << target.message();
    return std::move(target).value();
  }

  static cv::Mat Read(const RenderTarget& target) {
    cv::Mat bgr;
    target.ReadPixels(bgr);
    return bgr;
  }

 private:
  static void APIENTRY FailOnError(GLenum /*source*/,
                                   GLenum type,
                                   GLuint /*id*/,
                                   GLenum /*severity*/,
                                   GLsizei length,
                                   const GLchar* message,
                                   const void* /*user*/) {
    if (type == GL_DEBUG_TYPE_ERROR) {
      ADD_FAILURE() << std::string_view(message, static_cast<size_t>(length));
    }
  }

  std::optional<OffscreenContext> context_;
};

}  // namespace lararium::render
