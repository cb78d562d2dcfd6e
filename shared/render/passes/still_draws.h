#pragma once

// Separates props that stand still from models that move, so that drawings of still props can be
// reused from picture to picture. Private to render.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "shared/render/passes/model_pass.h"

namespace lararium::render {

class StillDraws {
 public:
  // draws: all draws of a picture, in the same order as in the previous picture. A prop stands
  // still if nothing about it changed since then; people never count as still.
  void Sort(std::span<const ModelDraw> draws);
  // Results of the last Sort.
  std::span<const ModelDraw> still() const { return still_; }
  std::span<const ModelDraw> moving() const { return moving_; }
  // True if still() did not change in the last Sort.
  bool same() const { return same_; }

  // Call this when models were removed, because new ones may get their addresses.
  void Forget();

 private:
  struct State {
    const GpuModel* model = nullptr;
    std::vector<glm::mat4> stage_from_part;
    std::vector<uint8_t> shown;

    bool Is(const ModelDraw& draw) const;
    void Become(const ModelDraw& draw);
  };

  std::vector<State> before_;  // state of each draw in the previous picture
  std::vector<uint8_t> was_still_;
  std::vector<ModelDraw> still_;
  std::vector<ModelDraw> moving_;
  bool same_ = false;
};

}  // namespace lararium::render
