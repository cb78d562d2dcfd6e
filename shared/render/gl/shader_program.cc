#include "shared/render/gl/shader_program.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <string>
#include <utility>

#include "shared/render/gl/shader_source.h"

namespace lararium::render {
namespace {

// Deletes a shader when its program is linked.
class Shader {
 public:
  explicit Shader(GLenum type) : id_(glCreateShader(type)) {}
  ~Shader() { glDeleteShader(id_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;

  GLuint id() const { return id_; }

  Status Compile(std::string_view name, std::string_view defines) {
    const std::string header = std::string(Header()).append(defines);
    LARARIUM_ASSIGN_OR_RETURN(const AssembledShader source, AssembleShader(name, header));
    const char* text = source.text.c_str();
    glShaderSource(id_, 1, &text, nullptr);
    glCompileShader(id_);
    GLint compiled = GL_FALSE;
    glGetShaderiv(id_, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_TRUE) {
      return Status();
    }
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(id_, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<size_t>(length));
    return Status::Error("shader " + std::string(name),
                         "does not compile:\n" + source.ExplainLog(log));
  }

 private:
  static std::string_view Header() {
    return epoxy_is_desktop_gl() ? "#version 330 core\n"
                                 : "#version 300 es\n"
                                   "precision highp float;\n"
                                   "precision highp int;\n"
                                   "precision highp sampler2D;\n";
  }

  GLuint id_;
};

}  // namespace

Result<ShaderProgram> ShaderProgram::Create(std::string_view vertex,
                                            std::string_view fragment,
                                            std::string_view defines) {
  Shader vertex_shader(GL_VERTEX_SHADER);
  LARARIUM_RETURN_IF_ERROR(vertex_shader.Compile(vertex, defines));
  Shader fragment_shader(GL_FRAGMENT_SHADER);
  LARARIUM_RETURN_IF_ERROR(fragment_shader.Compile(fragment, defines));
  GlProgram program = GlProgram::Generate();
  glAttachShader(program.id(), vertex_shader.id());
  glAttachShader(program.id(), fragment_shader.id());
  glLinkProgram(program.id());
  // Mesa keeps the compiled shaders in memory as long as they are attached.
  glDetachShader(program.id(), vertex_shader.id());
  glDetachShader(program.id(), fragment_shader.id());
  GLint linked = GL_FALSE;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &linked);
  if (linked != GL_TRUE) {
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetProgramInfoLog(program.id(), static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<size_t>(length));
    return Status::Error("shaders " + std::string(vertex) + " and " + std::string(fragment),
                         "do not link:\n" + log);
  }
  return ShaderProgram(std::move(program));
}

void ShaderProgram::Use() const { glUseProgram(program_.id()); }

ShaderProgram::ShaderProgram(GlProgram program) : program_(std::move(program)) {
  constexpr std::string_view kFirst = "[0]";
  GLint count = 0;
  glGetProgramiv(program_.id(), GL_ACTIVE_UNIFORMS, &count);
  std::array<char, 256> text{};
  for (GLint i = 0; i < count; ++i) {
    GLsizei length = 0;
    GLint size = 0;
    GLenum type = 0;
    glGetActiveUniform(program_.id(), static_cast<GLuint>(i), static_cast<GLsizei>(text.size()),
                       &length, &size, &type, text.data());
    const int location = glGetUniformLocation(program_.id(), text.data());
    std::string name(text.data(), static_cast<size_t>(length));
    if (name.ends_with(kFirst)) {
      name.resize(name.size() - kFirst.size());  // arrays are set as a whole
    }
    if (location >= 0) {  // members of uniform blocks have no location
      uniforms_.push_back({std::move(name), location});
    }
  }
  std::sort(uniforms_.begin(), uniforms_.end(),
            [](const Uniform& a, const Uniform& b) { return a.name < b.name; });
}

int ShaderProgram::Location(std::string_view name) const {
  const auto found = std::lower_bound(
      uniforms_.begin(), uniforms_.end(), name,
      [](const Uniform& uniform, std::string_view wanted) { return uniform.name < wanted; });
  return found != uniforms_.end() && found->name == name ? found->location : -1;
}

void ShaderProgram::Set(const char* name, int value) const { glUniform1i(Location(name), value); }
void ShaderProgram::Set(const char* name, float value) const { glUniform1f(Location(name), value); }
void ShaderProgram::Set(const char* name, const glm::ivec2& value) const {
  glUniform2iv(Location(name), 1, glm::value_ptr(value));
}
void ShaderProgram::Set(const char* name, const glm::vec2& value) const {
  glUniform2fv(Location(name), 1, glm::value_ptr(value));
}
void ShaderProgram::Set(const char* name, const glm::vec3& value) const {
  glUniform3fv(Location(name), 1, glm::value_ptr(value));
}
void ShaderProgram::Set(const char* name, const glm::vec4& value) const {
  glUniform4fv(Location(name), 1, glm::value_ptr(value));
}
void ShaderProgram::Set(const char* name, const glm::mat3& value) const {
  glUniformMatrix3fv(Location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void ShaderProgram::Set(const char* name, const glm::mat4& value) const {
  glUniformMatrix4fv(Location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void ShaderProgram::Set(const char* name, std::span<const glm::vec3> values) const {
  glUniform3fv(Location(name), static_cast<GLsizei>(values.size()), glm::value_ptr(values[0]));
}
void ShaderProgram::Set(const char* name, std::span<const glm::vec4> values) const {
  glUniform4fv(Location(name), static_cast<GLsizei>(values.size()), glm::value_ptr(values[0]));
}

void ShaderProgram::BindUniformBlock(const char* name, uint32_t binding) const {
  glUniformBlockBinding(program_.id(), glGetUniformBlockIndex(program_.id(), name), binding);
}

Result<const ShaderProgram*> LateProgram::Get() {
  if (!program_) {
    LARARIUM_ASSIGN_OR_RETURN(program_, ShaderProgram::Create(vertex_, fragment_, defines_));
  }
  return &*program_;
}

}  // namespace lararium::render
