#include "shared/render/gl/shader_source.h"

#include <algorithm>
#include <cctype>

namespace lararium::render {
namespace {

// Removes the first line from text and returns it without its line end.
std::string_view TakeLine(std::string_view& text) {
  const size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

// The name in: #include "name"
std::string_view IncludedName(std::string_view line) {
  constexpr std::string_view kDirective = "#include \"";
  const size_t end = line.rfind('"');
  if (!line.starts_with(kDirective) || end < kDirective.size()) {
    return {};
  }
  return line.substr(kDirective.size(), end - kDirective.size());
}

class Assembler {
 public:
  Assembler(std::span<const EmbeddedText> sources, AssembledShader& shader)
      : sources_(sources), shader_(shader) {}

  Status Append(std::string_view name) {
    if (std::find(shader_.files.begin(), shader_.files.end(), name) != shader_.files.end()) {
      return Status();
    }
    const auto source = std::find_if(sources_.begin(), sources_.end(),
                                     [&](const EmbeddedText& s) { return s.name == name; });
    if (source == sources_.end()) {
      return Status::Error(name, "there is no such shader file");
    }
    const size_t number = shader_.files.size();
    shader_.files.push_back(source->name);
    MarkLine(1, number);
    std::string_view rest = source->text;
    for (int line_number = 1; !rest.empty(); ++line_number) {
      const std::string_view line = TakeLine(rest);
      if (const std::string_view included = IncludedName(line); !included.empty()) {
        if (const Status status = Append(included); !status.ok()) {
          return status.At(std::string(name) + ":" + std::to_string(line_number));
        }
        MarkLine(line_number + 1, number);
      } else {
        shader_.text.append(line).append("\n");
      }
    }
    return Status();
  }

 private:
  // Tells the compiler the file and line of the text that follows.
  void MarkLine(int line, size_t number) {
    shader_.text += "#line " + std::to_string(line) + " " + std::to_string(number) + "\n";
  }

  std::span<const EmbeddedText> sources_;
  AssembledShader& shader_;
};

// Removes a decimal number from the beginning of text and returns it; npos: there is none.
size_t TakeNumber(std::string_view& text) {
  size_t value = 0;
  size_t digits = 0;
  while (digits < text.size() && digits < 6 &&
         std::isdigit(static_cast<unsigned char>(text[digits])) != 0) {
    value = 10 * value + static_cast<size_t>(text[digits++] - '0');
  }
  text.remove_prefix(digits);
  return digits == 0 ? std::string_view::npos : value;
}

}  // namespace

std::string AssembledShader::ExplainLog(std::string_view log) const {
  std::string explained;
  while (!log.empty()) {
    const std::string_view line = TakeLine(log);
    std::string_view rest = line;
    const size_t file = TakeNumber(rest);
    const bool marked = file < files.size() && (rest.starts_with(':') || rest.starts_with('('));
    if (marked) {
      rest.remove_prefix(1);
      explained.append(files[file]).append(":").append(rest);
    } else {
      explained.append(line);
    }
    explained.append("\n");
  }
  return explained;
}

Result<AssembledShader> AssembleShader(std::string_view name,
                                       std::string_view header,
                                       std::span<const EmbeddedText> sources) {
  AssembledShader shader;
  shader.text = header;
  LARARIUM_RETURN_IF_ERROR(Assembler(sources, shader).Append(name));
  return shader;
}

Result<AssembledShader> AssembleShader(std::string_view name, std::string_view header) {
  return AssembleShader(name, header, ShaderSources());
}

}  // namespace lararium::render
