#include "editor/import/model/levels_of_detail.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lararium::import {
namespace {

std::vector<uint32_t> Uncovered(const std::vector<uint32_t>& indices,
                                const std::vector<bool>& covered) {
  std::vector<uint32_t> left;
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const auto corners = indices.begin() + static_cast<ptrdiff_t>(i);
    if (covered.empty() ||
        !std::all_of(corners, corners + 3, [&](uint32_t v) { return covered[v]; })) {
      left.insert(left.end(), corners, corners + 3);
    }
  }
  return left;
}

// Error of the light between vertices as a share of the edge length.
constexpr float kLightError = 0.05f;

constexpr uint32_t kUnplaced = 0xffffffffu;

// The new index of each vertex.
std::vector<uint32_t> CoarsestFirst(const human::SkinnedMesh& mesh) {
  std::vector<uint32_t> numbers(mesh.positions.size(), kUnplaced);
  uint32_t next = 0;
  const auto place = [&](uint32_t vertex) {
    if (numbers[vertex] == kUnplaced) {
      numbers[vertex] = next++;
    }
  };
  for (auto level = mesh.coarser.rbegin(); level != mesh.coarser.rend(); ++level) {
    std::for_each(level->indices.begin(), level->indices.end(), place);
  }
  std::for_each(mesh.indices.begin(), mesh.indices.end(), place);
  for (uint32_t vertex = 0; vertex < numbers.size(); ++vertex) {
    place(vertex);
  }
  return numbers;
}

template <typename T>
void Renumber(const std::vector<uint32_t>& numbers, std::vector<T>& values) {
  std::vector<T> moved(values.size());
  for (size_t i = 0; i < values.size(); ++i) {
    moved[numbers[i]] = values[i];
  }
  values = std::move(moved);
}

void Renumber(const std::vector<uint32_t>& numbers, human::SkinnedMesh& mesh) {
  for (std::vector<glm::vec3>* values : {&mesh.positions, &mesh.normals, &mesh.albedo}) {
    Renumber(numbers, *values);
  }
  Renumber(numbers, mesh.uvs);
  Renumber(numbers, mesh.joints);
  Renumber(numbers, mesh.weights);
  const auto name_anew = [&](std::vector<uint32_t>& indices) {
    for (uint32_t& index : indices) {
      index = numbers[index];
    }
  };
  name_anew(mesh.indices);
  for (human::LevelOfDetail& level : mesh.coarser) {
    name_anew(level.indices);
  }
}

// Sorts the vertices in ascending order, so that memory is read in one direction.
void Renumber(const std::vector<uint32_t>& numbers, human::MorphTarget::Part& part) {
  std::vector<size_t> order(part.vertices.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return numbers[part.vertices[a]] < numbers[part.vertices[b]];
  });
  human::MorphTarget::Part sorted;
  sorted.mesh = part.mesh;
  for (const size_t i : order) {
    sorted.vertices.push_back(numbers[part.vertices[i]]);
    sorted.position_deltas.push_back(part.position_deltas[i]);
    sorted.normal_deltas.push_back(part.normal_deltas[i]);
  }
  part = std::move(sorted);
}

// Reorders blocks of `size` values for each vertex, once for each key pose.
template <typename T>
void RenumberBlocks(const std::vector<uint32_t>& numbers, size_t size, std::vector<T>& values) {
  std::vector<T> moved(values.size());
  for (size_t row = 0; row * size < values.size(); ++row) {
    const size_t pose_begin = row / numbers.size() * numbers.size();
    const size_t to = pose_begin + numbers[row - pose_begin];
    std::copy_n(values.begin() + static_cast<ptrdiff_t>(row * size), size,
                moved.begin() + static_cast<ptrdiff_t>(to * size));
  }
  values = std::move(moved);
}

void Renumber(const std::vector<uint32_t>& numbers, int count, human::LightTransfer::Mesh& mesh) {
  Renumber(numbers, mesh.receivers);
  Renumber(numbers, mesh.weights);
  RenumberBlocks(numbers, 1, mesh.scale);
  RenumberBlocks(numbers, 3 * static_cast<size_t>(count), mesh.coefficients);
}

}  // namespace

void OrderTriangles(human::SkinnedMesh& mesh) {
  OrderForCache(mesh.positions.size(), mesh.indices);
}

void AddLevelsOfDetail(human::SkinnedMesh& mesh, const std::vector<bool>& covered) {
  mesh.coarser =
      CoarserLevels(mesh.positions, Uncovered(mesh.indices, covered), mesh.indices.size());
}

void AddLevelsOfDetail(stage::Prop& prop) {
  for (stage::PropPart& part : prop.parts) {
    for (stage::PropMesh& mesh : part.meshes) {
      mesh.coarser = CoarserLevels(mesh.positions, mesh.indices, mesh.indices.size());
      float error = 0.0f;
      for (human::LevelOfDetail& level : mesh.coarser) {
        error =
            std::max({error, level.error, kLightError * MeanEdge(mesh.positions, level.indices)});
        level.error = error;
      }
    }
  }
}

void OrderVertices(human::Human& human) {
  std::vector<std::vector<uint32_t>> numbers;
  for (human::SkinnedMesh& mesh : human.meshes) {
    Renumber(numbers.emplace_back(CoarsestFirst(mesh)), mesh);
  }
  for (size_t i = 0; i < human.light.meshes.size(); ++i) {
    Renumber(numbers[i], human.light.count, human.light.meshes[i]);
  }
  for (human::MorphTarget& morph : human.morphs) {
    for (human::MorphTarget::Part& part : morph.parts) {
      Renumber(numbers[part.mesh], part);
    }
  }
  for (human::Cloth& cloth : human.cloths) {
    Renumber(numbers[cloth.mesh], cloth.vertex_triangle);
    Renumber(numbers[cloth.mesh], cloth.vertex_weights);
  }
}

}  // namespace lararium::import
