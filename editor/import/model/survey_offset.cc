#include "editor/import/model/survey_offset.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <sstream>
#include <string_view>

namespace lararium::import {
namespace {

constexpr double kFar = 10'000.0;       // Metres; larger than a site.
constexpr double kFarForExtent = 10.0;  // Lengths of its extent.
constexpr double kStep = 1000.0;

// Three numbers in a text, and the range that they take.
struct Vertex {
  glm::dvec3 position;
  size_t begin = 0, end = 0;
};

std::optional<Vertex> ReadVertex(std::string_view text, size_t at, size_t line_end) {
  Vertex vertex;
  for (int axis = 0; axis < 3; ++axis) {
    at = std::min(text.find_first_not_of(" \t", at), line_end);
    vertex.begin = axis == 0 ? at : vertex.begin;
    const char* end = text.data() + line_end;
    const auto [rest, error] = std::from_chars(text.data() + at, end, vertex.position[axis]);
    if (error != std::errc()) {
      return std::nullopt;
    }
    at = static_cast<size_t>(rest - text.data());
  }
  vertex.end = at;
  return vertex;
}

// The text with the offset of its vertices taken off, which is zero if it is no survey.
glm::dvec3 Rewrite(const std::vector<Vertex>& vertices, std::vector<std::byte>& bytes) {
  std::vector<glm::dvec3> positions;
  for (const Vertex& vertex : vertices) {
    positions.push_back(vertex.position);
  }
  const glm::dvec3 offset = SurveyOffset(positions);
  if (offset == glm::dvec3(0.0)) {
    return offset;
  }
  std::vector<std::byte> result;
  result.reserve(bytes.size());
  size_t done = 0;
  const auto copy_to = [&](size_t end) {
    result.insert(result.end(), bytes.begin() + static_cast<std::ptrdiff_t>(done),
                  bytes.begin() + static_cast<std::ptrdiff_t>(end));
  };
  for (const Vertex& vertex : vertices) {
    copy_to(vertex.begin);
    done = vertex.end;
    const glm::dvec3 near = vertex.position - offset;
    std::array<char, 96> text;
    const int size =
        std::snprintf(text.data(), text.size(), "%.6f %.6f %.6f", near.x, near.y, near.z);
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    result.insert(result.end(), begin, begin + size);
  }
  copy_to(bytes.size());
  bytes = std::move(result);
  return offset;
}

glm::dvec3 TakeOffObj(std::vector<std::byte>& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::vector<Vertex> vertices;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const size_t word = std::min(text.find_first_not_of(" \t", at), end);
    if (word + 1 < end && text[word] == 'v' && (text[word + 1] == ' ' || text[word + 1] == '\t')) {
      if (const auto vertex = ReadVertex(text, word + 1, end)) {
        vertices.push_back(*vertex);
      }
    }
    at = end + 1;
  }
  return Rewrite(vertices, bytes);
}

// The first element of a PLY, if it is the vertices.
struct PlyVertices {
  size_t count = 0;
  std::string format;
  std::vector<std::string> types, names;  // Each property has one of both.
  size_t begin = 0;                       // Offset of the data in the file.
};

std::optional<PlyVertices> ReadPlyHeader(std::string_view text) {
  const size_t end = text.find("end_header");
  const size_t data = end == text.npos ? end : text.find('\n', end);
  if (!text.starts_with("ply") || data == text.npos || data > (1 << 16)) {
    return std::nullopt;
  }
  PlyVertices vertices;
  vertices.begin = data + 1;
  std::istringstream header{std::string(text.substr(0, end))};
  int elements = 0;
  for (std::string line; std::getline(header, line);) {
    std::istringstream words(line);
    std::string word, kind, name;
    words >> word >> kind >> name;
    if (word == "format") {
      vertices.format = kind;
    } else if (word == "element" && ++elements == 1) {
      std::from_chars(name.data(), name.data() + name.size(), vertices.count);
      if (kind != "vertex") {
        return std::nullopt;
      }
    } else if (word == "property" && elements == 1) {
      vertices.types.push_back(kind);
      vertices.names.push_back(name);
    }
  }
  return vertices;
}

size_t PlyBytes(const std::string& type) {
  for (const auto& [name, bytes] : {std::pair{"char", 1},
                                    {"uchar", 1},
                                    {"int8", 1},
                                    {"uint8", 1},
                                    {"short", 2},
                                    {"ushort", 2},
                                    {"int16", 2},
                                    {"uint16", 2},
                                    {"int", 4},
                                    {"uint", 4},
                                    {"int32", 4},
                                    {"uint32", 4},
                                    {"float", 4},
                                    {"float32", 4},
                                    {"double", 8},
                                    {"float64", 8}}) {
    if (type == name) {
      return static_cast<size_t>(bytes);
    }
  }
  return 0;
}

double SwapIf(bool swaps, double value) {
  auto bits = std::bit_cast<std::array<std::byte, sizeof(double)>>(value);
  if (swaps) {
    std::reverse(bits.begin(), bits.end());
  }
  return std::bit_cast<double>(bits);
}

glm::dvec3 TakeOffBinaryPly(const PlyVertices& vertices, size_t x, std::vector<std::byte>& bytes) {
  size_t stride = 0, first = 0;
  for (size_t p = 0; p < vertices.types.size(); ++p) {
    const size_t size = PlyBytes(vertices.types[p]);
    if (size == 0 || (p >= x && p < x + 3 && size != sizeof(double))) {
      return glm::dvec3(0.0);
    }
    first = p == x ? stride : first;
    stride += size;
  }
  if (vertices.count > (bytes.size() - vertices.begin) / stride) {
    return glm::dvec3(0.0);
  }
  const bool swaps = vertices.format == "binary_big_endian";
  std::vector<glm::dvec3> positions(vertices.count);
  std::byte* data = bytes.data() + vertices.begin + first;
  for (size_t v = 0; v < positions.size(); ++v) {
    std::memcpy(&positions[v], data + v * stride, sizeof(glm::dvec3));
    for (int axis = 0; axis < 3; ++axis) {
      positions[v][axis] = SwapIf(swaps, positions[v][axis]);
    }
  }
  const glm::dvec3 offset = SurveyOffset(positions);
  for (size_t v = 0; v < positions.size(); ++v) {
    glm::dvec3 near = positions[v] - offset;
    for (int axis = 0; axis < 3; ++axis) {
      near[axis] = SwapIf(swaps, near[axis]);
    }
    std::memcpy(data + v * stride, &near, sizeof(near));
  }
  return offset;
}

glm::dvec3 TakeOffPly(std::vector<std::byte>& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const auto vertices = ReadPlyHeader(text);
  if (!vertices) {
    return glm::dvec3(0.0);
  }
  const auto& names = vertices->names;
  const auto x = static_cast<size_t>(std::find(names.begin(), names.end(), "x") - names.begin());
  if (x + 2 >= names.size() || names[x + 1] != "y" || names[x + 2] != "z") {
    return glm::dvec3(0.0);
  }
  if (vertices->format != "ascii") {
    return TakeOffBinaryPly(*vertices, x, bytes);
  }
  if (x != 0) {
    return glm::dvec3(0.0);
  }
  std::vector<Vertex> list;
  for (size_t at = vertices->begin; at < text.size() && list.size() < vertices->count;) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const auto vertex = ReadVertex(text, at, end);
    if (!vertex) {
      return glm::dvec3(0.0);
    }
    list.push_back(*vertex);
    at = end + 1;
  }
  return Rewrite(list, bytes);
}

}  // namespace

glm::dvec3 SurveyOffset(std::span<const glm::dvec3> positions) {
  if (positions.empty()) {
    return glm::dvec3(0.0);
  }
  glm::dvec3 low = positions[0], high = positions[0];
  for (const glm::dvec3& position : positions) {
    low = glm::min(low, position);
    high = glm::max(high, position);
  }
  const glm::dvec3 centre = 0.5 * (low + high);
  const double far = glm::length(centre);
  if (!std::isfinite(far) || far < kFar || far < kFarForExtent * glm::distance(low, high)) {
    return glm::dvec3(0.0);
  }
  return glm::round(centre / kStep) * kStep;
}

glm::dvec3 TakeOffSurvey(const std::string& extension, std::vector<std::byte>& bytes) {
  return extension == ".obj"   ? TakeOffObj(bytes)
         : extension == ".ply" ? TakeOffPly(bytes)
                               : glm::dvec3(0.0);
}

}  // namespace lararium::import
