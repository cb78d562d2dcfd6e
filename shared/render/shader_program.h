#pragma once

// A linked pair of shaders. Private to render.

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
#include "shared/render/gl_object.h"

namespace lararium::render {

class ShaderProgram {
 public:
  ShaderProgram() = default;

  // Compiles embedded shaders for the context's API. defines: lines that both begin
  // with. Errors name file and line.
  static Result<ShaderProgram> Create(std::string_view vertex,
                                      std::string_view fragment,
                                      std::string_view defines = {});

  void Use() const;
  // Of the program in use. Names that the compiler optimised away are ignored.
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
  std::vector<Uniform> uniforms_;  // by name: drivers are slow to look them up
};

// A program that is compiled when it is first wanted: a driver keeps a megabyte for each, and no
// picture needs all that there are. Takes names and lines that live as long.
class LateProgram {
 public:
  LateProgram(std::string_view vertex, std::string_view fragment, std::string_view defines = {})
      : vertex_(vertex), fragment_(fragment), defines_(defines) {}

  // Lives as long as this does.
  Result<const ShaderProgram*> Get();

 private:
  std::string_view vertex_, fragment_, defines_;
  std::optional<ShaderProgram> program_;
};

}  // namespace lararium::render
