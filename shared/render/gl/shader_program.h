#pragma once

// A linked program of a vertex and a fragment shader. Private to render.

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/core/status.h"
#include "shared/render/gl/gl_object.h"

namespace lararium::render {

class ShaderProgram {
 public:
  ShaderProgram() = default;

  // Compiles embedded shaders for the API of the current context. defines: lines that are put at
  // the beginning of both. Errors name file and line.
  static Result<ShaderProgram> Create(std::string_view vertex,
                                      std::string_view fragment,
                                      std::string_view defines = {});

  void Use() const;
  // Set uniforms; this must be the program in use. Names of unused uniforms, which the compiler
  // removes, are ignored.
  void Set(const char* name, int value) const;
  void Set(const char* name, float value) const;
  void Set(const char* name, const glm::ivec2& value) const;
  void Set(const char* name, const glm::vec2& value) const;
  void Set(const char* name, const glm::vec3& value) const;
  void Set(const char* name, const glm::vec4& value) const;
  void Set(const char* name, const glm::mat3& value) const;
  void Set(const char* name, const glm::mat4& value) const;
  void Set(const char* name, std::span<const glm::vec3> values) const;
  void Set(const char* name, std::span<const glm::vec4> values) const;
  void BindUniformBlock(const char* name, uint32_t binding) const;

 private:
  struct Uniform {
    std::string name;
    int location = -1;
  };

  explicit ShaderProgram(GlProgram program);
  int Location(std::string_view name) const;

  GlProgram program_;
  std::vector<Uniform> uniforms_;  // sorted by name; drivers are slow at finding them
};

// A program that is compiled on first use: a driver keeps a megabyte for each, and no picture
// needs all of them. The strings must outlive the object.
class LateProgram {
 public:
  LateProgram(std::string_view vertex, std::string_view fragment, std::string_view defines = {})
      : vertex_(vertex), fragment_(fragment), defines_(defines) {}

  // The program stays valid as long as this object.
  Result<const ShaderProgram*> Get();

 private:
  std::string_view vertex_, fragment_, defines_;
  std::optional<ShaderProgram> program_;
};

}  // namespace lararium::render
