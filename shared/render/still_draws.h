#pragma once

// Tells what stands still from what moves, so that what is drawn of the former can be kept
// from picture to picture. Private to render.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "shared/render/model_pass.h"

namespace lararium::render {

class StillDraws {
 public:
  // All draws of a picture, in the order of the picture before. A prop stands still that is as it
  // was in that; people never do.
  void Sort(std::span<const ModelDraw> draws);
  // What was sorted last.
  std::span<const ModelDraw> still() const { return still_; }
  std::span<const ModelDraw> moving() const { return moving_; }
  // still() is what it was before, all of it.
  bool same() const { return same_; }

  // Models were removed: others may take their place.
  void Forget();

 private:
  struct State {
    const GpuModel* model = nullptr;
    std::vector<glm::mat4> stage_from_part;
    std::vector<uint8_t> shown;

    bool Is(const ModelDraw& draw) const;
    void Become(const ModelDraw& draw);
  };

  std::vector<State> before_;  // of each draw
  std::vector<uint8_t> was_still_;
  std::vector<ModelDraw> still_;
  std::vector<ModelDraw> moving_;
  bool same_ = false;
};

}  // namespace lararium::render
