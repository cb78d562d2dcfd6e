#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/shader_program.h"
#include "shared/render/gl/shader_source.h"

namespace lararium::render {
namespace {

// Every fragment shader with the vertex shader of its pass. x.vert belongs to x.frag and to
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

// Uniform vectors (outside of blocks) and samplers that the program in use needs; drivers limit
// both. Arrays are counted without packing.
struct Uniforms {
  int vectors = 0;
  int samplers = 0;
};
Uniforms CountUniforms() {
  GLint program = 0;
  GLint count = 0;
  glGetIntegerv(GL_CURRENT_PROGRAM, &program);
  glGetProgramiv(static_cast<GLuint>(program), GL_ACTIVE_UNIFORMS, &count);
  Uniforms uniforms;
  for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
    GLint block = -1;
    glGetActiveUniformsiv(static_cast<GLuint>(program), 1, &i, GL_UNIFORM_BLOCK_INDEX, &block);
    GLint size = 0;
    GLenum type = 0;
    std::array<char, 64> name = {};
    glGetActiveUniform(static_cast<GLuint>(program), i, name.size(), nullptr, &size, &type,
                       name.data());
    const bool sampler =
        type == GL_SAMPLER_2D || type == GL_SAMPLER_3D || type == GL_SAMPLER_2D_SHADOW;
    const int each = type == GL_FLOAT_MAT4 ? 4 : type == GL_FLOAT_MAT3 ? 3 : 1;
    uniforms.samplers += sampler ? size : 0;
    uniforms.vectors += sampler || block >= 0 ? 0 : size * each;
  }
  return uniforms;
}

// Programs must fit into the guaranteed minimum of MAX_FRAGMENT_UNIFORM_VECTORS (smaller than that
// of vertex shaders) and of MAX_TEXTURE_IMAGE_UNITS (OpenGL ES 3.0.6, tables 6.31 and 6.32).
TEST(Shaders, TakeNoMoreThanEveryOpenGlEs30Has) {
  const auto context = CreateOffscreenContext(GraphicsApi::kOpenGlEs30);
  ASSERT_TRUE(context.ok()) << context.message();
  const auto check = [](const std::string& vertex, const std::string& fragment,
                        const std::string& defines) {
    const auto program = ShaderProgram::Create(vertex, fragment, defines);
    ASSERT_TRUE(program.ok()) << program.message();
    program->Use();
    const Uniforms uniforms = CountUniforms();
    EXPECT_LE(uniforms.vectors, 224) << fragment << " " << defines;
    EXPECT_LE(uniforms.samplers, 16) << fragment << " " << defines;
  };
  for (const auto& [fragment, vertex] : Passes()) {
    check(vertex, fragment, "");
  }
  for (const char* more : {"#define COVERED\n#define REFLECTIONS\n", "#define LIT_AT_VERTICES\n"}) {
    check("model.vert", "model.frag",
          std::string("#define SURFACE_SKIN\n#define SKIN_DUAL_QUATERNION\n") + more);
  }
}

int asked = 0;  // number of calls of glGetUniformLocation
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
