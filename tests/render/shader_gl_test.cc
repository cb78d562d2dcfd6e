#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "shared/render/graphics_context.h"
#include "shared/render/shader_program.h"
#include "shared/render/shader_source.h"

namespace lararium::render {
namespace {

// Every fragment shader with the vertex shader of its pass: x.vert is that of x.frag and of
// x_part.frag.
std::map<std::string, std::string> Passes() {
  std::map<std::string, std::string> vertex_of;
  for (const EmbeddedText& fragment : ShaderSources()) {
    const std::string name(fragment.name);
    if (!name.ends_with(".frag")) {
      continue;
    }
    vertex_of[name] = "full_screen.vert";
    for (const EmbeddedText& vertex : ShaderSources()) {
      const std::string other(vertex.name);
      const std::string stem = other.substr(0, other.find('.'));
      if (other.ends_with(".vert") && (name == stem + ".frag" || name.starts_with(stem + "_"))) {
        vertex_of[name] = other;
      }
    }
  }
  return vertex_of;
}

class EveryShader : public ::testing::TestWithParam<GraphicsApi> {};

TEST_P(EveryShader, CompilesAndLinks) {
  const auto context = CreateOffscreenContext(GetParam());
  ASSERT_TRUE(context.ok()) << context.message();
  ASSERT_GE(Passes().size(), 3u);
  for (const auto& [fragment, vertex] : Passes()) {
    const auto program = ShaderProgram::Create(vertex, fragment);
    EXPECT_TRUE(program.ok()) << program.message();
  }
}

TEST_P(EveryShader, OfModelsCompilesForEverySurface) {
  const auto context = CreateOffscreenContext(GetParam());
  ASSERT_TRUE(context.ok()) << context.message();
  for (const char* surface : {"PLAIN", "SKIN", "HAIR", "CLOTH", "EYE", "METAL"}) {
    for (const char* skin : {"LINEAR", "DUAL_QUATERNION", "RIGID"}) {
      for (const char* more :
           {"", "#define COVERED\n", "#define REFLECTIONS\n",
            "#define COVERED\n#define REFLECTIONS\n", "#define LIT_AT_VERTICES\n",
            "#define COVERED\n#define LIT_AT_VERTICES\n"}) {
        const std::string defines =
            std::string("#define SURFACE_") + surface + "\n#define SKIN_" + skin + "\n" + more;
        const auto program = ShaderProgram::Create("model.vert", "model.frag", defines);
        EXPECT_TRUE(program.ok()) << defines << program.message();
      }
    }
  }
}

TEST_P(EveryShader, OfPicturesCompilesForEveryKindOfPicture) {
  const auto context = CreateOffscreenContext(GetParam());
  ASSERT_TRUE(context.ok()) << context.message();
  for (const char* kind : {"LOOK", "RECTIFIED", "SEE_THROUGH"}) {
    const std::string defines = std::string("#define ") + kind + "\n";
    const auto program = ShaderProgram::Create("full_screen.vert", "composite.frag", defines);
    EXPECT_TRUE(program.ok()) << defines << program.message();
  }
  const auto program =
      ShaderProgram::Create("full_screen.vert", "background.frag", "#define RECTIFIED\n");
  EXPECT_TRUE(program.ok()) << program.message();
}

int asked = 0;  // how often a driver was asked where a uniform is
GLint (*ask)(GLuint, const GLchar*) = nullptr;
GLint CountedLocation(GLuint program, const GLchar* name) {
  ++asked;
  return ask(program, name);
}

TEST_P(EveryShader, KnowsWhereItsUniformsAre) {
  const auto context = CreateOffscreenContext(GetParam());
  ASSERT_TRUE(context.ok()) << context.message();
  const auto program = ShaderProgram::Create("full_screen.vert", "sky_ratio.frag");
  ASSERT_TRUE(program.ok()) << program.message();
  GLint id = 0;
  program->Use();
  glGetIntegerv(GL_CURRENT_PROGRAM, &id);
  const auto name = static_cast<GLuint>(id);
  const GLint second = glGetUniformLocation(name, "cones_x[1]");
  ASSERT_GE(second, 0);
  ask = std::exchange(glGetUniformLocation, CountedLocation);
  const std::array<glm::vec4, 2> values = {glm::vec4(1.0f), glm::vec4(2.0f, 3.0f, 4.0f, 5.0f)};
  program->Set("cones_x", std::span(values));
  program->Set("no_such_name", 1.0f);
  glGetUniformLocation = ask;
  EXPECT_EQ(asked, 0);
  glm::vec4 kept(0.0f);
  glGetUniformfv(name, second, &kept.x);
  EXPECT_EQ(kept, values[1]);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

INSTANTIATE_TEST_SUITE_P(Apis,
                         EveryShader,
                         ::testing::Values(GraphicsApi::kOpenGl33, GraphicsApi::kOpenGlEs30),
                         [](const auto& info) {
                           return info.param == GraphicsApi::kOpenGl33 ? "OpenGl33" : "OpenGlEs30";
                         });

}  // namespace
}  // namespace lararium::render
