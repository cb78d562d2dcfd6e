#include <algorithm>

#include "shared/core/check.h"
#include "shared/human/cloth_data.h"

namespace lararium::human {
namespace {

constexpr size_t kPairsPerParticle = 16;

void Resize(ClothBody& body, size_t particles, size_t capsules) {
  body.skin.resize(particles);
  body.ends.resize(2 * capsules);
}

}  // namespace

// Allocates all memory that steps need, so that no step allocates.
ClothState::ClothState(const ClothModel& model) : data_(std::make_unique<Data>()) {
  const ClothModel::Data& m = model.data();
  Data& d = *data_;
  const size_t count = m.rest.size();
  for (std::vector<Float4>* particles :
       {&d.positions, &d.before, &d.velocities, &d.accelerations, &d.skin_steps}) {
    particles->resize(count);
  }
  d.hinge_targets.resize(m.hinges.size());
  for (ClothBody* body : {&d.frame, &d.beat, &d.next, &d.target}) {
    Resize(*body, count, m.capsules.size());
  }
  d.cones.resize(m.capsules.size());
  d.skin_matrices.resize(m.joint_from_actor.size());
  d.blocks.resize((m.free.size() + ClothBlock::kSize - 1) / ClothBlock::kSize);
  d.skinned.resize(count);
  d.skinned_normals.resize(count);
  d.contacts.reserve(count * m.capsules.size());
  d.pairs.reserve(count * kPairsPerParticle);
  d.grid.slots.resize(SlotCount(count));
  d.grid.cells.reserve(count);
  d.grid.starts.resize(count + 1);
  d.grid.particles.resize(count);
  d.grid.cell_of.resize(count);
  d.offsets_before.resize(count);
  d.offsets.resize(count);
  for (size_t i = 0; i < count; ++i) {
    d.drape.points.push_back(m.rest[i].xyz());
  }
  d.drape.places = m.rest;
  d.drape.normals.resize(count);
  d.drape.triangle_normals.resize(m.triangles.size());
  for (const ClothRange& cloth : m.cloths) {
    d.first_particles.push_back(cloth.first);
  }
  d.first_particles.push_back(static_cast<uint32_t>(count));
  MeasureNormals(m, d.drape);
}

ClothState::ClothState(const ClothState& other) : data_(std::make_unique<Data>(*other.data_)) {
  data_->contacts.reserve(other.data_->contacts.capacity());
  data_->pairs.reserve(other.data_->pairs.capacity());
  data_->grid.cells.reserve(data_->positions.size());
}

ClothState& ClothState::operator=(const ClothState& other) {
  if (this != &other) {
    *this = ClothState(other);
  }
  return *this;
}

ClothState::ClothState(ClothState&&) noexcept = default;
ClothState& ClothState::operator=(ClothState&&) noexcept = default;
ClothState::~ClothState() = default;

std::span<const glm::vec3> ClothState::particles(size_t cloth) const {
  CHECK(cloth + 1 < data_->first_particles.size());
  const uint32_t first = data_->first_particles[cloth];
  return std::span<const glm::vec3>(data_->drape.points)
      .subspan(first, data_->first_particles[cloth + 1] - first);
}

}  // namespace lararium::human
